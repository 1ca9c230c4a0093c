"""Every function in GLSL equals its Python twin, and keeps its digits where float32 could lose them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE, eval_sensitivity
from gltf_iri.evaluation.khr_guarded import f_schlick_matched
from gltf_iri.optics import layering
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.optics.microfacet import ALPHA_MIN, d_ggx, v_smith_ggx_correlated
from gltf_iri.optics.refraction import cos_theta_2_squared
from gltf_iri.rendering.probe import Probe, ResultType
from gltf_iri.tolerances import GLSL_OPTICS_MAX_ABS

ROWS = 20_000

Float64 = NDArray[np.float64]
G = np.random.default_rng(4)


def uniform(low: float, high: float, channels: int = 0) -> Float64:
    """Random float32 numbers in [low, high], both ends among them."""
    shape = (ROWS, channels) if channels else (ROWS,)
    values = G.uniform(low, high, shape)
    values[0], values[1] = low, high
    return values.astype(np.float32).astype(np.float64)


def decades(low: float, high: float) -> Float64:
    return np.exp(uniform(np.log(low), np.log(high))).astype(np.float32).astype(np.float64)


COLOUR = uniform(0.0, 1.0, 3)
OTHER_COLOUR = uniform(0.0, 1.2, 3)  # a film may reflect more than 1
COSINE = uniform(0.0, 1.0)
STRENGTH = uniform(0.0, 1.0)

CASES: dict[str, tuple[str, Callable[..., Float64], Sequence[Float64], ResultType]] = {
    "f_schlick": ("optics/fresnel.glsl", lambda f0, c: f_schlick(f0, c[:, None]), [COLOUR, COSINE], "vec3"),
    "f_schlick of a scalar": ("optics/fresnel.glsl", f_schlick, [STRENGTH, COSINE], "float"),
    "fresnel0_to_ior": ("optics/ior.glsl", fresnel0_to_ior, [uniform(0.0, 0.9999, 3)], "vec3"),
    "fresnel0_to_ior of a scalar": ("optics/ior.glsl", fresnel0_to_ior, [uniform(0.0, 0.9999)], "float"),
    "ior_to_fresnel0": (
        "optics/ior.glsl",
        lambda t, i: ior_to_fresnel0(t, i[:, None]),
        [uniform(1.0, 40.0, 3), uniform(1.0, 3.0)],
        "vec3",
    ),
    "ior_to_fresnel0 of a scalar": (
        "optics/ior.glsl",
        ior_to_fresnel0,
        [uniform(1.0, 3.0), uniform(1.0, 3.0)],
        "float",
    ),
    "f_schlick_matched": (
        "optics/khr_guarded.glsl",
        lambda f0, c: f_schlick_matched(f0, c[:, None]),
        [np.where(STRENGTH[:, None] < 0.5, COLOUR, COLOUR * 2.0**-6), COSINE],
        "vec3",
    ),
    "cos_theta_2_squared": (
        "optics/refraction.glsl",
        cos_theta_2_squared,
        [uniform(1.0, 2.0), uniform(1.0, 2.0), COSINE],
        "float",
    ),
    "eval_sensitivity": (
        "optics/sensitivity.glsl",
        eval_sensitivity,
        [uniform(0.0, 50_000.0), uniform(0.0, 4.0 * np.pi, 3)],
        "vec3",
    ),
    "d_ggx": ("optics/microfacet.glsl", d_ggx, [decades(1e-12, 1.0), decades(ALPHA_MIN, 1.0)], "float"),
    "v_smith_ggx_correlated": (
        "optics/microfacet.glsl",
        v_smith_ggx_correlated,
        [COSINE, decades(1e-4, 1.0), decades(ALPHA_MIN, 1.0)],
        "float",
    ),
    "conductor_fresnel": (
        "material/film_layering.glsl",
        layering.conductor_fresnel,
        [COLOUR, uniform(-1.0, 1.0)],
        "vec3",
    ),
    "iridescent_conductor_layer": (
        "material/film_layering.glsl",
        layering.iridescent_conductor_layer,
        [STRENGTH, COLOUR, OTHER_COLOUR],
        "vec3",
    ),
}

LAYERS: dict[str, tuple[Callable[..., layering.Layer], Sequence[Float64]]] = {
    "fresnel_mix": (layering.fresnel_mix, [STRENGTH]),
    "rgb_mix": (layering.rgb_mix, [OTHER_COLOUR]),
    "iridescent_dielectric_layer": (layering.iridescent_dielectric_layer, [STRENGTH, COLOUR, OTHER_COLOUR]),
    "iridescent_dielectric_layer_specular": (
        layering.iridescent_dielectric_layer_specular,
        [STRENGTH, COSINE, COLOUR, OTHER_COLOUR],
    ),
}


def relative_error(glsl: NDArray[np.float32], python: Float64) -> Float64:
    """|difference| / max(1, |value|): absolute for reflectances, relative for the lobe and for indices."""
    return np.asarray(np.abs(glsl - python) / np.maximum(1.0, np.abs(python)))


@pytest.mark.parametrize("name", CASES)
def test_glsl_function_equals_its_python_twin(name: str, probe: Probe) -> None:
    include, twin, arguments, result = CASES[name]
    glsl = probe.call(name.split(" ")[0], include, arguments, result)
    assert relative_error(glsl, twin(*arguments)).max() <= GLSL_OPTICS_MAX_ABS


@pytest.mark.parametrize("name", LAYERS)
def test_glsl_layer_equals_its_python_twin(name: str, probe: Probe) -> None:
    twin, arguments = LAYERS[name]
    python = twin(*arguments)
    specular = probe.call(name, "material/film_layering.glsl", arguments, "vec3", member="specular")
    base_weight = probe.call(name, "material/film_layering.glsl", arguments, "float", member="base_weight")
    assert relative_error(specular, python.specular).max() <= GLSL_OPTICS_MAX_ABS
    assert relative_error(base_weight, python.base_weight).max() <= GLSL_OPTICS_MAX_ABS


def test_snell_keeps_its_digits_next_to_the_critical_angle(probe: Probe) -> None:
    film = np.float32(1.2)
    critical = np.float32(np.sqrt(1.0 - (float(film) / 1.5) ** 2))
    steps = np.arange(-2000, 2001, dtype=np.int32)
    cosine = (critical.view(np.int32) + steps).view(np.float32)
    python = cos_theta_2_squared(1.5, float(film), cosine.astype(np.float64))
    glsl = probe.call("cos_theta_2_squared", "optics/refraction.glsl", [1.5, film, cosine], "float")
    # float64 itself leaves ten digits here; naive float32 leaves none.
    assert (np.abs(glsl - python) <= 1e-5 * np.abs(python) + 1e-10).all()


def test_equal_indices_refract_nothing(probe: Probe) -> None:
    glsl = probe.call("cos_theta_2_squared", "optics/refraction.glsl", [1.3, 1.3, [0.0, 1.0]], "float")
    np.testing.assert_array_equal(glsl, [0.0, 1.0])


def test_fringes_in_phase_are_the_generated_white(probe: Probe) -> None:
    glsl = probe.call("eval_sensitivity", "optics/sensitivity.glsl", [0.0, [0.0, 0.0, 0.0]])
    np.testing.assert_allclose(glsl, SENSITIVITY_WHITE, rtol=0, atol=GLSL_OPTICS_MAX_ABS)
