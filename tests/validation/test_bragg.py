"""Layers whose numbers move, are broken, or stand where no layer is drawn: what is then not said."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes, Judge
from small_data import FLOAT, Data
from small_pictures import png

NAME = "EXT_materials_bragg"
AT = f"/materials/0/extensions/{NAME}"
LAYER = {"ior2": 1.5, "periodMaximum": 210.0, "cells": 12}
PERIODS = {"index": 0}


def mirror(
    *layers: dict[str, Any],
    moved: dict[str, list[float]] | None = None,
    extensions: dict[str, Any] | None = None,
    picture: bytes = b"",
    metallic: float = 0.0,
    **more: Any,
) -> dict[str, Any]:
    """Return a material with `layers`; `moved` are values by pointer, below the extension or the root."""
    others = extensions or {}
    names = [NAME, *others, *(["KHR_animation_pointer"] if moved else [])]
    data = Data(extensionsUsed=names)
    material = {
        "pbrMetallicRoughness": {"metallicFactor": metallic},
        "extensions": {NAME: {"braggFactor": 1.0, "layers": list(layers), **more}, **others},
    }
    data.root["materials"] = [material]
    if picture:
        data.root["images"] = [{"bufferView": data.view(picture), "mimeType": "image/png"}]
        data.root["textures"] = [{"source": 0}, {"source": 0}]
    samplers, channels = [], []
    for pointer, values in (moved or {}).items():
        times = data.accessor("SCALAR", FLOAT, [*range(len(values))], min=[0], max=[len(values) - 1])
        samplers.append({"input": times, "output": data.accessor("SCALAR", FLOAT, values)})
        whole = pointer if pointer.startswith("/") else f"{AT}/{pointer}"
        target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": whole}}}
        channels.append({"sampler": len(samplers) - 1, "target": target})
    if moved:
        data.root["animations"] = [{"samplers": samplers, "channels": channels}]
    return data.asset


def told(codes: Codes, asset: dict[str, Any]) -> set[str]:
    """Return our codes about layers, without their beginning."""
    return {code.removeprefix("IRI_BRAGG_") for code, _ in codes(asset) if code.startswith("IRI_BRAGG_")}


@pytest.mark.parametrize(
    ("layer", "code", "moving"),
    [
        ({"periodMinimum": 300.0}, "PERIODS_REVERSED", ["layers/0/periodMinimum", "layers/0/periodMaximum"]),
        (
            {"periodMinimum": 210.0},
            "PERIOD_TEXTURE_UNUSED",
            ["layers/0/periodMinimum", "layers/0/periodMaximum"],
        ),
        ({"ior2": 1.0}, "NO_MIRROR", ["layers/0/ior2", "hostIor"]),
        ({"ior1": 1.5}, "NO_MIRROR", ["layers/0/ior1", "layers/0/ior2"]),
        ({"fill": 1.0}, "NO_MIRROR", ["layers/0/fill"]),
        ({"periodMaximum": 0.0}, "NO_MIRROR", ["layers/0/periodMinimum", "layers/0/periodMaximum"]),
        ({"fill": 0.0}, "ONE_FILM", ["layers/0/fill"]),
    ],
)
def test_where_a_moving_number_starts_says_nothing(
    layer: dict[str, Any], code: str, moving: list[str], codes: Codes
) -> None:
    layer = {"periodMinimum": 0.0, **LAYER, **layer}
    assert code in told(codes, mirror(layer, braggPeriodTexture=PERIODS))
    for pointer in moving:
        start = layer.get(pointer.rpartition("/")[2], 1.0)
        moved = {pointer: [start, 0.9 * start + 0.05]}
        assert code not in told(codes, mirror(layer, moved=moved, braggPeriodTexture=PERIODS)), pointer


def test_a_host_that_moves_moves_only_films_that_follow_it(codes: Codes) -> None:
    same = {**LAYER, "ior1": 1.5}
    assert "NO_MIRROR" in told(codes, mirror(same, moved={"hostIor": [1.0, 1.2]}))


@pytest.mark.parametrize("key", ["ior1", "ior2", "fill", "cells", "periodMinimum", "periodMaximum"])
def test_of_a_layer_with_a_broken_number_nothing_is_worked_out(key: str, codes: Codes) -> None:
    broken = {**LAYER, "ior2": 1.0, "periodMinimum": 300.0, key: "x"}
    picture = png()
    found = told(codes, mirror(broken, braggPeriodTexture=PERIODS, picture=picture, metallic=1.0))
    assert found <= {"PERIODS_REVERSED"}
    assert found == set() or not key.startswith("period")


def test_of_layers_without_effect_no_picture_speaks(codes: Codes) -> None:
    wide = {**LAYER, "periodMinimum": 1.0, "periodMaximum": 900.0}
    grey: dict[str, Any] = {"picture": png(colour_type=0), "braggPeriodTexture": PERIODS}
    assert "PERIOD_GREY" in told(codes, mirror(wide, **grey))
    unlit = mirror(wide, extensions={"KHR_materials_unlit": {}}, **grey)
    assert told(codes, unlit) == {"EXCLUDED"}
    assert told(codes, mirror(wide, braggFactor=0.0, **grey)) == {"FACTOR_ZERO"}


@pytest.mark.parametrize("colour_type", [0, 4])
def test_a_grey_image_has_one_channel_for_both_textures(colour_type: int, codes: Codes) -> None:
    wide = {**LAYER, "periodMinimum": 1.0}
    asset = mirror(
        wide, picture=png(colour_type=colour_type), braggPeriodTexture=PERIODS, braggTexture=PERIODS
    )
    assert told(codes, asset) & {"ONE_CHANNEL", "PERIOD_GREY"} == {"ONE_CHANNEL"}
    asset["materials"][0]["extensions"][NAME]["braggTexture"] = {"index": 1}
    assert told(codes, asset) & {"ONE_CHANNEL", "PERIOD_GREY"} == {"PERIOD_GREY"}


@pytest.mark.parametrize("key", ["braggTexture", "braggPeriodTexture"])
def test_both_textures_have_one_uv_set(key: str, judge: Judge) -> None:
    def overridden(**transform: int) -> list[str | None]:
        info = {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": transform}}
        asset = mirror({**LAYER, "periodMinimum": 1.0}, **{key: info})
        asset["extensionsUsed"].append("KHR_texture_transform")
        return [i.pointer for i in judge(asset).issues if i.code == "IRI_BRAGG_TEXCOORD_OVERRIDDEN"]

    assert overridden(texCoord=1) == [f"{AT}/{key}/texCoord"]
    assert overridden(texCoord=0) == overridden() == []


def test_of_two_layers_only_the_one_that_states_an_index_leaves_the_host(judge: Judge) -> None:
    asset = mirror(LAYER, {**LAYER, "ior1": 1.0}, moved={"hostIor": [1.0, 1.5]}, metallic=1.0)
    (found,) = (i for i in judge(asset).issues if i.code == "IRI_BRAGG_FIRST_INDEX_ANIMATED")
    assert f"{AT}/layers/1/ior1" in found.message


@pytest.mark.parametrize(("last", "expected"), [(0.0, set()), (0.5, {"FIRST_INDEX_ANIMATED"})])
def test_under_a_bending_layer_an_animation_may_keep_a_base_diffuse(
    last: float, expected: set[str], codes: Codes
) -> None:
    moved = {"/materials/0/pbrMetallicRoughness/metallicFactor": [0.0, last]}
    assert told(codes, mirror({**LAYER, "ior1": 1.3}, moved=moved)) == expected
