"""The README's table of pointers against the schema: what the Object Model makes animatable, and its type.

Pointers and types are those of glTF's Asset Object Model (specification/2.0/ObjectModel.adoc): numbers are
``float``, arrays of two to four numbers ``float2`` to ``float4``, and each reference to a texture has the
three properties of KHR_texture_transform.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import POINTER_LENGTH, Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.markdown import Markdown, plain
from gltf_iri.proposal.objects import Kind, ObjectType, Property, extension_objects, item_kind

__all__ = ["pointers"]

_ROOTS: Final[Mapping[str, str]] = {
    "glTF": "",
    "material": "/materials/{}",
    "node": "/nodes/{}",
    "mesh": "/meshes/{}",
    "mesh.primitive": "/meshes/{}/primitives/{}",
    "primitive": "/meshes/{}/primitives/{}",
    "scene": "/scenes/{}",
    "camera": "/cameras/{}",
    "texture": "/textures/{}",
}
_TRANSFORM: Final[Mapping[str, str]] = {"offset": "float2", "rotation": "float", "scale": "float2"}
_INSIDE_TEXTURES: Final[Mapping[str, Mapping[str, str]]] = {
    "material.normalTextureInfo.schema.json": {"scale": "float"},
    "material.occlusionTextureInfo.schema.json": {"strength": "float"},
}
_INDEX: Final = re.compile(r"(?<=/)(?:\{[^{}]*\}|\d+|<[^<>]*>)(?=/|$)")


@dataclass(frozen=True)
class _Expected:
    """A pointer that the schema allows: its type, where it comes from, and whether a table must have it."""

    type: str
    where: str
    is_demanded: bool


def pointers(proposal: Proposal) -> Iterator[Finding]:
    """Every number of the schema that may be animated has its pointer, and no pointer leads nowhere."""
    readme = proposal.readme
    if readme is None:
        return
    expected: dict[str, _Expected] = {}
    for kind in extension_objects(proposal):
        if kind.scope in _ROOTS:
            expected |= _of_object(proposal, kind)
    rows = _rows(readme, proposal.name)
    if not rows:
        if any(one.is_demanded for one in expected.values()):
            told = "there is no table of pointers for animations (its first column is called Pointer)"
            yield Finding("pointer-table-missing", told, readme.name)
        return
    for pointer, (line, type_) in rows.items():
        known = expected.get(pointer)
        if known is None:
            told = f"{shown(pointer, POINTER_LENGTH)} leads to nothing that the schema has"
            yield Finding("pointer-unknown", told, readme.at(line))
        elif type_ and type_ != known.type:
            told = f"{shown(pointer, POINTER_LENGTH)} is {shown(type_)} here, {known.type} by the schema"
            yield Finding("pointer-type", told, readme.at(line))
    last = max(line for line, _ in rows.values())
    for pointer, one in expected.items():
        if one.is_demanded and pointer not in rows:
            yield Finding("pointer-missing", f"the table lacks {pointer} ({one.type})", readme.at(last))


def _rows(readme: Markdown, name: str) -> dict[str, tuple[int, str]]:
    """Return line and type of each pointer to the extension, its indices written as ``{}``."""
    rows = {}
    for table in readme.tables:
        head = [plain(cell).lower() for cell in table.head]
        if not head or head[0] not in ("pointer", "json pointer", "pointers"):
            continue
        column = head.index("type") if "type" in head else 0
        for line, cells in table.rows:
            pointer = _INDEX.sub("{}", plain(cells[0])) if cells else ""
            if f"/{name}/" in pointer or f"/{name}." in pointer:
                type_ = plain(cells[column]) if 0 < column < len(cells) else ""
                rows[pointer] = (line, type_)
    return rows


def _of_object(proposal: Proposal, kind: ObjectType) -> dict[str, _Expected]:
    base = "/".join((f"{_ROOTS[kind.scope]}/extensions/{proposal.name}", *kind.path))
    found: dict[str, _Expected] = {}
    for owner in kind.properties.values():
        pointer = f"{base}/{owner.name}"
        if owner.kind is Kind.TEXTURE:
            for name, type_ in _INSIDE_TEXTURES.get(owner.texture_file, {}).items():
                found[f"{pointer}/{name}"] = _Expected(type_, owner.where, True)
            for name, type_ in _TRANSFORM.items():
                transform = f"{pointer}/extensions/KHR_texture_transform/{name}"
                found[transform] = _Expected(type_, owner.where, True)
        elif owner.kind is Kind.ARRAY:
            found |= _of_array(proposal, owner, pointer)
        elif owner.kind in _SCALARS:
            found[pointer] = _Expected(_SCALARS[owner.kind], owner.where, owner.kind is Kind.NUMBER)
    return found


# Integers and switches have pointers, but only numbers that can take values in between are always animatable.
_SCALARS: Final[Mapping[Kind, str]] = {Kind.NUMBER: "float", Kind.INTEGER: "int", Kind.BOOLEAN: "bool"}


def _of_array(proposal: Proposal, owner: Property, pointer: str) -> dict[str, _Expected]:
    items = item_kind(proposal.schemas, owner)
    length = _Expected("int", owner.where, False)
    if items is not Kind.NUMBER:
        return {f"{pointer}.length": length}
    if owner.length in (2, 3, 4):
        return {pointer: _Expected(f"float{owner.length}", owner.where, True)}
    return {
        pointer: _Expected("float[]", owner.where, False),
        f"{pointer}/{{}}": _Expected("float", owner.where, False),
        f"{pointer}.length": length,
    }
