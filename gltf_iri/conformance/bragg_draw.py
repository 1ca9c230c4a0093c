"""Random rows of EXT_materials_bragg: materials as glTF JSON, light and viewer, of every kind in turn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

__all__ = ["BRAGG_KINDS", "Inputs", "drawn_number", "drawn_pose", "random_bragg_inputs"]

Inputs = dict[str, Any]

# What a row is mostly about; each has every tenth row.
BRAGG_KINDS: Final = (
    *("one rough layer", "two rough layers", "three or four layers", "in a host", "smooth layers"),
    *("many cells", "last layer bends", "over metal", "over glass", "period texture"),
)

_WHITE: Final = (1.0, 1.0, 1.0)


def drawn_number(g: np.random.Generator, low: float, high: float, decimals: int = 3) -> float:
    """Return a number of few decimals, even in [low, high]."""
    return round(float(g.uniform(low, high)), decimals)


def drawn_pose(g: np.random.Generator, least: float = 0.1) -> Inputs:
    """Return cosines from `least` to 1; in half of all rows the viewer stands near the mirrored light."""
    cos_i = drawn_number(g, least, 1.0)
    if g.random() < 0.5:
        cos_o = float(np.clip(round(cos_i + drawn_number(g, -0.1, 0.1), 3), least, 1.0))
        return {"cos_theta_i": cos_i, "cos_theta_o": cos_o, "cos_phi": drawn_number(g, -1.0, -0.95)}
    return {
        "cos_theta_i": cos_i,
        "cos_theta_o": drawn_number(g, least, 1.0),
        "cos_phi": drawn_number(g, -1.0, 1.0),
    }


def random_bragg_inputs(number: int, g: np.random.Generator) -> Inputs:
    """Return the inputs of random row `number`, whose kind is BRAGG_KINDS[number % 10]."""
    kind = BRAGG_KINDS[number % len(BRAGG_KINDS)]
    host = 1.0
    if kind == "in a host" or g.random() < 0.3:
        host = drawn_number(g, 1.0, 1.7)
    layers = [_layer(g, host, kind, of) for of in _counts(kind, g)]
    texture = drawn_number(g, 0.0, 1.0) if kind == "period texture" or g.random() < 0.1 else 1.0
    pbr, more = _base(g, kind)
    if kind == "last layer bends":
        layers[-1]["ior1"] = drawn_number(g, 1.0, 1.9) if g.random() < 0.5 else round(host + 0.2, 3)
    bragg: Inputs = {"braggFactor": 1.0}
    if g.random() < 0.3:
        bragg["braggFactor"] = drawn_number(g, 0.0, 1.0)
    if host != 1.0 or g.random() < 0.1:
        bragg["hostIor"] = host
    bragg["layers"] = layers
    return {
        "material": {"pbrMetallicRoughness": pbr, "extensions": {"EXT_materials_bragg": bragg, **more}},
        "bragg_texture": drawn_number(g, 0.0, 1.0) if g.random() < 0.2 else 1.0,
        "period_texture": texture,
        **drawn_pose(g),
    }


def _counts(kind: str, g: np.random.Generator) -> range:
    if kind == "three or four layers":
        return range(int(g.integers(3, 5)))
    if kind in ("one rough layer", "many cells"):
        return range(1)
    return range(2 if kind == "two rough layers" else int(g.integers(1, 4)))


def _layer(g: np.random.Generator, host: float, kind: str, number: int) -> Inputs:
    cells = int(np.exp(g.uniform(0.0, np.log(31.0))))
    period = drawn_number(g, 100.0, 1000.0, 1)
    roughness = drawn_number(g, 0.2, 1.0)
    index = drawn_number(g, 1.3, 2.2)
    if kind == "many cells":
        cells, period = int(g.integers(31, 201)), drawn_number(g, 100.0, 300.0, 1)
        roughness = 0.0 if g.random() < 0.7 else roughness
        # Weak contrasts, which many cells are for.
        index = round(host + drawn_number(g, 0.02, 0.3), 3)
    elif kind == "smooth layers" and (number == 0 or g.random() < 0.5):
        roughness = 0.0
    elif cells * period > 2000.0 and g.random() < 0.8:
        cells = max(1, int(2000.0 / period))
    layer: Inputs = {} if g.random() < 0.9 else {"ior1": host}
    layer |= {"ior2": index, "periodMinimum": period, "periodMaximum": period}
    if kind == "period texture":
        layer["periodMinimum"] = drawn_number(g, 100.0, 1000.0, 1)
    fill = drawn_number(g, 0.1, 0.9)
    return {**layer, "fill": fill, "cells": cells, "roughness": roughness}


def _base(g: np.random.Generator, kind: str) -> tuple[Inputs, Mapping[str, Any]]:
    """Return pbrMetallicRoughness, and the extensions of what lets light through."""
    colour = [drawn_number(g, 0.0, 1.0) for _ in _WHITE]
    if g.random() < 0.2:
        colour = [0.0, 0.0, 0.0]
    pbr: Inputs = {"baseColorFactor": [*colour, 1.0], "metallicFactor": 0.0}
    if kind == "over metal":
        pbr["metallicFactor"] = 1.0 if g.random() < 0.5 else drawn_number(g, 0.0, 1.0)
        pbr["baseColorFactor"] = [*(drawn_number(g, 0.3, 1.0) for _ in _WHITE), 1.0]
    pbr["roughnessFactor"] = drawn_number(g, 0.2, 1.0)
    share = 1.0 if g.random() < 0.4 else drawn_number(g, 0.0, 1.0)
    return pbr, {"KHR_materials_transmission": {"transmissionFactor": share}} if kind == "over glass" else {}
