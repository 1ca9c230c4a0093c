"""What the layers of a surface do to each other, whatever their parameters are."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.layers import clearcoat_reflectance
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.surface import Surface

COUNT = 400
SCALARS = {"occlusion": 1.0, "specular_weight": 1.0}
VECTORS = ("base_color", "emission", "dielectric_f0", "sheen_color")


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def upper(rng, normal):
    """Directions on the normal's side, off the horizon."""
    there = unit(rng.normal(size=normal.shape))
    cosine = np.sum(there * normal, axis=1, keepdims=True)
    return unit(there + (np.abs(cosine) - cosine + 0.1) * normal)


def made(seed=0, **changes):
    """Points of random orientation, colour, roughness and metalness, without layers unless told."""
    rng = np.random.default_rng(seed)
    normal = unit(rng.normal(size=(COUNT, 3)))
    view = upper(rng, normal)
    roughness = rng.uniform(0.2, 1.0, COUNT)
    values = {field.name: np.full(COUNT, SCALARS.get(field.name, 0.0)) for field in fields(Surface)}
    values |= {name: np.zeros((COUNT, 3)) for name in (*VECTORS, "position")}
    values |= {
        "normal": normal,
        "clearcoat_normal": normal,
        "anisotropy_tangent": unit(np.cross(normal, rng.normal(size=(COUNT, 3)))),
        "view": view,
        "n_dot_v": np.clip(np.sum(normal * view, axis=1), N_DOT_V_MIN, 1.0),
        "base_color": rng.uniform(size=(COUNT, 3)),
        "metallic": rng.uniform(size=COUNT),
        "perceptual_roughness": roughness,
        "alpha_roughness": np.maximum(roughness**2, ALPHA_MIN),
        "dielectric_f0": rng.uniform(0.0, 0.3, (COUNT, 3)),
    }
    shapes = {name: np.shape(value) for name, value in values.items()}
    return Surface(
        **(values | {name: np.broadcast_to(value, shapes[name]) for name, value in changes.items()})
    )


def lit(surface, towards_light, *effects):
    plan = MaterialPlan(0, "", effects, None, "", "core")
    film = FilmOn(surface, 1.3, lambda f, sight: evaluate("khr-guarded", f))
    return evaluate_lobes(surface, towards_light, film, plan)


def turned(surface, view):
    """The same points, seen from `view`."""
    return replace(surface, view=view, n_dot_v=np.sum(surface.normal * view, axis=1))


LAYERS = {
    "bare": ({}, ()),
    "film": ({"iridescence_factor": 0.7, "iridescence_thickness_nm": 420.0}, (Effect.IRIDESCENCE,)),
    "anisotropy": ({"anisotropy_strength": 0.8}, (Effect.ANISOTROPY,)),
    "sheen": ({"sheen_color": (0.9, 0.4, 0.1), "sheen_roughness": 0.5}, (Effect.SHEEN,)),
}


@pytest.mark.parametrize(("changes", "effects"), LAYERS.values(), ids=LAYERS)
def test_light_and_viewer_may_change_places(changes, effects):
    surface = made(**changes)
    light = upper(np.random.default_rng(1), surface.normal)
    there = lit(surface, light, *effects) / np.sum(surface.normal * light, axis=1)[:, None]
    back = lit(turned(surface, light), surface.view, *effects) / surface.n_dot_v[:, None]
    assert there.min() > 0
    assert np.abs(back / there - 1).max() < 1e-10


def test_light_and_viewer_may_change_places_on_both_sides_of_a_thin_wall():
    surface = made(transmission=0.8)
    light = -upper(np.random.default_rng(1), surface.normal)
    there = lit(surface, light, Effect.TRANSMISSION) / -np.sum(surface.normal * light, axis=1)[:, None]
    other_side = replace(surface, normal=-surface.normal)
    back = lit(turned(other_side, light), surface.view, Effect.TRANSMISSION) / surface.n_dot_v[:, None]
    assert there.min() > 0
    assert np.abs(back / there - 1).max() < 1e-10


def test_what_clear_facets_reflect_and_transmit_is_together_all_that_reaches_them():
    glass = made(transmission=1.0, metallic=0.0, base_color=1.0, iridescence_factor=1.0)
    glass = replace(glass, iridescence_thickness_nm=np.full(COUNT, 350.0))
    light = upper(np.random.default_rng(1), glass.normal)
    behind = light - 2 * np.sum(glass.normal * light, axis=1, keepdims=True) * glass.normal
    effects = Effect.TRANSMISSION, Effect.IRIDESCENCE
    together = lit(glass, light, *effects) + lit(glass, behind, *effects)
    mirror = replace(glass, metallic=np.ones(COUNT), iridescence_factor=np.zeros(COUNT))
    assert np.abs(together / lit(mirror, light) - 1).max() < 1e-12


def test_nothing_of_a_point_light_passes_a_volume_or_an_opaque_surface():
    surface = made(transmission=1.0, metallic=0.0)
    behind = -upper(np.random.default_rng(1), surface.normal)
    assert not lit(surface, behind, Effect.TRANSMISSION, Effect.VOLUME).any()
    assert not lit(replace(surface, transmission=np.zeros(COUNT)), behind, Effect.TRANSMISSION).any()
    assert lit(surface, behind, Effect.TRANSMISSION).min() > 0


@pytest.mark.parametrize("effect", [Effect.ANISOTROPY, Effect.SHEEN, Effect.CLEARCOAT, Effect.TRANSMISSION])
def test_a_layer_of_strength_0_changes_nothing(effect):
    surface = made(sheen_roughness=0.4, clearcoat_roughness=0.3)
    light = upper(np.random.default_rng(1), surface.normal)
    plain = lit(surface, light)
    assert np.abs(lit(surface, light, effect) / plain - 1).max() < 1e-12


def test_without_a_direction_to_draw_it_out_a_highlight_stays_round():
    surface = made(anisotropy_strength=0.9, anisotropy_tangent=0.0)
    light = upper(np.random.default_rng(1), surface.normal)
    assert np.array_equal(lit(surface, light, Effect.ANISOTROPY), lit(surface, light))


def test_a_coat_takes_from_below_what_it_reflects_of_everything():
    surface = made(clearcoat=0.8, clearcoat_roughness=0.4)
    light = upper(np.random.default_rng(1), surface.normal)
    below = lit(surface, light)
    coat = lit(surface, light, Effect.CLEARCOAT) - (1 - clearcoat_reflectance(surface))[:, None] * below
    # What is left is the varnish alone: colourless, brighter in front of the light, and never negative.
    assert np.abs(coat - coat[:, :1]).max() < 1e-12
    assert coat.min() > 0


def test_a_light_that_the_viewer_stands_in_front_of_is_not_a_number_less():
    surface = made(sheen_color=0.5, sheen_roughness=0.5, clearcoat=1.0, transmission=0.5)
    everything = Effect.SHEEN, Effect.CLEARCOAT, Effect.TRANSMISSION, Effect.ANISOTROPY
    for light in (-surface.view, surface.view, surface.normal, -surface.normal, surface.anisotropy_tangent):
        assert np.isfinite(lit(surface, light, *everything)).all()
