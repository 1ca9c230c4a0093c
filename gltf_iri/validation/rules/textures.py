"""Textures and images: which kinds of pictures a texture may name, and how their bytes lie in buffers."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.words import shown
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rule, Rules

__all__ = ["DATA_RULES", "RULES"]


def picture_lies_without_gaps(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A compressed picture is one row of bytes: its buffer view has no stride."""
    view = asset.get("bufferViews", entry.get("bufferView"))
    if view is not None and "byteStride" in view:
        yield issue("IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", entry.at("bufferView"))


def _source_is_one_of(*allowed: str) -> Rule:
    def source_is_allowed(entry: Entry, asset: Asset) -> Iterator[Issue]:
        """Readers know certain kinds of pictures; what the file declares counts before what the bytes are."""
        found = _media_type(asset, entry.get("source"))
        if found is not None and found not in allowed:
            wanted = " or ".join(allowed)
            pointer = entry.at("source")
            yield issue("TEXTURE_INVALID_IMAGE_MIME_TYPE", pointer, media_type=shown(found), allowed=wanted)

    return source_is_allowed


def _media_type(asset: Asset, index: int | None) -> str | None:
    image = asset.get("images", index)
    if image is None or index is None:
        return None
    declared = image.raw.get("mimeType")
    if isinstance(declared, str):
        return declared
    info = asset.images.get(index)
    return info.media_type if info is not None else None


RULES: Rules = {"image": (picture_lies_without_gaps,)}

DATA_RULES: Rules = {
    "texture": (_source_is_one_of("image/jpeg", "image/png"),),
    "EXT_texture_webp": (_source_is_one_of("image/webp"),),
}
