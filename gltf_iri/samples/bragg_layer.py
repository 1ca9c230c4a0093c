"""Layers of EXT_materials_bragg as papers state them, and their colour for whoever ignores the extension."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import Any, Final

from gltf_iri.samples.rounding import rounded_list

__all__ = ["BLACK", "bragg_layer", "bragg_stack", "tinted_surface"]

BLACK: Final = (0.0, 0.0, 0.0)
_DIELECTRIC_F0: Final = 0.04  # of a surface without KHR_materials_ior


def bragg_layer(d1_nm: float, d2_nm: float, ior_2: float, cells: int, alpha: float) -> dict[str, Any]:
    """Return the layer of `cells` cells of two films, d1_nm met first, on facets of roughness `alpha`.

    A file states a cell's period and the first film's share of it, and roughness as √α.
    """
    period_nm = d1_nm + d2_nm
    fill, roughness = rounded_list((d1_nm / period_nm, sqrt(alpha)))
    return {
        "ior2": ior_2,
        "periodMinimum": period_nm,
        "periodMaximum": period_nm,
        "fill": fill,
        "cells": cells,
        "roughness": roughness,
    }


def bragg_stack(*layers: Mapping[str, Any], host_ior: float = 1.0) -> dict[str, Any]:
    """Return the extension's object of `layers`, outermost first, at full strength."""
    host = {} if host_ior == 1.0 else {"hostIor": host_ior}
    return {"braggFactor": 1.0, **host, "layers": [dict(layer) for layer in layers]}


def tinted_surface(
    f0: tuple[float, float, float], texture: Mapping[str, Any] | None = None
) -> dict[str, dict[str, Any]]:
    """Return the extension that gives a dielectric the F0 `f0` (3,), linear Rec.709, times a texture.

    Layers stand in place of this surface; who ignores them sees it. F0 = 0.04 · specularColor, cut off at 1
    (KHR_materials_specular); colours above 1 are legal.
    """
    factor = [round(channel / _DIELECTRIC_F0, 3) for channel in f0]
    textured = {} if texture is None else {"specularColorTexture": dict(texture)}
    return {"KHR_materials_specular": {"specularColorFactor": factor, **textured}}
