"""The links: what indices refer to, and what nothing refers to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from small_meshes import BUFFER, POSITIONS, TIMES

Codes = Callable[..., set[tuple[str, str | int | None]]]

LIGHTS, VARIANTS = "KHR_lights_punctual", "KHR_materials_variants"
NAMED = {"name": "x", "extras": {}}
VIEW = {"buffer": 0, "byteLength": 4}
SPARSE = {
    "count": 1,
    "indices": {"bufferView": 0, "componentType": 5121},
    "values": {"bufferView": 1},
}


def unused(told: set[tuple[str, str | int | None]]) -> set[str | int | None]:
    return {pointer for code, pointer in told if code == "UNUSED_OBJECT"}


@pytest.mark.parametrize(
    ("asset", "pointer"),
    [
        ({"scene": 0}, "/scene"),
        ({"scenes": [{"nodes": [3]}]}, "/scenes/0/nodes/0"),
        ({"nodes": [{"extras": {}, "mesh": 0}]}, "/nodes/0/mesh"),
        ({"nodes": [{"extras": {}, "children": [1]}, 5]}, "/nodes/0/children/0"),
        ({"bufferViews": [VIEW]}, "/bufferViews/0/buffer"),
        ({"skins": [{"joints": [0], "skeleton": 7}], "nodes": [NAMED]}, "/skins/0/skeleton"),
        (
            {
                "accessors": [POSITIONS],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_A": 1}}]}],
            },
            "/meshes/0/primitives/0/attributes/_A",
        ),
        ({"materials": [{"normalTexture": {"index": 2**60}}]}, "/materials/0/normalTexture/index"),
    ],
)
def test_an_index_refers_to_something(asset: dict[str, Any], pointer: str, codes: Codes) -> None:
    assert ("UNRESOLVED_REFERENCE", pointer) in codes(asset)


def test_what_is_referred_to_is_used_whoever_refers(codes: Codes) -> None:
    asset = {
        "materials": [{"normalTexture": {"index": 0}}],
        "textures": [{"source": 0, "sampler": 0}, {}],
        "samplers": [{}],
        "images": [{"bufferView": 0, "mimeType": "image/png"}],
        "bufferViews": [VIEW],
        "buffers": [BUFFER],
    }
    assert unused(codes(asset, unused=True)) == {"/materials/0", "/textures/1"}


def test_scenes_and_animations_are_used_by_themselves(codes: Codes) -> None:
    channel = {"sampler": 0, "target": {"path": "translation"}}
    asset = {
        "scenes": [{"nodes": [0]}, {}],
        "nodes": [NAMED],
        "accessors": [TIMES, POSITIONS | {"count": 2}],
        "animations": [{"channels": [channel], "samplers": [{"input": 0, "output": 1}]}],
    }
    assert unused(codes(asset, unused=True)) == set()


def test_joints_are_used_and_the_skeleton_is_not(codes: Codes) -> None:
    asset = {"nodes": [{"children": [1]}, {}], "skins": [{"joints": [1], "skeleton": 0}]}
    assert unused(codes(asset, unused=True)) == {"/nodes/0", "/skins/0"}


@pytest.mark.parametrize(
    ("extension", "lists", "carrier", "left"),
    [
        (
            LIGHTS,
            {"lights": [{"type": "point"}, {"type": "point"}]},
            {"nodes": [{"extensions": {LIGHTS: {"light": 0}}}]},
            {"/nodes/0", f"/extensions/{LIGHTS}/lights/1"},
        ),
        (LIGHTS, {"lights": [{"type": "point"}]}, {}, {f"/extensions/{LIGHTS}/lights/0"}),
        (
            VARIANTS,
            {"variants": [{"name": "a"}, {"name": "b"}]},
            {
                "accessors": [POSITIONS],
                "materials": [{}, {}],
                "meshes": [
                    {
                        "primitives": [
                            {
                                "attributes": {"POSITION": 0},
                                "extensions": {VARIANTS: {"mappings": [{"variants": [1], "material": 1}]}},
                            }
                        ]
                    }
                ],
            },
            {"/meshes/0", "/materials/0", f"/extensions/{VARIANTS}/variants/0"},
        ),
    ],
)
def test_lists_of_extensions_are_used_as_the_core_s_are(
    extension: str, lists: dict[str, Any], carrier: dict[str, Any], left: set[str], codes: Codes
) -> None:
    asset = {"extensionsUsed": [extension], "extensions": {extension: lists}, **carrier}
    assert unused(codes(asset, unused=True)) == left


def test_an_unknown_extension_uses_nothing(codes: Codes) -> None:
    asset = {
        "extensionsUsed": ["XX_own"],
        "materials": [{"extensions": {"XX_own": {"texture": {"index": 0}}}}],
        "textures": [{}],
    }
    assert unused(codes(asset, unused=True)) == {"/materials/0", "/textures/0"}


def test_a_mirror_of_layers_uses_its_textures(codes: Codes) -> None:
    asset = {
        "extensionsUsed": ["EXT_materials_bragg"],
        "materials": [{"extensions": {"EXT_materials_bragg": {"braggTexture": {"index": 0}}}}],
        "textures": [{}],
    }
    assert unused(codes(asset, unused=True)) == {"/materials/0"}


def test_a_sampler_of_an_animation_is_used_by_a_channel(codes: Codes) -> None:
    asset = {
        "accessors": [TIMES, POSITIONS | {"count": 2}],
        "animations": [
            {
                "channels": [{"sampler": 1, "target": {"path": "translation"}}],
                "samplers": [{"input": 0, "output": 1}, {"input": 0, "output": 1}],
            }
        ],
    }
    assert unused(codes(asset, unused=True)) == {"/animations/0/samplers/0"}


@pytest.mark.parametrize("missing", ["channels", "samplers"])
def test_half_an_animation_refers_to_nothing(missing: str, codes: Codes) -> None:
    halves = {
        "channels": [{"sampler": 0, "target": {"path": "translation", "node": 9}}],
        "samplers": [{"input": 0, "output": 8}],
    }
    del halves[missing]
    assert codes({"accessors": [TIMES], "animations": [halves]}, unused=True) == {
        ("UNDEFINED_PROPERTY", "/animations/0"),
        ("UNUSED_OBJECT", "/accessors/0"),
    }


@pytest.mark.parametrize("missing", ["count", "type", "componentType"])
def test_an_accessor_without_a_format_reads_nothing(missing: str, codes: Codes) -> None:
    accessor = {key: value for key, value in POSITIONS.items() if key not in (missing, "min", "max")}
    asset = {
        "accessors": [accessor | {"bufferView": 0}],
        "bufferViews": [VIEW | {"byteLength": 36}],
        "buffers": [BUFFER],
    }
    assert unused(codes(asset, unused=True)) == {"/accessors/0", "/bufferViews/0"}
    sound = asset | {"accessors": [POSITIONS | {"bufferView": 0}]}
    assert unused(codes(sound, unused=True)) == {"/accessors/0"}


@pytest.mark.parametrize("missing", ["count", "indices", "values"])
def test_a_part_of_sparse_values_refers_to_nothing(missing: str, codes: Codes) -> None:
    parts = {key: value for key, value in SPARSE.items() if key != missing}
    asset = {
        "accessors": [POSITIONS | {"sparse": parts}],
        "bufferViews": [VIEW, VIEW | {"byteLength": 12}],
        "buffers": [BUFFER],
    }
    told = codes(asset, unused=True)
    assert unused(told) == {"/accessors/0", "/bufferViews/0", "/bufferViews/1"}
    whole = codes(asset | {"accessors": [POSITIONS | {"sparse": SPARSE}]}, unused=True)
    assert unused(whole) == {"/accessors/0"}
