"""Whatever one property of a sound file is turned into, every rule still gives an answer."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

import pytest
from judging import Judge
from small_data import FLOAT, IDENTITY, UNSIGNED_BYTE, UNSIGNED_SHORT, Data
from small_pictures import png

TRANSFORMED = {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": {"texCoord": 0}}}
MATERIAL = {
    "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0.0},
    "normalTexture": {"index": 0, "scale": 1.0},
    "emissiveFactor": [1.0, 1.0, 1.0],
    "extensions": {},
}
FILM = {
    "iridescenceFactor": 1.0,
    "iridescenceIor": 1.3,
    "iridescenceThicknessMinimum": 300.0,
    "iridescenceThicknessMaximum": 301.0,
    "iridescenceTexture": TRANSFORMED,
    "iridescenceThicknessTexture": TRANSFORMED,
}
LAYERS = {
    "braggFactor": 1.0,
    "hostIor": 1.0,
    "braggTexture": TRANSFORMED,
    "braggPeriodTexture": TRANSFORMED,
    "layers": [
        {"ior2": 1.6, "periodMinimum": 150.0, "periodMaximum": 150.5, "cells": 12, "fill": 0.5},
        {"ior1": 1.3, "ior2": 1.5, "periodMinimum": 150.0, "periodMaximum": 150.5, "cells": 12},
    ],
}
OTHERS: dict[str, Any] = {
    "KHR_materials_anisotropy": {"anisotropyTexture": {"index": 0}},
    "KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatNormalTexture": {"index": 0}},
    "KHR_materials_emissive_strength": {"emissiveStrength": 2.0},
    "KHR_materials_ior": {"ior": 1.4},
    "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1.0, 1.0, 1.0]},
    "KHR_materials_transmission": {"transmissionFactor": 0.0},
    "KHR_materials_volume": {"thicknessFactor": 1.0, "attenuationDistance": 1.0},
}


def surfaces() -> dict[str, Any]:
    """Return a film and layers with textures, which animation pointers move."""
    data = Data()
    film = {**OTHERS, "KHR_materials_iridescence": FILM}
    layers = {"EXT_materials_bragg": LAYERS}
    data.root["materials"] = [{**MATERIAL, "extensions": film}, {**MATERIAL, "extensions": layers}]
    data.root["images"] = [{"bufferView": data.view(png()), "mimeType": "image/png"}]
    data.root["textures"] = [{"source": 0}]
    uv_set = data.accessor("VEC2", FLOAT, [0.0] * 6)
    attributes = {"POSITION": data.positions(3), "TEXCOORD_0": uv_set}
    data.root["meshes"] = [
        {"primitives": [{"attributes": attributes, "material": index}]} for index in range(2)
    ]
    data.root["nodes"] = [{"mesh": 0}, {"mesh": 1}]
    times = data.accessor("SCALAR", FLOAT, [0.0, 1.0], min=[0], max=[1])
    zeros, ones = (data.accessor("SCALAR", FLOAT, [number] * 2) for number in (0.0, 1.0))
    paths = (
        "0/extensions/KHR_materials_iridescence/iridescenceFactor",
        "1/extensions/EXT_materials_bragg/hostIor",
        "1/extensions/EXT_materials_bragg/layers/0/fill",
        "1/pbrMetallicRoughness/metallicFactor",
    )
    pointers = [{"KHR_animation_pointer": {"pointer": f"/materials/{path}"}} for path in paths]
    channels = [
        {"sampler": int("hostIor" in path), "target": {"path": "pointer", "extensions": pointer}}
        for path, pointer in zip(paths, pointers, strict=True)
    ]
    samplers = [{"input": times, "output": values, "interpolation": "LINEAR"} for values in (zeros, ones)]
    data.root["animations"] = [{"channels": channels, "samplers": samplers}]
    names = [*film, *layers, "KHR_texture_transform", "KHR_animation_pointer"]
    return {**data.asset, "extensionsUsed": names}


def moving_parts() -> dict[str, Any]:
    """Return a skinned mesh with morph targets and sparse elements, a spline, a light and a variant."""
    data = Data()
    positions, moved = data.positions(3), data.positions(3)
    data.accessors[moved]["sparse"] = data.sparse([0, 2], FLOAT, [0.0] * 6)
    attributes = {
        "POSITION": positions,
        "NORMAL": data.accessor("VEC3", FLOAT, [0.0, 0.0, 1.0] * 3),
        "TANGENT": data.accessor("VEC4", FLOAT, [1.0, 0.0, 0.0, 1.0] * 3),
        "TEXCOORD_0": data.accessor("VEC2", FLOAT, [0.0] * 6),
        "COLOR_0": data.accessor("VEC3", FLOAT, [1.0] * 9, 16),
        "JOINTS_0": data.accessor("VEC4", UNSIGNED_BYTE, [0, 1, 0, 0] * 3),
        "WEIGHTS_0": data.accessor("VEC4", FLOAT, [0.5, 0.5, 0.0, 0.0] * 3),
    }
    primitive = {
        "attributes": attributes,
        "indices": data.accessor("SCALAR", UNSIGNED_SHORT, [0, 1, 2]),
        "targets": [{"POSITION": moved}],
        "mode": 4,
        "material": 0,
        "extensions": {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}]}},
    }
    times = data.accessor("SCALAR", FLOAT, [0.0, 1.0], min=[0], max=[1])
    turns = data.accessor("VEC4", FLOAT, [0.0, 0.0, 0.0, 1.0] * 6)
    weights = data.accessor("SCALAR", FLOAT, [0.0, 1.0])
    data.root |= {
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants"],
        "extensions": {
            "KHR_lights_punctual": {
                "lights": [{"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]
            },
            "KHR_materials_variants": {"variants": [{"name": "worn"}]},
        },
        "materials": [{"normalTexture": {"index": 0}, "alphaCutoff": 0.5, "alphaMode": "MASK"}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9729}],
        "images": [{"uri": "missing.png"}],
        "meshes": [{"primitives": [primitive], "weights": [0.5]}],
        "skins": [
            {
                "joints": [1, 2],
                "skeleton": 1,
                "inverseBindMatrices": data.accessor("MAT4", FLOAT, IDENTITY * 2),
            }
        ],
        "nodes": [
            {"mesh": 0, "skin": 0, "weights": [0.5]},
            {"children": [2], "rotation": [0.0, 0.0, 0.0, 1.0]},
            {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
        ],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1, "zfar": 10.0}}],
        "scenes": [{"nodes": [0, 1]}],
        "scene": 0,
        "animations": [
            {
                "samplers": [
                    {"input": times, "output": turns, "interpolation": "CUBICSPLINE"},
                    {"input": times, "output": weights},
                ],
                "channels": [
                    {"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                    {"sampler": 1, "target": {"node": 0, "path": "weights"}},
                ],
            }
        ],
    }
    return data.asset


def places(value: Any, *keys: str | int) -> Iterator[tuple[str | int, ...]]:
    """Yield the keys that lead to everything inside `value`; of arrays of numbers, to the first two."""
    items = value.items() if isinstance(value, dict) else ()
    if isinstance(value, list):
        items = enumerate(value if isinstance(value[0], dict) else value[:2])
    for key, inner in items:
        yield (*keys, key)
        yield from places(inner, *keys, key)


def holder_of(asset: dict[str, Any], keys: tuple[str | int, ...]) -> Any:
    """Return the object or array that holds the last of `keys`."""
    holder: Any = asset
    for key in keys[:-1]:
        holder = holder[key]
    return holder


@pytest.mark.parametrize("build", [surfaces, moving_parts])
def test_the_files_are_sound_before_they_are_broken(build: Any, judge: Judge) -> None:
    found = {(i.code, i.pointer) for i in judge(build()).issues if i.severity == 0}
    assert found <= {("IO_ERROR", "/images/0/uri")}


@pytest.mark.parametrize("build", [surfaces, moving_parts])
@pytest.mark.parametrize("wrong", ["x", -1, 10**400, None], ids=["text", "negative", "huge", "null"])
def test_a_broken_property_stops_no_rule(wrong: Any, build: Any, judge: Judge) -> None:
    sound = build()
    for keys in places(sound):
        asset = copy.deepcopy(sound)
        holder_of(asset, keys)[keys[-1]] = wrong
        judge(asset, max_issues=0)


@pytest.mark.parametrize("build", [surfaces, moving_parts])
def test_a_missing_property_stops_no_rule(build: Any, judge: Judge) -> None:
    sound = build()
    for keys in places(sound):
        asset = copy.deepcopy(sound)
        del holder_of(asset, keys)[keys[-1]]
        judge(asset, max_issues=0)
