"""Which schema a reference means: one of the folder, or a stand-in for one of glTF's own.

Users do not have glTF's core schemas, so the few that extensions inherit from or hold are written anew here,
with keywords that mean the same in every draft. Nothing is ever fetched.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final
from urllib.parse import unquote

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.words import join, shown
from gltf_iri.proposal.bounds import MAX_SCHEMA_BYTES, parse_bounded
from gltf_iri.proposal.drafts import DRAFTS, Draft, draft_of
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.word_list import words

__all__ = ["BASES", "CORE_NAMES", "SUFFIX", "TEXTURES", "DanglingError", "SchemaFile", "SchemaSet", "Target"]

SUFFIX: Final = ".schema.json"

# The schemas of glTF 2.0 by name: specification/2.0/schema in KhronosGroup/glTF.
CORE_NAMES: Final = words(
    "accessor accessor.sparse accessor.sparse.indices accessor.sparse.values animation animation.channel "
    "animation.channel.target animation.sampler asset buffer bufferView camera camera.orthographic "
    "camera.perspective extension extras glTF glTFChildOfRootProperty glTFProperty glTFid image material "
    "material.normalTextureInfo material.occlusionTextureInfo material.pbrMetallicRoughness mesh "
    "mesh.primitive node sampler scene skin texture textureInfo"
)
BASES: Final = frozenset({"glTFProperty.schema.json", "glTFChildOfRootProperty.schema.json"})
TEXTURES: Final = frozenset(
    f"{name}{SUFFIX}"
    for name in ("textureInfo", "material.normalTextureInfo", "material.occlusionTextureInfo")
)

_SCHEME: Final = re.compile(r"[A-Za-z][A-Za-z0-9+.\-]*:")
# Stand-ins say nothing that a draft would read otherwise; any will do.
_ANY_DRAFT: Final = next(iter(DRAFTS.values()))


@dataclass(frozen=True)
class SchemaFile:
    """A parsed schema: the file's name, its place below the folder, its content and its draft."""

    name: str
    where: str
    tree: dict[str, Any]
    draft: Draft | None
    is_stand_in: bool = False

    def at(self, pointer: str) -> str:
        """Return `where` with a JSON Pointer behind it."""
        return f"{self.where}#{pointer or '/'}"


@dataclass(frozen=True)
class Target:
    """What a reference leads to."""

    file: SchemaFile
    pointer: str
    schema: dict[str, Any]


class DanglingError(Exception):
    """A reference that leads nowhere: `finding` says why."""

    def __init__(self, finding: Finding) -> None:
        self.finding = finding
        super().__init__(finding.message)


class SchemaSet:
    """The folder's schemas, with the stand-ins behind them."""

    def __init__(self, files: Mapping[str, SchemaFile]) -> None:
        self.own = files
        self._known = {**stand_ins(), **files}

    def find(self, file: SchemaFile, pointer: str, reference: object) -> Target:
        """Resolve the ``$ref`` that stands at `pointer` of `file`; raises DanglingError."""
        where = file.at(join(pointer, "$ref"))
        if not isinstance(reference, str):
            raise DanglingError(Finding("ref-unresolved", "a reference must be text", where))
        name, _, fragment = reference.partition("#")
        if _SCHEME.match(name) or "/" in name or "\\" in name or name in (".", ".."):
            told = f"the reference {shown(reference)} leads out of the folder; name a file beside this one"
            raise DanglingError(Finding("ref-outside", told, where))
        target = file if not name else self._known.get(unquote(name))
        if target is None:
            told = f"there is no {shown(name)} in the folder, and glTF has no such schema"
            raise DanglingError(Finding("ref-unresolved", told, where))
        try:
            found = _step_to(target.tree, unquote(fragment))
        except LookupError as error:
            told = f"{shown(target.name)} has nothing at {shown('#' + fragment)}"
            raise DanglingError(Finding("ref-unresolved", told, where)) from error
        if not isinstance(found, dict):
            told = f"what {shown(reference)} leads to is no schema"
            raise DanglingError(Finding("ref-unresolved", told, where))
        return Target(target, unquote(fragment), found)


@cache
def stand_ins() -> Mapping[str, SchemaFile]:
    """Return glTF's own schemas by file name; those without a stand-in allow anything."""
    folder = Path(__file__).parent / "stand_ins"
    known: dict[str, SchemaFile] = {}
    for core in CORE_NAMES:
        name = f"{core}{SUFFIX}"
        path = folder / name
        tree = parse_bounded(read_given(path, MAX_SCHEMA_BYTES)) if path.is_file() else {}
        known[name] = SchemaFile(name, name, tree, draft_of(tree) or _ANY_DRAFT, is_stand_in=True)
    return MappingProxyType(known)


def _step_to(tree: Any, pointer: str) -> Any:
    """Follow a JSON Pointer (RFC 6901); LookupError where it leads nowhere."""
    if pointer and not pointer.startswith("/"):
        raise LookupError(pointer)
    for token in pointer.split("/")[1:]:
        key = token.replace("~1", "/").replace("~0", "~")
        if isinstance(tree, list):
            if not (key.isascii() and key.isdigit() and len(key) < 6):
                raise LookupError(pointer)
            tree = tree[int(key)]
        elif isinstance(tree, dict):
            tree = tree[key]
        else:
            raise LookupError(pointer)
    return tree
