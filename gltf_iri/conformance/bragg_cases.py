"""The first rows of EXT_materials_bragg: edge cases, each in words. What a case does not fix is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from gltf_iri.conformance.bragg_draw import Inputs, drawn_number, drawn_pose

__all__ = ["BRAGG_CASES", "bragg_case_inputs"]

_ROUGH: Final = {"roughness": 0.4}

# Fourneau et al. 2024, Fig. 7 and Table 3.
_A: Final = {"ior2": 1.5, "periodMinimum": 500.0, "periodMaximum": 500.0, "cells": 10, "roughness": 0.316}
_RED: Final = {"ior2": 1.8, "periodMinimum": 440.0, "periodMaximum": 440.0, "cells": 5, "roughness": 0.3}
_GREEN: Final = {**_RED, "periodMinimum": 370.0, "periodMaximum": 370.0, "roughness": 0.5}
_CUTICLE: Final = {
    **{"ior1": 1.59, "ior2": 1.67, "periodMinimum": 190.0, "periodMaximum": 190.0},
    **{"fill": 0.49, "cells": 8, "roughness": 0.22},
}
_TEXTURED: Final = {**_RED, "periodMinimum": 560.0, "periodMaximum": 300.0, "cells": 3}
_LONG: Final = {"periodMinimum": 1000.0, "periodMaximum": 1000.0, "cells": 2}
_QUARTER: Final = {"ior2": 2.0, "fill": 0.667, "cells": 12, "periodMinimum": 206.0, "periodMaximum": 206.0}
_STRAIGHT: Final = {"i": 1.0, "o": 1.0}

# Words; the layers; and what else is neither drawn nor at its usual value: "host", "factor", "r" and "g" (of
# the textures), "base", "metallic", "transmission", and the pose "i", "o" and "phi".
BRAGG_CASES: Final[tuple[tuple[str, Sequence[Inputs], Inputs], ...]] = (
    ("a layer of defaults: one cell of 250 nm in air, half of it n = 1.5, smooth", [{}], {}),
    ("the same, rough", [_ROUGH], {}),
    ("one cell in its own host is a film", [{"ior2": 1.7, **_ROUGH}], {"host": 1.4}),
    ("ior1 left out is the host's", [{**_GREEN, "ior2": 1.9}], {"host": 1.5}),
    ("ior1 written out, the host's", [{**_GREEN, "ior1": 1.5, "ior2": 1.9}], {"host": 1.5}),
    ("ior2 is the host's: nothing is mirrored, masking is left", [{"ior2": 1.0, **_ROUGH}], {}),
    ("the same, smooth: nothing is left", [{"ior2": 1.0}], {}),
    ("fill 0: all of a cell is its second film, and ten of them one film", [{**_A, "fill": 0.0}], {}),
    ("fill 1: no second film, nothing is mirrored", [{**_A, "fill": 1.0}], {}),
    ("a period of 0 mirrors nothing", [{**_A, "periodMinimum": 0.0, "periodMaximum": 0.0}], {}),
    ("periodMinimum above periodMaximum, the texture at 0.25", [_TEXTURED], {"g": 0.25}),
    ("the period texture at 0", [_TEXTURED], {"g": 0.0}),
    ("the period texture at 1", [_TEXTURED], {"g": 1.0}),
    ("one texture moves two layers", [_TEXTURED, {**_TEXTURED, "periodMaximum": 900.0}], {"g": 0.6}),
    ("braggFactor 0: the core material", [_GREEN], {"factor": 0.0}),
    ("braggTexture 0: the core material", [_GREEN], {"r": 0.0}),
    ("braggFactor 0.5 times a texture of 0.5", [_GREEN], {"factor": 0.5, "r": 0.5}),
    ("braggFactor 0 over a smooth layer", [{}], {"factor": 0.0}),
    ("no layers: the extension has no effect", [], {}),
    ("a bending layer above another: the extension is ignored", [{**_RED, "ior1": 1.3}, _GREEN], {}),
    ("a bending layer over a metal: ignored", [_CUTICLE], {"metallic": 0.3}),
    ("a bending layer over glass: ignored", [_CUTICLE], {"transmission": 0.3}),
    ("a bending last layer on black", [_CUTICLE], {"base": [0.0, 0.0, 0.0]}),
    ("a bending last layer on a diffuse base, which lies in its ior1", [_CUTICLE], {}),
    ("ior1 below the host's: total reflection beyond 38.7°", [{**_RED, "ior1": 1.0}], {"host": 1.6}),
    ("ior1 above the host's", [{**_RED, "ior1": 1.4, "ior2": 2.0}], {"host": 1.2}),
    ("a bending layer below another", [_GREEN, {**_RED, "ior1": 1.33}], {}),
    ("a bending layer, smooth", [{**_CUTICLE, "roughness": 0.0}], {}),
    ("along the normal", [_GREEN], {"i": 1.0, "o": 1.0}),
    ("along the normal, in a host", [_GREEN], {"i": 1.0, "o": 1.0, "host": 1.3}),
    ("light along the surface, in air", [_GREEN], {"i": 0.0}),
    ("light along the surface, of a host", [_GREEN], {"i": 0.0, "host": 1.3}),
    ("the viewer along the surface", [_GREEN, _RED], {"o": 0.0}),
    ("nearly along the surface", [_GREEN], {"i": 0.01, "o": 0.02, "phi": -1.0}),
    ("the mirror direction", [_GREEN, _RED], {"i": 0.6, "o": 0.6, "phi": -1.0}),
    ("back to the light", [_GREEN, _RED], {"i": 0.6, "o": 0.6, "phi": 1.0}),
    ("the viewer at a right angle", [_GREEN], {"phi": 0.0}),
    ("over a metal", [_GREEN], {"metallic": 1.0}),
    ("over a metal, in a host", [_GREEN], {"metallic": 1.0, "host": 1.5}),
    ("over half a metal", [_GREEN], {"metallic": 0.5}),
    ("over glass", [_GREEN], {"transmission": 1.0}),
    ("over glass, in a host", [_GREEN, _RED], {"transmission": 1.0, "host": 1.5}),
    ("over half glass, a quarter metal", [_GREEN], {"transmission": 0.5, "metallic": 0.25}),
    ("over white", [_GREEN], {"base": [1.0, 1.0, 1.0]}),
    ("over black", [_GREEN], {"base": [0.0, 0.0, 0.0]}),
    ("one colour twice: the second layer gets what the first lets pass", [_RED, _RED], {}),
    ("two layers", [_GREEN, _RED], {}),
    ("two layers in the other order", [_RED, _GREEN], {}),
    ("a smooth layer above a rough one: no BRDF", [{**_RED, "roughness": 0.0}, _GREEN], {}),
    ("a smooth layer below a rough one: no BRDF", [_RED, {**_GREEN, "roughness": 0.0}], {}),
    ("four layers", [_RED, _GREEN, {**_RED, "fill": 0.3}, {**_GREEN, "ior2": 1.4}], {}),
    ("four smooth layers", [{"ior2": 1.2 + 0.1 * k, "cells": k} for k in (1, 2, 3, 4)], {}),
    ("as rough as can be", [{**_GREEN, "roughness": 1.0}], {}),
    ("hardly rough", [{**_GREEN, "roughness": 0.2}], {}),
    ("ior2 below the host's", [{**_GREEN, "ior2": 1.3}], {"host": 1.5}),
    ("ior2 below the host's, beyond its critical angle", [{"ior2": 1.1, "cells": 3}], {"host": 1.7}),
    ("quarter waves of about 550 nm, straight on", [_QUARTER], _STRAIGHT),
    ("two hundred cells of a weak contrast", [{"ior2": 1.52, "cells": 200}], {"host": 1.5}),
    ("two hundred cells of a strong contrast", [{"ior2": 2.2, "cells": 200}], {}),
    ("higher orders: a period of 1000 nm", [{**_A, **_LONG}], {}),
    ("ten cells of some 500 nm", [_A], {}),
    ("a cuticle in a host of its own", [{**_CUTICLE}], {"host": 1.59, "base": [0.02, 0.02, 0.02]}),
)


def bragg_case_inputs(number: int, g: np.random.Generator) -> Inputs:
    """Return the inputs of edge case `number`; what it leaves open is drawn from `g`."""
    _, layers, fixed = BRAGG_CASES[number]
    pose = drawn_pose(g, 0.3)
    names = (("cos_theta_i", "i"), ("cos_theta_o", "o"), ("cos_phi", "phi"))
    pose |= {name: fixed[short] for name, short in names if short in fixed}
    drawn = [drawn_number(g, 0.2, 0.9) for _ in range(3)]
    bragg: dict[str, Any] = {"braggFactor": fixed.get("factor", 1.0)}
    if "host" in fixed:
        bragg["hostIor"] = fixed["host"]
    if layers:
        bragg["layers"] = [_moved(layer, g) for layer in layers]
    extensions: dict[str, Any] = {"EXT_materials_bragg": bragg}
    if "transmission" in fixed:
        extensions["KHR_materials_transmission"] = {"transmissionFactor": fixed["transmission"]}
    pbr = {
        "baseColorFactor": [*fixed.get("base", drawn), 1.0],
        "metallicFactor": fixed.get("metallic", 0.0),
        "roughnessFactor": drawn_number(g, 0.3, 1.0),
    }
    return {
        "material": {"pbrMetallicRoughness": pbr, "extensions": extensions},
        "bragg_texture": fixed.get("r", 1.0),
        "period_texture": fixed.get("g", 1.0),
        **pose,
    }


def _moved(layer: Inputs, g: np.random.Generator) -> Inputs:
    """Return the layer with some nanometres added to its periods: no row would else escape a rounding tie."""
    moved, more = dict(layer), drawn_number(g, 0.0, 5.0, 1)
    for name in ("periodMinimum", "periodMaximum"):
        if moved.get(name, 0.0) > 0.0:
            moved[name] = round(moved[name] + more, 1)
    return moved
