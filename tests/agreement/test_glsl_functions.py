"""Every function in GLSL equals its Python twin, and keeps its digits where float32 could lose them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE, eval_sensitivity
from gltf_iri.evaluation.khr_guarded import f_schlick_matched
from gltf_iri.optics import layering, sheen
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.optics.microfacet import (
    ALPHA_MIN,
    alpha_ggx,
    anisotropic_alphas,
    d_ggx,
    d_ggx_anisotropic,
    v_smith_ggx_anisotropic,
    v_smith_ggx_correlated,
)
from gltf_iri.optics.refraction import cos_theta_2_squared
from gltf_iri.optics.transmission import dispersed_iors, exit_normal, path_inside, refraction_roughness
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


def directions() -> list[Float64]:
    """Components along tangent, bitangent and normal of random unit vectors on the lit side."""
    cosine, turn = decades(1e-4, 1.0), uniform(-np.pi, np.pi)
    sine = np.sqrt(1.0 - cosine**2)
    parts = (sine * np.cos(turn), sine * np.sin(turn), cosine)
    return [part.astype(np.float32).astype(np.float64) for part in parts]


def unit_vectors() -> Float64:
    """Random ones from the whole sphere, (ROWS, 3)."""
    vectors = G.normal(size=(ROWS, 3))
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


COLOUR = uniform(0.0, 1.0, 3)
OTHER_COLOUR = uniform(0.0, 1.2, 3)  # a film may reflect more than 1
COSINE = uniform(0.0, 1.0)
STRENGTH = uniform(0.0, 1.0)
HALF, LIGHT, VIEW = directions(), directions(), directions()
ALPHA_T, ALPHA_B = decades(ALPHA_MIN, 1.0), decades(ALPHA_MIN, 1.0)
SHEEN_ALPHA = decades(sheen.SHEEN_ALPHA_MIN, 1.0)

# Outward normals, and ways into the body that are steeper than 60°.
ENTRY = unit_vectors()
INSIDE = -ENTRY + 0.5 * unit_vectors()
INSIDE /= np.linalg.norm(INSIDE, axis=1, keepdims=True)

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
    "alpha_ggx": ("optics/microfacet.glsl", alpha_ggx, [decades(1e-3, 1.0)], "float"),
    "d_ggx": ("optics/microfacet.glsl", d_ggx, [decades(1e-12, 1.0), decades(ALPHA_MIN, 1.0)], "float"),
    "v_smith_ggx_correlated": (
        "optics/microfacet.glsl",
        v_smith_ggx_correlated,
        [COSINE, decades(1e-4, 1.0), decades(ALPHA_MIN, 1.0)],
        "float",
    ),
    "d_ggx_anisotropic": (
        "optics/anisotropic_microfacet.glsl",
        d_ggx_anisotropic,
        [HALF[0], HALF[1], ALPHA_T, ALPHA_B],
        "float",
    ),
    "d_ggx_anisotropic near the highlight": (
        "optics/anisotropic_microfacet.glsl",
        d_ggx_anisotropic,
        [decades(1e-6, 0.5), -decades(1e-6, 0.5), ALPHA_T, ALPHA_B],
        "float",
    ),
    "v_smith_ggx_anisotropic": (
        "optics/anisotropic_microfacet.glsl",
        v_smith_ggx_anisotropic,
        [LIGHT[2], VIEW[2], LIGHT[0], LIGHT[1], VIEW[0], VIEW[1], ALPHA_T, ALPHA_B],
        "float",
    ),
    "sheen_alpha": ("optics/sheen.glsl", sheen.sheen_alpha, [STRENGTH], "float"),
    "d_charlie": ("optics/sheen.glsl", sheen.d_charlie, [COSINE, SHEEN_ALPHA], "float"),
    "d_charlie at the horizon": (
        "optics/sheen.glsl",
        sheen.d_charlie,
        [decades(1e-6, 1.0), SHEEN_ALPHA],
        "float",
    ),
    "lambda_sheen": ("optics/sheen.glsl", sheen.lambda_sheen, [decades(1e-4, 1.0), SHEEN_ALPHA], "float"),
    "lambda_sheen of any cosine": ("optics/sheen.glsl", sheen.lambda_sheen, [COSINE, SHEEN_ALPHA], "float"),
    "v_sheen": ("optics/sheen.glsl", sheen.v_sheen, [LIGHT[2], VIEW[2], SHEEN_ALPHA], "float"),
    "sheen_weight": ("optics/sheen.glsl", sheen.sheen_weight, [COLOUR, STRENGTH], "float"),
    "refraction_roughness": (
        "optics/transmission.glsl",
        refraction_roughness,
        [STRENGTH, uniform(1.0, 3.0)],
        "float",
    ),
    "dispersed_iors": (
        "optics/transmission.glsl",
        dispersed_iors,
        [uniform(1.0, 3.0), uniform(0.0, 10.0)],
        "vec3",
    ),
    "exit_normal": ("optics/transmission.glsl", exit_normal, [ENTRY, INSIDE, STRENGTH], "vec3"),
    "path_inside": ("optics/transmission.glsl", path_inside, [STRENGTH, uniform(0.1, 1.0), COSINE], "float"),
    "transmitted_share": (
        "material/transmission_layering.glsl",
        layering.transmitted_share,
        [uniform(-0.2, 1.3, 3)],
        "vec3",
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


# Where a function is worse conditioned than reflectances are.
TOLERANCES = {
    # A sine's rounding, times its exponent of up to 100 and that of the power's own logarithm.
    "d_charlie": 2e-5,
    # a / (1 + b xᶜ) reaches 20, and e to it has 20 times its relative error.
    "lambda_sheen": 1e-5,
}


def relative_error(glsl: NDArray[np.float32], python: Float64) -> Float64:
    """|difference| / max(1, |value|): absolute for reflectances, relative for the lobe and for indices."""
    return np.asarray(np.abs(glsl - python) / np.maximum(1.0, np.abs(python)))


@pytest.mark.parametrize("name", CASES)
def test_glsl_function_equals_its_python_twin(name: str, probe: Probe) -> None:
    include, twin, arguments, result = CASES[name]
    function = name.split(" ")[0]
    glsl = probe.call(function, include, arguments, result)
    worst = relative_error(glsl, twin(*arguments)).max()
    assert worst <= TOLERANCES.get(function, GLSL_OPTICS_MAX_ABS)


def test_glsl_stretches_roughness_along_the_tangent_as_python_does(probe: Probe) -> None:
    arguments = [ALPHA_T, STRENGTH]
    glsl = probe.call(
        "anisotropic_alphas", "optics/anisotropic_microfacet.glsl", arguments, "float", member="x"
    )
    assert relative_error(glsl, anisotropic_alphas(*arguments)[0]).max() <= GLSL_OPTICS_MAX_ABS


def test_equal_roughness_along_and_across_is_isotropic_to_the_last_bit_of_d(probe: Probe) -> None:
    t, b = (part.astype(np.float32) for part in HALF[:2])
    stretched = probe.call(
        "d_ggx_anisotropic", "optics/anisotropic_microfacet.glsl", [t, b, ALPHA_T, ALPHA_T], "float"
    )
    even = probe.call("d_ggx", "optics/microfacet.glsl", [t * t + b * b, ALPHA_T], "float")
    np.testing.assert_array_equal(stretched, even)
    stretched = probe.call(
        "v_smith_ggx_anisotropic",
        "optics/anisotropic_microfacet.glsl",
        [LIGHT[2], VIEW[2], LIGHT[0], LIGHT[1], VIEW[0], VIEW[1], ALPHA_T, ALPHA_T],
        "float",
    )
    even = probe.call(
        "v_smith_ggx_correlated", "optics/microfacet.glsl", [LIGHT[2], VIEW[2], ALPHA_T], "float"
    )
    np.testing.assert_allclose(stretched, even, rtol=2e-6)


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
