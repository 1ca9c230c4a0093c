"""The converged image light against quadrature, against punctual light, and against its own error bars."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.optics.sheen import sheen_albedo
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn, in_one_direction
from gltf_iri.reference.image_light import estimate, reflected
from gltf_iri.reference.layers import fibre_lobe
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.low_discrepancy import standard_error
from gltf_iri.reference.surface import Surface
from gltf_iri.scene.environment import white
from gltf_iri.scene.model import Environment

METAL = (Effect.METAL,)
DIELECTRIC = (Effect.DIELECTRIC,)
VECTORS = {
    *("position", "normal", "view", "clearcoat_normal", "anisotropy_tangent"),
    *("base_color", "emission", "dielectric_f0", "sheen_color"),
}


def _plan(*effects: Effect, method: str | None = None) -> MaterialPlan:
    return MaterialPlan(0, "", effects, method, "", "core")


def _surface(n_dot_v: Any, roughness: float = 0.5, **changes: Any) -> Surface:
    """Points with the normal +Y, seen at the given cosines from azimuth 0.7."""
    cosine = np.atleast_1d(np.asarray(n_dot_v, np.float64))
    count, sine = len(cosine), np.sqrt(1.0 - np.atleast_1d(n_dot_v) ** 2.0)
    up = np.tile([0.0, 1.0, 0.0], (count, 1))
    values: dict[str, Any] = {
        "position": (0.0, 0.0, 0.0),
        "normal": up,
        "view": np.column_stack([sine * np.cos(0.7), cosine, sine * np.sin(0.7)]),
        "n_dot_v": cosine,
        "base_color": (1.0, 1.0, 1.0),
        "metallic": 0.0,
        "perceptual_roughness": roughness,
        "alpha_roughness": max(roughness**2, ALPHA_MIN),
        "emission": (0.0, 0.0, 0.0),
        "occlusion": 1.0,
        "dielectric_f0": (0.04, 0.04, 0.04),
        "specular_weight": 1.0,
        "iridescence_factor": 0.0,
        "iridescence_thickness_nm": 0.0,
        "iridescence_thickness_std_nm": 0.0,
        "bragg_factor": 0.0,
        "bragg_period_texel": 1.0,
        "anisotropy_strength": 0.0,
        "anisotropy_tangent": (1.0, 0.0, 0.0),
        "transmission": 0.0,
        "volume_thickness_m": 0.0,
        "sheen_color": (0.0, 0.0, 0.0),
        "sheen_roughness": 0.0,
        "clearcoat": 0.0,
        "clearcoat_roughness": 0.0,
        "clearcoat_normal": up,
    }
    values.update(changes)
    shaped = {
        name: np.broadcast_to(
            np.asarray(value, np.float64), (count, 3) if name in VECTORS else (count,)
        ).copy()
        for name, value in values.items()
    }
    return Surface(**shaped)


def _film(surface: Surface, method: str = "khr-guarded", film_ior: float = 1.3) -> FilmOn:
    return FilmOn(surface, film_ior, in_one_direction(partial(evaluate, method)))


def _reflect(
    surface: Surface,
    plan: MaterialPlan,
    environment: Environment | None = None,
    *,
    samples: int = 1024,
    seed: int = 0,
    film: FilmOn | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    sky = EnvironmentMap(environment or white())
    rng = np.random.default_rng(seed)
    return reflected(surface, plan, sky, film or _film(surface), samples=samples, rng=rng)


def _garden(height: int = 32) -> Environment:
    """A map of many brightnesses with a lamp a thousand times brighter than the rest."""
    rng = np.random.default_rng(3)
    radiance = rng.random((height, 2 * height, 3)).astype(np.float32)
    radiance[5, 40] = (1500.0, 1000.0, 500.0)
    return Environment("garden", radiance)


@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.5, 1.0])
def test_a_mirror_in_a_white_room_reflects_what_quadrature_says(roughness: float) -> None:
    cosine = np.array([1.0, 0.7, 0.3, 0.1])
    surface = _surface(cosine, roughness, metallic=1.0, base_color=(1.0, 0.5, 0.1))
    colour, error = _reflect(surface, _plan(*METAL))
    a, b = (term[:, None] for term in dfg_terms(cosine, np.full(4, roughness)))
    # Seven degrees of freedom: 7 standard errors hold 99.98 %.
    assert np.all(np.abs(colour - (surface.base_color * a + b)) < 7 * error + 1e-4)


def test_a_layered_surface_in_a_white_room_gains_nothing() -> None:
    every = (Effect.DIELECTRIC, Effect.METAL, Effect.SHEEN, Effect.CLEARCOAT, Effect.ANISOTROPY)
    for roughness in (0.05, 0.4, 1.0):
        surface = _surface(
            [0.9, 0.4, 0.1],
            roughness,
            metallic=0.3,
            sheen_color=(0.6, 0.3, 0.1),
            sheen_roughness=0.5,
            clearcoat=0.8,
            clearcoat_roughness=0.2,
            anisotropy_strength=0.6,
        )
        colour, error = _reflect(surface, _plan(*every))
        assert np.all(colour < 1.0 + 1e-3 + 5 * error)


def test_fibres_in_a_white_room_send_their_albedo() -> None:
    cosine = np.array([0.9, 0.5, 0.2])
    surface = _surface(cosine, sheen_color=(0.7, 0.4, 0.2), sheen_roughness=0.6)

    def fibres(here: Surface, light: np.ndarray, film: FilmOn, plan: MaterialPlan) -> np.ndarray:
        return fibre_lobe(here, light)

    estimates = estimate(
        surface,
        _plan(Effect.DIELECTRIC, Effect.SHEEN),
        EnvironmentMap(white()),
        _film(surface),
        samples=4096,
        rng=np.random.default_rng(0),
        copies=8,
        lobes=fibres,
    )
    colour, error = standard_error(estimates)
    expected = sheen_albedo(cosine, np.full(3, 0.6))[:, None] * surface.sheen_color
    assert np.all(np.abs(colour - expected) < 7 * error + 1e-4)


def test_a_film_in_a_white_room_is_the_film_on_average_over_facets() -> None:
    """On a smooth metal the film is seen at N·V: the spectral truth at that angle."""
    cosine = np.array([0.95, 0.6, 0.35])
    surface = _surface(
        cosine,
        0.0,
        metallic=1.0,
        base_color=(0.9, 0.6, 0.3),
        iridescence_factor=1.0,
        iridescence_thickness_nm=400.0,
    )
    film = _film(surface, "spectral")
    colour, _ = _reflect(surface, _plan(Effect.METAL, Effect.IRIDESCENCE), samples=16, film=film)
    truth = evaluate("spectral", Film.of(cosine, 400.0, 1.3, base_from_f0(surface.base_color))).rgb
    assert_allclose(colour, truth, atol=3e-3)


@pytest.mark.parametrize("roughness", [0.2, 0.6])
def test_one_bright_texel_is_a_sun(roughness: float) -> None:
    height = 256
    radiance = np.zeros((height, 2 * height, 3), np.float32)
    row, column = 70, 300
    radiance[row, column] = (2.0e4, 1.0e4, 0.5e4)
    polar, azimuth = np.pi * (row + 0.5) / height, 2 * np.pi * ((column + 0.5) / (2 * height) - 0.5)
    towards = np.array([np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)])
    # A texel interpolated linearly covers one texel's solid angle in all.
    solid_angle = (np.pi / height) ** 2 * np.sin(polar)
    surface = _surface([0.8, 0.5], roughness, metallic=0.5, base_color=(0.8, 0.5, 0.2))
    plan = _plan(Effect.DIELECTRIC, Effect.METAL)
    colour, _ = _reflect(surface, plan, Environment("sun", radiance), samples=2048)
    illuminance = radiance[row, column].astype(np.float64) * solid_angle
    expected = illuminance * evaluate_lobes(surface, np.tile(towards, (2, 1)), _film(surface), plan)
    assert_allclose(colour, expected, rtol=0.02)


def test_occlusion_darkens_image_light() -> None:
    surface = _surface([0.6, 0.6], occlusion=np.array([1.0, 0.25]))
    colour, error = _reflect(surface, _plan(*DIELECTRIC))
    assert np.all(np.abs(colour[1] - 0.25 * colour[0]) < 7 * error[0])


@pytest.mark.parametrize("changes", [{"metallic": 1.0, "roughness": 0.3}, {"roughness": 0.0}])
def test_the_standard_error_is_honest(changes: dict[str, Any]) -> None:
    surface = _surface([0.8, 0.3], **changes)
    plan = _plan(Effect.DIELECTRIC, Effect.METAL)
    runs = [_reflect(surface, plan, _garden(), samples=256, seed=seed) for seed in range(24)]
    colours = np.array([colour for colour, _ in runs])
    stated = np.mean([error**2 for _, error in runs], axis=0)
    ratio = colours.var(axis=0, ddof=1) / stated
    # χ² of 23 degrees of freedom: 0.25 to 2.6 holds 99.99 % of each of the six.
    assert np.all((ratio > 0.25) & (ratio < 2.6))
    again, _ = _reflect(surface, plan, _garden(), samples=256, seed=5)
    assert_allclose(again, colours[5], rtol=0, atol=0)


def test_more_samples_come_closer() -> None:
    surface = _surface([0.7], 0.4)
    plan = _plan(*DIELECTRIC)
    coarse, fine = (_reflect(surface, plan, _garden(), samples=n)[1].max() for n in (128, 8192))
    assert fine < 0.25 * coarse


def test_an_unlit_surface_reflects_nothing() -> None:
    colour, error = _reflect(_surface([0.5]), _plan(Effect.UNLIT))
    assert not colour.any()
    assert not error.any()
