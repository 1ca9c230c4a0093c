"""Textures: every reference says which channels are read, how they are encoded, and what stands for none."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.objects import Kind, extension_objects, texts

__all__ = ["textures"]

_CHANNEL: Final = re.compile(
    r"\b(?:R|G|B|A|RG|GB|RGB|RGBA)\b|(?i:\b(?:red|green|blue|alpha)\b)|(?<=Texture)\.[rgba]{1,4}\b"
)
_ALPHA: Final = re.compile(r"(?i:\balpha\b)|\bA\b")
_COLOUR_CHANNEL: Final = re.compile(r"\b(?:R|G|B|RG|GB|RGB|RGBA)\b|(?i:\b(?:red|green|blue)\b)")
_ENCODING: Final = re.compile(r"\blinear(?:ly)?\b|\bsRGB\b|transfer function|\braw\b", re.IGNORECASE)
_ABSENT: Final = re.compile(
    r"\bnot\s+(?:\w+\s+)?(?:given|supplied|provided|present|set|defined|specified)\b|\babsent\b|\bundefined\b"
    r"|\bno\s+(?:\w+\s+)?texture\b|\bmissing\b|\bomitted\b|\bwithout\b",
    re.IGNORECASE,
)
# Tangent-space normals: core glTF says which channels they stand in, and what stands for none.
_NORMALS: Final = "material.normalTextureInfo.schema.json"


def textures(proposal: Proposal) -> Iterator[Finding]:
    """The description of each reference to a texture names channels, encoding and the value for none."""
    seen = set()
    for kind in extension_objects(proposal):
        for owner in kind.properties.values():
            if owner.kind is not Kind.TEXTURE or owner.texture_file == _NORMALS or owner.where in seen:
                continue
            seen.add(owner.where)
            told = _without_articles(" ".join(texts(view.schema) for view in owner.views))
            name = shown(owner.name)
            if not _CHANNEL.search(told):
                said = f'the description of {name} names no channel, such as "the R channel"'
                yield Finding("texture-channel", said, owner.where)
            # Alpha is always linear (sRGB encodes colours only): where nothing else is read it needs no word.
            is_alpha = _ALPHA.search(told) and not _COLOUR_CHANNEL.search(told)
            if not is_alpha and not _ENCODING.search(told):
                said = f"the description of {name} does not say whether it is linear or sRGB"
                yield Finding("texture-colour-space", said, owner.where)
            if not _ABSENT.search(told):
                said = f"the description of {name} does not say what stands for an absent texture"
                yield Finding("texture-absent-value", said, owner.where)


def _without_articles(text: str) -> str:
    """Drop "A" before a word other than "channel": an article, not the letter of the alpha channel."""
    return re.sub(r"\bA\s+(?!channel)(?=[a-z])", "", text)
