"""The constants that GLSL shares with Python, written as GLSL; Python's tables are the one source."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np

from gltf_iri.colour import damped_sensitivity as damped
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.sensitivity import GAUSSIANS, SENSITIVITY_WHITE, Gaussian
from gltf_iri.colour.sensitivity_table import END_NM
from gltf_iri.colour.spaces import XYZ_TO_REC709
from gltf_iri.evaluation import fourier, khr, khr_guarded
from gltf_iri.material.bragg_limits import BRAGG_LAYERS_MAX
from gltf_iri.optics import granier_heidrich, landmarks, layering, microfacet, sheen
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.rendering import environment_light, optics_tables, spread_table
from gltf_iri.scene import light

__all__ = ["FILTER_POINTS", "bragg_constants_glsl", "constants_glsl", "film_constants_glsl", "glsl_float"]
__all__ += ["layer_constants_glsl"]

# Gauss points on each of the three panels of a rough layer's filter in GLSL. Of 400 random layers (α 0.001–1,
# up to 30 cells) the colour of T errs by 9e-3 at the 95th percentile, half of which 24 points still do:
# what is missed is the fringes of many cells over angles, not the filter, whose ∫ F_α dθ_d errs by 2e-4.
FILTER_POINTS: Final = 12


def constants_glsl() -> str:
    """Return the text of shaders/generated/constants.glsl, which every shaded surface reads."""
    return _file(
        "Constants of the Python package.",
        [
            "// gltf_iri/optics/microfacet.py",
            _scalar("ALPHA_MIN", microfacet.ALPHA_MIN),
            _scalar("N_DOT_V_MIN", microfacet.N_DOT_V_MIN),
        ],
        [
            "// gltf_iri/scene/light.py",
            _scalar("LIGHT_DISTANCE_MIN_M", light.LIGHT_DISTANCE_MIN_M),
        ],
        [
            "// gltf_iri/rendering/environment_light.py",
            f"const int LAYERS_PER_LEVEL = {environment_light.LAYERS_PER_LEVEL};",
            f"const int ROUGHNESS_LAYERS = {environment_light.ROUGHNESS_LAYERS};",
            _scalar("LAYER_ROUGHNESS_MIN", environment_light.LAYER_ROUGHNESS_MIN),
        ],
    )


def film_constants_glsl() -> str:
    """Return the text of shaders/generated/film_constants.glsl, which only films read."""
    first, second = GAUSSIANS[:3], GAUSSIANS[3]
    return _file(
        "Constants of the film methods in Python.",
        [
            "// gltf_iri/colour/sensitivity.py: lobes of x̄, ȳ, z̄, and the second lobe of x̄",
            *_lobes("SENSITIVITY", "vec3", first),
            *_lobes("SENSITIVITY_SECOND", "float", (second,)),
            f"const vec3 SENSITIVITY_WHITE = {_vec3(SENSITIVITY_WHITE)};",
        ],
        [
            "// gltf_iri/colour/spaces.py: the text's matrix, by columns",
            "const mat3 XYZ_TO_REC709 = mat3(",
            ",\n".join(f"    {_vec3(column)}" for column in XYZ_TO_REC709.T),
            ");",
        ],
        [
            "// gltf_iri/evaluation/khr.py",
            _scalar("F0_OFFSET", khr.F0_OFFSET),
            _scalar("R123_MIN", khr.R123_RANGE[0]),
            _scalar("R123_MAX", khr.R123_RANGE[1]),
        ],
        [
            "// gltf_iri/evaluation/khr_guarded.py",
            _scalar("MAX_F0", khr_guarded.MAX_F0),
            _scalar("MAX_R123", khr_guarded.MAX_R123),
            _scalar("MATCHED_F0", khr_guarded.MATCHED_F0),
            _scalar("THIN_OPD_NM", khr_guarded.THIN_OPD_NM),
        ],
        [
            "// gltf_iri/rendering/optics_tables.py",
            _scalar("SENSITIVITY_FINE_PER_NM", optics_tables.SENSITIVITY_FINE_PER_NM),
            _scalar("SENSITIVITY_FINE_END_NM", optics_tables.SENSITIVITY_FINE_END_NM),
            _scalar("SENSITIVITY_LAST", optics_tables.SENSITIVITY_LAST),
            _scalar("SENSITIVITY_UNIT", optics_tables.SENSITIVITY_MAX / 2.0**31),
            _scalar("SENSITIVITY_SLOPE_UNIT", optics_tables.SENSITIVITY_SLOPE_MAX / 2.0**31),
            f"const uint SENSITIVITY_SLOPE_SHIFT = {32 - optics_tables.SENSITIVITY_SLOPE_BITS}u;",
            f"const int SENSITIVITY_ROW = {optics_tables.SENSITIVITY_ROW};",
            f"const int SENSITIVITY_ROW_BITS = {optics_tables.SENSITIVITY_ROW_BITS};",
            f"const int SENSITIVITY_ROWS = {optics_tables.SENSITIVITY_ROWS};",
            f"const int SPECTRAL_SMOOTH_COUNT = {optics_tables.SPECTRAL_SMOOTH_DEGREE + 1};",
        ],
        [
            "// gltf_iri/rendering/spread_table.py, and gltf_iri/colour/damped_sensitivity.py",
            _scalar("SPREAD_FINE_END_NM", spread_table.SPREAD_FINE_END_NM),
            _scalar("SPREAD_FAR_PER_NM", spread_table.SPREAD_FAR_PER_NM),
            _scalar("SPREAD_LAST", spread_table.SPREAD_LAST),
            _scalar("SPREAD_UNIT", spread_table.SPREAD_VALUE_MAX / 2.0**31),
            _scalar("SPREAD_SLOPE_UNIT", spread_table.SPREAD_SLOPE_MAX / 2.0**31),
            f"const uint SPREAD_SLOPE_SHIFT = {32 - spread_table.SPREAD_SLOPE_BITS}u;",
            f"const int SPREAD_ROW = {spread_table.SPREAD_ROW};",
            f"const int SPREAD_ROW_BITS = {spread_table.SPREAD_ROW_BITS};",
            f"const int SPREAD_ROWS = {spread_table.SPREAD_ROWS};",
            f"const int SPREADS = {damped.SPREADS};",
            _scalar("SPREAD_SQUARED_MAX", damped.SPREAD_END_NM**2),
            _scalar("SPREAD_SQUARED_SCALE", damped.SPREAD_SCALE_NM**2),
            _scalar("SPREAD_PART_MAX", damped.SPREAD_PART_MAX),
            f"const vec3 DAMPING_PER_NM2 = {_vec3(damped.DAMPING_PER_NM2)};",
        ],
        [
            "// gltf_iri/optics/granier_heidrich.py",
            f"const vec3 LAYER_WAVELENGTHS_NM = {_vec3(granier_heidrich.WAVELENGTHS_NM)};",
        ],
        [
            "// gltf_iri/optics/landmarks.py, and gltf_iri/colour/observer.py: what is visible",
            f"const int LANDMARK_MODES_MAX = {landmarks.MODES_MAX};",
            _scalar("SHORTEST_NM", WAVELENGTH_RANGE_NM[0]),
            _scalar("LONGEST_NM", WAVELENGTH_RANGE_NM[1]),
        ],
        [
            "// gltf_iri/evaluation/fourier.py",
            _scalar("FOURIER_THIN_OPD_NM", fourier.THIN_OPD_NM),
            f"const int FOURIER_ORDERS = {int(END_NM / fourier.THIN_OPD_NM)};",
        ],
    )


def bragg_constants_glsl() -> str:
    """Return the text of shaders/generated/bragg_constants.glsl, which rough Bragg layers read."""
    nodes, weights = gauss_unit(FILTER_POINTS)
    inside = np.sin(0.5 * np.pi * nodes) ** 2
    inside_weights = 0.5 * np.pi * np.sin(np.pi * nodes) * weights
    return _file(
        "Constants of rough Bragg layers in Python.",
        [
            "// gltf_iri/optics/rough_bragg.py, filter_nodes: points of one panel, and of all three",
            f"const int FILTER_POINTS = {FILTER_POINTS};",
            f"const int FILTER_NODES = {3 * FILTER_POINTS};",
            _array("FILTER_INSIDE", inside.tolist()),
            _array("FILTER_WEIGHTS", inside_weights.tolist()),
        ],
        [
            "// gltf_iri/rendering/optics_tables.py",
            f"const int COARSE_COUNT = {optics_tables.SPECTRAL_COARSE_DEGREE + 1};",
        ],
        [
            "// gltf_iri/material/bragg.py",
            f"const int BRAGG_LAYERS_MAX = {BRAGG_LAYERS_MAX};",
        ],
    )


def layer_constants_glsl() -> str:
    """Return the text of shaders/generated/layer_constants.glsl, which fibres and coats read."""
    return _file(
        "Constants of the layers over the base in Python.",
        [
            "// gltf_iri/optics/sheen.py",
            _scalar("SHEEN_ALPHA_MIN", sheen.SHEEN_ALPHA_MIN),
            _array("SHEEN_FIT_AT_0", sheen.SHEEN_FIT_AT_0),
            _array("SHEEN_FIT_AT_1", sheen.SHEEN_FIT_AT_1),
        ],
        [
            "// gltf_iri/optics/layering.py",
            _scalar("CLEARCOAT_F0", layering.CLEARCOAT_F0),
        ],
        [
            "// gltf_iri/rendering/environment_light.py",
            f"const int SHEEN_LAYERS = {environment_light.SHEEN_LAYERS};",
        ],
    )


def glsl_float(value: float) -> str:
    """Return a GLSL literal with the nine digits that identify a float32."""
    text = f"{value:.9g}"
    return text if "." in text or "e" in text else f"{text}.0"


def _file(about: str, *blocks: list[str]) -> str:
    head = [f"// {about} Written by gltf_iri.generate; do not edit."]
    return "\n\n".join("\n".join(lines) for lines in (head, *blocks)) + "\n"


def _scalar(name: str, value: float) -> str:
    return f"const float {name} = {glsl_float(value)};"


def _array(name: str, values: Sequence[float]) -> str:
    literals = ", ".join(glsl_float(value) for value in values)
    return f"const float {name}[{len(values)}] = float[{len(values)}]({literals});"


def _vec3(values: Iterable[float]) -> str:
    return f"vec3({', '.join(glsl_float(float(value)) for value in values)})"


def _lobes(prefix: str, glsl_type: str, lobes: tuple[Gaussian, ...]) -> list[str]:
    columns = {
        "AMPLITUDE": [lobe.amplitude for lobe in lobes],
        "WAVELENGTH_NM": [lobe.wavelength_nm for lobe in lobes],
        "LENGTH_NM": [lobe.length_nm for lobe in lobes],
    }
    return [
        f"const {glsl_type} {prefix}_{name} = {_vec3(column) if len(column) > 1 else glsl_float(column[0])};"
        for name, column in columns.items()
    ]
