"""What materials ask of the primitives that wear them: texture coordinates and tangents."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.attributes import attribute_names, count_of_sets
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of

__all__ = ["RULES"]

_TEXTURES = frozenset({"textureInfo", "normalTextureInfo", "occlusionTextureInfo"})

# Extensions whose texture means nothing without tangents.
_TANGENT_TEXTURES = {
    "KHR_materials_clearcoat": "clearcoatNormalTexture",
    "KHR_materials_anisotropy": "anisotropyTexture",
}


class _Needs:
    """What one material asks for: (pointer of a texture, its UV set), and whether it reads tangents."""

    __slots__ = ("has_normal_texture", "reads_tangents", "uv_sets")

    def __init__(self, material: Entry) -> None:
        self.uv_sets = [
            (texture.pointer, uv_set) for texture in _textures(material) for uv_set in _uv_sets(texture)
        ]
        self.has_normal_texture = "normalTexture" in material
        self.reads_tangents = self.has_normal_texture or any(
            texture in material.extensions.get(name, ()) for name, texture in _TANGENT_TEXTURES.items()
        )


def _surfaces(root: Entry, asset: Asset) -> Iterator[Issue]:
    known = [None if material is None else _Needs(material) for material in asset.array("materials")]
    for mesh in asset.array("meshes"):
        for primitive in mesh.get("primitives", ()) if mesh is not None else ():
            yield from _of_primitive(primitive, known)


def _of_primitive(primitive: Entry, known: list[_Needs | None]) -> Iterator[Issue]:
    names = attribute_names(primitive)
    own = known[primitive["material"]] if "material" in primitive else None
    worn = [] if own is None else [(own, primitive.at("material"))]
    variants = primitive.extensions.get("KHR_materials_variants")
    for mapping in variants.get("mappings", ()) if variants is not None else ():
        needs = known[mapping["material"]] if "material" in mapping else None
        if needs is not None:
            worn.append((needs, mapping.at("material")))
    if own is not None and own.reads_tangents and not ("TANGENT" in names and "NORMAL" in names):
        code = (
            "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE"
            if own.has_normal_texture
            else "MESH_PRIMITIVE_NO_TANGENT_SPACE"
        )
        yield issue(code, primitive.at("material"))
    if "TANGENT" in names and not any(needs.reads_tangents for needs, _ in worn):
        yield issue("UNUSED_MESH_TANGENT", primitive.at("attributes", "TANGENT"))
    yield from _texture_coordinates(primitive, worn, count_of_sets(names, "TEXCOORD") or 0)


def _texture_coordinates(primitive: Entry, worn: list[tuple[_Needs, str]], count: int) -> Iterator[Issue]:
    read = set()
    for needs, pointer in worn:
        for texture, uv_set in needs.uv_sets:
            read.add(uv_set)
            if uv_set >= count:
                yield issue("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", pointer, texture=texture, set=uv_set)
    for uv_set in range(count):
        if uv_set not in read:
            yield issue("UNUSED_OBJECT", primitive.at("attributes", f"TEXCOORD_{uv_set}"))


def _textures(holder: Entry) -> Iterator[Entry]:
    """Yield the places for textures in a material, in what it holds and in its extensions."""
    for inner in (*holder.values(), *holder.extensions.values()):
        for entry in inner if isinstance(inner, list) else (inner,):
            if isinstance(entry, Entry):
                if entry.table in _TEXTURES:
                    yield entry
                else:
                    yield from _textures(entry)


def _uv_sets(texture: Entry) -> Iterator[int]:
    """Yield the set that a texture reads, and the one that a reader without its transform falls back to."""
    transform = texture.extensions.get("KHR_texture_transform")
    if transform is not None and "texCoord" in transform:
        yield transform["texCoord"]
    if (uv_set := sound_value_of(texture, "texCoord")) is not None:
        yield uv_set


RULES: Rules = {"glTF": (_surfaces,)}
