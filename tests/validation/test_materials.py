"""What does nothing or fits badly in a material; expectations are the Khronos validator's, but where said."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes

M = "/materials/0"


def of(
    extensions: dict[str, Any] | None = None, declared: list[str] | None = None, **more: Any
) -> dict[str, Any]:
    """Return an asset of one material, its KHR_materials extensions by their short names."""
    full = {
        name if "_" in name and name[0].isupper() else f"KHR_materials_{name}": value
        for name, value in (extensions or {}).items()
    }
    names = [*full] if declared is None else declared
    material = {**more, **({"extensions": full} if full else {})}
    return {
        **({"extensionsUsed": [*names, "KHR_texture_transform"]} if names else {}),
        "materials": [material],
        "textures": [{}],
    }


def at(extension: str, key: str = "") -> str:
    return f"{M}/extensions/KHR_materials_{extension}{key}"


def told(codes: Codes, asset: dict[str, Any]) -> set[tuple[str, str | int | None]]:
    return {(code, place) for code, place in codes(asset) if code != "UNSUPPORTED_EXTENSION"}


@pytest.mark.parametrize("mode", ["OPAQUE", "BLEND", None])
def test_only_masks_have_a_cutoff(codes: Codes, mode: str | None) -> None:
    stated = {"alphaMode": mode} if mode else {}
    assert codes(of(**stated, alphaCutoff=0.5)) == {
        ("MATERIAL_ALPHA_CUTOFF_INVALID_MODE", f"{M}/alphaCutoff")
    }
    assert codes(of(**stated)) == set()
    assert codes(of(alphaMode="MASK", alphaCutoff=0.5)) == set()


@pytest.mark.parametrize(("cutoff", "code"), [(-1, "VALUE_NOT_IN_RANGE"), ("a", "TYPE_MISMATCH")])
def test_a_broken_cutoff_is_one_too(codes: Codes, cutoff: Any, code: str) -> None:
    place = f"{M}/alphaCutoff"
    assert codes(of(alphaCutoff=cutoff)) == {(code, place), ("MATERIAL_ALPHA_CUTOFF_INVALID_MODE", place)}


ZERO_EMISSION = ("KHR_MATERIALS_EMISSIVE_STRENGTH_ZERO_FACTOR", at("emissive_strength"))


@pytest.mark.parametrize(
    ("strength", "factor", "speaks"),
    [
        ({"emissiveStrength": 2}, None, True),
        ({"emissiveStrength": 2}, [0, 0, 0], True),
        ({"emissiveStrength": 0}, None, True),
        ({"emissiveStrength": 2}, [0, 0, 0.1], False),
        ({"emissiveStrength": 1}, None, False),
        ({}, None, False),
        # What is broken is told of once.
        ({"emissiveStrength": -1}, None, False),
        ({"emissiveStrength": 2}, [2, 0, 0], False),
        ({"emissiveStrength": 2}, "a", False),
    ],
)
def test_a_strength_multiplies_some_emission(
    codes: Codes, strength: dict[str, Any], factor: Any, speaks: bool
) -> None:
    stated = {} if factor is None else {"emissiveFactor": factor}
    assert (ZERO_EMISSION in codes(of({"emissive_strength": strength}, **stated))) == speaks


def test_dispersion_happens_in_a_volume(codes: Codes) -> None:
    alone = {"dispersion": {"dispersion": 1}}
    assert codes(of(alone)) == {("KHR_MATERIALS_DISPERSION_NO_VOLUME", at("dispersion"))}
    assert codes(of({**alone, "volume": {}, "transmission": {}})) == set()
    declared = ["KHR_materials_dispersion"]
    assert told(codes, of({**alone, "volume": {}}, declared)) == {("UNDECLARED_EXTENSION", at("volume"))}


NO_TRANSMISSION = ("KHR_MATERIALS_VOLUME_NO_TRANSMISSION", at("volume"))


@pytest.mark.parametrize("others", [{}, {"ior": {}}, {"clearcoat": {}, "sheen": {}}])
def test_a_volume_that_lets_no_light_in_is_told(codes: Codes, others: dict[str, Any]) -> None:
    assert codes(of({"volume": {}, **others})) == {NO_TRANSMISSION}


@pytest.mark.parametrize(
    "others",
    [{"transmission": {}}, {"diffuse_transmission": {}}, {"X_glass": {}}, {"transmission": {}, "ior": {}}],
)
def test_transmission_and_what_nobody_knows_let_light_in(codes: Codes, others: dict[str, Any]) -> None:
    assert told(codes, of({"volume": {}, **others})) == set()


def test_an_undeclared_extension_may_let_light_in(codes: Codes) -> None:
    asset = of({"volume": {}, "ior": {}}, ["KHR_materials_volume"])
    assert codes(asset) == {("UNDECLARED_EXTENSION", at("ior"))}


@pytest.mark.parametrize(
    ("volume", "double_sided", "speaks"),
    [
        ({"thicknessFactor": 1}, True, True),
        ({"thicknessFactor": 1}, False, False),
        ({"thicknessFactor": 0}, True, False),
        ({"thicknessTexture": {"index": 0}}, True, False),
        ({"thicknessFactor": -1}, True, False),
        ({"thicknessFactor": 1}, 1, False),
    ],
)
def test_a_body_is_seen_from_one_side(
    codes: Codes, volume: dict[str, Any], double_sided: Any, speaks: bool
) -> None:
    issue = ("KHR_MATERIALS_VOLUME_DOUBLE_SIDED", at("volume"))
    asset = of({"volume": volume, "transmission": {}}, doubleSided=double_sided)
    assert (issue in codes(asset)) == speaks


TANGENT_TEXTURES = [
    ("anisotropy", "anisotropyTexture", "KHR_MATERIALS_ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD"),
    ("clearcoat", "clearcoatNormalTexture", "KHR_MATERIALS_CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD"),
]


def texture(uv_set: Any = None, transformed: Any = None) -> dict[str, Any]:
    transform = {"extensions": {"KHR_texture_transform": {"texCoord": transformed}}}
    return {
        "index": 0,
        **({} if uv_set is None else {"texCoord": uv_set}),
        **({} if transformed is None else transform),
    }


@pytest.mark.parametrize(("extension", "key", "code"), TANGENT_TEXTURES)
@pytest.mark.parametrize(
    ("normals", "other", "speaks"),
    [
        (texture(), texture(), False),
        (texture(1), texture(1), False),
        (texture(0), texture(1), True),
        (texture(1), texture(), True),
        (None, texture(1), False),
        (texture(1), None, False),
        # A UV set that is broken is not the other's.
        (texture("a"), texture(0), True),
        (texture(0), texture(-1), True),
        # A transform may name another set; the Khronos validator does not look at it here.
        (texture(0, 1), texture(1), False),
        (texture(0), texture(1, 0), False),
        (texture(0, 1), texture(0), True),
        (texture(1, "a"), texture(1), False),
    ],
)
def test_textures_that_turn_with_tangents_share_a_uv_set(
    codes: Codes, extension: str, key: str, code: str, normals: Any, other: Any, speaks: bool
) -> None:
    stated = {} if normals is None else {"normalTexture": normals}
    asset = of({extension: {} if other is None else {key: other}}, **stated)
    assert ((code, at(extension, f"/{key}")) in codes(asset)) == speaks


@pytest.mark.parametrize(
    ("stated", "speaks"),
    [
        ({"iridescenceThicknessMinimum": 100}, True),
        ({"iridescenceThicknessMinimum": 100, "iridescenceThicknessTexture": 5}, True),
        ({"iridescenceThicknessMaximum": 100}, False),
        ({"iridescenceThicknessMinimum": 100, "iridescenceThicknessTexture": {"index": 0}}, False),
        ({"iridescenceThicknessMinimum": 100, "iridescenceThicknessTexture": {}}, False),
        ({"iridescenceThicknessMinimum": -1}, False),
    ],
)
def test_a_minimum_needs_a_texture(codes: Codes, stated: dict[str, Any], speaks: bool) -> None:
    place = at("iridescence", "/iridescenceThicknessMinimum")
    issue = ("KHR_MATERIALS_IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE", place)
    assert (issue in codes(of({"iridescence": stated}))) == speaks


@pytest.mark.parametrize(
    ("stated", "speaks"),
    [
        ({"iridescenceThicknessMinimum": 400}, True),
        ({"iridescenceThicknessMaximum": 100}, True),
        ({"iridescenceThicknessMinimum": 50, "iridescenceThicknessMaximum": 50.0}, True),
        ({}, False),
        ({"iridescenceThicknessMinimum": 500}, False),
        # Both broken, they are not equal.
        ({"iridescenceThicknessMinimum": -1, "iridescenceThicknessMaximum": -1}, False),
        ({"iridescenceThicknessMinimum": 400, "iridescenceThicknessMaximum": -1}, False),
    ],
)
def test_a_texture_chooses_between_two_thicknesses(
    codes: Codes, stated: dict[str, Any], speaks: bool
) -> None:
    place = at("iridescence", "/iridescenceThicknessTexture")
    asset = of({"iridescence": {**stated, "iridescenceThicknessTexture": {"index": 0}}})
    assert (("KHR_MATERIALS_IRIDESCENCE_THICKNESS_TEXTURE_UNUSED", place) in codes(asset)) == speaks


@pytest.mark.parametrize(
    ("extension", "key", "sound", "broken"),
    [
        ("anisotropy", "anisotropyStrength", (0, 1), (-0.1, 1.1)),
        ("anisotropy", "anisotropyRotation", (-99, 99), ()),
        ("clearcoat", "clearcoatFactor", (0, 1), (-0.1, 1.1)),
        ("clearcoat", "clearcoatRoughnessFactor", (0, 1), (-0.1, 1.1)),
        ("dispersion", "dispersion", (0, 1, 20), (-0.1,)),
        ("emissive_strength", "emissiveStrength", (0, 1, 1e30), (-0.1,)),
        ("ior", "ior", (0, 1, 1e9), (0.5, 0.999, -1)),
        ("iridescence", "iridescenceFactor", (0, 1), (-0.1, 1.1)),
        ("iridescence", "iridescenceIor", (1, 9), (0, 0.999)),
        ("iridescence", "iridescenceThicknessMaximum", (0, 1e6), (-1,)),
        ("pbrSpecularGlossiness", "glossinessFactor", (0, 1), (-0.1, 1.1)),
        ("sheen", "sheenRoughnessFactor", (0, 1), (-0.1, 1.1)),
        ("specular", "specularFactor", (0, 1), (-0.1, 1.1)),
        ("transmission", "transmissionFactor", (0, 1), (-0.1, 1.1)),
        ("volume", "thicknessFactor", (0, 9), (-0.1,)),
        ("volume", "attenuationDistance", (1e-300, 9), (0, -1)),
    ],
)
def test_numbers_stay_in_their_range(
    codes: Codes, extension: str, key: str, sound: tuple[float, ...], broken: tuple[float, ...]
) -> None:
    issue = ("VALUE_NOT_IN_RANGE", at(extension, f"/{key}"))
    for value in sound:
        assert issue not in codes(of({extension: {key: value}}))
    for value in broken:
        assert issue in codes(of({extension: {key: value}}))


@pytest.mark.parametrize(
    ("extension", "key", "may_be_above_one"),
    [
        ("sheen", "sheenColorFactor", False),
        ("specular", "specularColorFactor", True),
        ("volume", "attenuationColor", False),
        ("pbrSpecularGlossiness", "specularFactor", False),
    ],
)
def test_colours_stay_in_their_range(codes: Codes, extension: str, key: str, may_be_above_one: bool) -> None:
    issue = ("VALUE_NOT_IN_RANGE", at(extension, f"/{key}/0"))
    assert issue in codes(of({extension: {key: [-0.1, 0, 0]}}))
    assert issue not in codes(of({extension: {key: [1, 0, 0]}}))
    assert (issue in codes(of({extension: {key: [1.1, 0, 0]}}))) != may_be_above_one


def test_what_is_no_object_counts_as_an_empty_extension(codes: Codes) -> None:
    assert codes(of({"dispersion": 5})) == {
        ("TYPE_MISMATCH", at("dispersion")),
        ("KHR_MATERIALS_DISPERSION_NO_VOLUME", at("dispersion")),
    }
