"""Texture coordinates and tangents that materials read; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import POSITIONS, accessor, mesh

AT = "/meshes/0/primitives/0"
ACCESSORS = [POSITIONS, accessor("VEC2"), accessor("VEC4"), accessor()]
EXTENSIONS = ["KHR_materials_clearcoat", "KHR_materials_anisotropy", "KHR_texture_transform"]
EXTENSIONS += ["KHR_materials_iridescence", "KHR_materials_variants"]

# What they need is more than these tests ask about.
MINE = ("MESH_PRIMITIVE_TOO", "MESH_PRIMITIVE_NO_T", "MESH_PRIMITIVE_GEN", "UNUSED_MESH_TANGENT")


def worn(material: dict[str, Any], sets: int, *names: str, **more: Any) -> dict[str, Any]:
    """Return an asset whose primitive has so many UV sets, and the attributes `names`."""
    attributes = {"POSITION": 0, **{f"TEXCOORD_{number}": 1 for number in range(sets)}}
    attributes |= {name: {"TANGENT": 2, "NORMAL": 3}[name] for name in names}
    return {
        "extensionsUsed": EXTENSIONS,
        "accessors": ACCESSORS,
        "materials": [material],
        "meshes": [mesh(attributes, material=0, **more)],
        "textures": [{}],
    }


def told(codes: Codes, asset: dict[str, Any]) -> set[tuple[str, str | int | None]]:
    """Return what is said of tangents and UV sets; pointers from the primitive on."""
    return {
        (code, str(pointer).removeprefix(AT))
        for code, pointer in codes(asset, unused=True)
        if code.startswith(MINE) or (code == "UNUSED_OBJECT" and "/attributes/" in str(pointer))
    }


def texture(uv_set: int) -> dict[str, int]:
    return {"index": 0, "texCoord": uv_set}


TOO_FEW = ("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "/material")


def unused(number: int) -> tuple[str, str]:
    return "UNUSED_OBJECT", f"/attributes/TEXCOORD_{number}"


@pytest.mark.parametrize(
    "material",
    [
        {"occlusionTexture": texture(1)},
        {"pbrMetallicRoughness": {"baseColorTexture": texture(1)}},
        {"extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": texture(1)}}},
        {"extensions": {"KHR_materials_iridescence": {"iridescenceThicknessTexture": texture(1)}}},
    ],
)
def test_every_texture_finds_its_uv_set(codes: Codes, material: dict[str, Any]) -> None:
    assert told(codes, worn(material, 0)) == {TOO_FEW}
    assert told(codes, worn(material, 1)) == {TOO_FEW, unused(0)}
    assert told(codes, worn(material, 2)) == {unused(0)}
    assert told(codes, worn(material, 3)) == {unused(0), unused(2)}


def test_uv_sets_with_a_gap_are_none(codes: Codes) -> None:
    asset = worn({"occlusionTexture": texture(1)}, 0)
    asset["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1
    assert told(codes, asset) == {TOO_FEW}


@pytest.mark.parametrize(
    ("own", "transformed", "expected"),
    [(0, 1, set()), (1, 1, {unused(0)}), (0, 5, {TOO_FEW, unused(1)}), (5, 0, {TOO_FEW, unused(1)})],
)
def test_a_transform_changes_the_set_but_not_for_every_reader(
    codes: Codes, own: int, transformed: int, expected: set[tuple[str, str]]
) -> None:
    transform = {"extensions": {"KHR_texture_transform": {"texCoord": transformed}}}
    assert told(codes, worn({"occlusionTexture": {**texture(own), **transform}}, 2)) == expected


def test_without_a_material_no_uv_set_is_used(codes: Codes) -> None:
    asset = worn({}, 1)
    del asset["meshes"][0]["primitives"][0]["material"]
    assert told(codes, asset) == {unused(0)}


NORMAL_TEXTURE = {"normalTexture": texture(0)}
CLEARCOAT = {"extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture": texture(0)}}}
ANISOTROPY = {"extensions": {"KHR_materials_anisotropy": {"anisotropyTexture": texture(0)}}}


@pytest.mark.parametrize(
    ("material", "code"),
    [
        (NORMAL_TEXTURE, "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE"),
        (CLEARCOAT, "MESH_PRIMITIVE_NO_TANGENT_SPACE"),
        (ANISOTROPY, "MESH_PRIMITIVE_NO_TANGENT_SPACE"),
        ({**CLEARCOAT, **NORMAL_TEXTURE}, "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE"),
    ],
)
def test_materials_with_normals_want_tangents(codes: Codes, material: dict[str, Any], code: str) -> None:
    assert told(codes, worn(material, 1, "NORMAL")) == {(code, "/material")}
    assert told(codes, worn(material, 1, "TANGENT")) == {(code, "/material")}
    assert told(codes, worn(material, 1, "NORMAL", "TANGENT")) == set()


def test_tangents_that_no_texture_reads_are_told(codes: Codes) -> None:
    idle = {("UNUSED_MESH_TANGENT", "/attributes/TANGENT")}
    assert told(codes, worn({}, 0, "NORMAL", "TANGENT")) == idle
    anisotropic = {"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}}
    assert told(codes, worn(anisotropic, 0, "NORMAL", "TANGENT")) == idle


def with_variant(asset: dict[str, Any], material: dict[str, Any]) -> dict[str, Any]:
    """Let the asset's primitive wear `material` in its one variant."""
    asset["materials"].append(material)
    mapping = {"material": 1, "variants": [0]}
    extension = {"KHR_materials_variants": {"mappings": [mapping]}}
    asset["meshes"][0]["primitives"][0]["extensions"] = extension
    return {**asset, "extensions": {"KHR_materials_variants": {"variants": [{"name": "a"}]}}}


def test_the_materials_of_variants_read_uv_sets_too(codes: Codes) -> None:
    varied = {"occlusionTexture": texture(1)}
    few = ("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "/extensions/KHR_materials_variants/mappings/0/material")
    assert told(codes, with_variant(worn({"occlusionTexture": texture(0)}, 1), varied)) == {few}
    assert told(codes, with_variant(worn({"occlusionTexture": texture(0)}, 2), varied)) == set()


def test_tangents_that_a_variant_reads_are_used(codes: Codes) -> None:
    # The Khronos validator calls them unused: it looks at the primitive's own material only.
    assert told(codes, with_variant(worn({}, 1, "NORMAL", "TANGENT"), NORMAL_TEXTURE)) == set()
