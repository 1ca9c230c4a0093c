"""The sample of everything holds every property of EXT_materials_bragg, and points at what is there."""

from __future__ import annotations

import json
import struct
from typing import Any

import pytest

from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.fields import properties
from gltf_iri.samples import bragg_everything

Json = dict[str, Any]


@pytest.fixture(scope="module")
def gltf() -> Json:
    (glb,) = bragg_everything.build().files.values()
    (length,) = struct.unpack("<I", glb[12:16])
    read: Json = json.loads(glb[20 : 20 + length])
    return read


def braggs(gltf: Json) -> list[Json]:
    return [material["extensions"][Bragg.EXTENSION] for material in gltf["materials"]]


def test_every_property_is_stated_on_some_material(gltf: Json) -> None:
    stated = {name for bragg in braggs(gltf) for name in bragg}
    assert stated == {row.key for _, row in properties(Bragg)}
    of_layers = {name for bragg in braggs(gltf) for layer in bragg.get("layers", []) for name in layer}
    assert of_layers == {row.key for _, row in properties(MirrorLayer)}


def test_defaults_are_met_too(gltf: Json) -> None:
    assert {} in braggs(gltf)
    assert any({} in bragg.get("layers", []) for bragg in braggs(gltf))


def test_both_textures_read_the_second_coordinates_by_each_of_the_two_ways(gltf: Json) -> None:
    four = braggs(gltf)[0]
    assert four["braggTexture"]["texCoord"] == 1
    assert "texCoord" not in four["braggPeriodTexture"]
    transforms = [
        four[name]["extensions"]["KHR_texture_transform"] for name in ("braggTexture", "braggPeriodTexture")
    ]
    assert transforms[1]["texCoord"] == 1
    for transform in transforms:
        assert set(transform) & {"offset", "rotation", "scale"}
    for primitive in (p for mesh in gltf["meshes"] for p in mesh["primitives"]):
        reached = {primitive["material"]}
        mappings = primitive.get("extensions", {}).get("KHR_materials_variants", {}).get("mappings", [])
        reached |= {mapping["material"] for mapping in mappings}
        assert ("TEXCOORD_1" in primitive["attributes"]) == (0 in reached)


def test_periods_run_both_ways(gltf: Json) -> None:
    layers = [layer for bragg in braggs(gltf) for layer in bragg.get("layers", []) if layer]
    assert any(layer["periodMinimum"] < layer["periodMaximum"] for layer in layers)
    assert any(layer["periodMinimum"] > layer["periodMaximum"] for layer in layers)


def test_every_pointer_leads_to_a_number_that_the_animation_starts_from(gltf: Json) -> None:
    (animation,) = gltf["animations"]
    pointers = [
        channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"]
        for channel in animation["channels"]
    ]
    assert pointers == list(bragg_everything.TRACKS)
    assert len(set(pointers)) == len(pointers)
    for pointer, values in bragg_everything.TRACKS.items():
        found: Any = gltf
        for step in pointer.split("/")[1:]:
            found = found[int(step)] if isinstance(found, list) else found[step]
        assert list(found) == list(values[0]) if isinstance(found, list) else found == values[0], pointer


def test_whole_numbers_are_not_animated() -> None:
    assert not any(pointer.endswith("/cells") for pointer in bragg_everything.TRACKS)
