"""Light inside of glass: mirrored at the angle that it has outside, absorbed by the body that it is in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn, in_one_direction
from gltf_iri.reference.glass import Scenery, Traced, trace_glass
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Tracer
from gltf_iri.scene.environment import white

FILM = Iridescence(factor=1.0, film_ior=1.8, thickness_min_nm=400.0, thickness_max_nm=400.0)


def glass(colour: tuple[float, float, float], **changes: Any) -> Material:
    """A clear body that leaves `colour` of white light over each metre."""
    made = Material(
        pbr=MetallicRoughness(metallic_factor=0.0, roughness_factor=0.0),
        transmission=Transmission(1.0),
        volume=Volume(thickness_factor_m=1.0, attenuation_distance_m=1.0, attenuation_color=colour),
        ior=Ior(1.7),
    )
    return replace(made, **changes)


def slab(props: SimpleNamespace, near_m: float, far_m: float, **changes: Any) -> Any:
    """A plate from z = near to z = far, wide enough for every echo."""
    corners = [
        [sx * 30.0, sy * 30.0, z] for z in (near_m, far_m) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    normals = np.repeat(np.float32([[0, 0, 1], [0, 0, -1]]), 4, axis=0)
    faces = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]
    return props.triangles(corners, faces, normals=normals, **changes)


@pytest.fixture
def look(props: SimpleNamespace) -> Callable[..., Traced]:
    """Trace one ray in a white room, aslant to the plates, at the origin."""

    def trace(bodies: Any, materials: Sequence[Material], cosine: float, paths: int) -> Traced:
        stage = build_stage(*props.scene_of(bodies, materials, method="khr-guarded"))
        tracer = Tracer(stage)

        def film_on(slot: int, surface: Surface) -> FilmOn:
            film = stage.materials[slot].iridescence or Iridescence()
            return FilmOn(surface, film.film_ior, in_one_direction(partial(evaluate, "khr-guarded")))

        scenery = Scenery(tracer, stage, EnvironmentMap(white()), None, (), film_on)
        direction = np.array([[np.sqrt(1.0 - cosine**2), 0.0, -cosine]])
        hits = tracer.first_hits(-2.0 * direction, direction)
        rng = np.random.default_rng(2)
        return trace_glass(scenery, direction, hits, paths=paths, depth=24, rng=rng)

    return trace


@pytest.mark.parametrize("film", [None, FILM], ids=["bare", "film"])
@pytest.mark.parametrize("cosine", [0.9, 0.4])
def test_a_plate_mirrors_alike_from_both_sides_at_one_outside_angle(
    look: Callable[..., Traced], props: SimpleNamespace, cosine: float, film: Iridescence | None
) -> None:
    """White outside, a left of each slanted crossing: R + (1 − R)² (a + R a²) / (1 − (R a)²)."""
    colour = (0.9, 0.5, 0.2)
    traced = look(slab(props, 0.0, -0.5), [glass(colour, iridescence=film)], cosine, 8192)
    f0 = (0.7 / 2.7) ** 2
    r = np.full(3, f0 + (1.0 - f0) * (1.0 - cosine) ** 5)
    if film is not None:
        bare = base_from_f0(np.full((1, 3), f0))
        r = evaluate("khr-guarded", Film.of(np.array([cosine]), 400.0, 1.8, bare)).rgb[0]
    inside = np.sqrt(1.0 - (1.0 - cosine**2) / 1.7**2)
    a = np.array(colour) ** (0.5 / inside)
    expected = r + (1.0 - r) ** 2 * (a + r * a**2) / (1.0 - (r * a) ** 2)
    # ALPHA_MIN's facets move the angle by thousandths of a radian.
    assert np.all(np.abs(traced.colour[0] - expected) < 4 * traced.standard_error[0] + 1e-3)
    assert traced.standard_error.max() < 5e-3


def test_a_coat_mirrors_on_its_outside_alone(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    """Over a body that neither bends nor mirrors: F of the room and 1 − F of what is left of it below."""
    colour, cosine = (0.9, 0.5, 0.2), 0.4
    coated = glass(colour, ior=Ior(1.0), specular=Specular(factor=0.0), clearcoat=Clearcoat(factor=1.0))
    traced = look(slab(props, 0.0, -0.5), [coated], cosine, 16384)
    coat = 0.04 + 0.96 * (1.0 - cosine) ** 5
    expected = coat + (1.0 - coat) * np.array(colour) ** (0.5 / cosine)
    assert np.all(np.abs(traced.colour[0] - expected) < 4 * traced.standard_error[0] + 1e-3)
    assert traced.standard_error.max() < 3e-3


def test_a_body_in_a_body_absorbs_instead_of_the_outer_one(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    """A metre of the outer body, one of the inner and one of the outer again."""
    clear = Specular(factor=0.0)
    bodies = [slab(props, 0.0, -3.0), slab(props, -1.0, -2.0, material=1)]
    materials = [glass((0.5, 1.0, 0.8), specular=clear), glass((1.0, 0.3, 0.7), specular=clear)]
    traced = look(bodies, materials, 1.0, 2)
    assert_allclose(traced.colour[0], [0.5**2, 0.3, 0.8**2 * 0.7], rtol=1e-4)


LAYERS = {
    "bare": {},
    "fibres": {"sheen": Sheen((0.9, 0.6, 0.3), roughness_factor=0.5)},
    "coat": {"clearcoat": Clearcoat(factor=1.0, roughness_factor=0.1)},
    "fibres under a coat": {
        "sheen": Sheen((0.9, 0.6, 0.3), roughness_factor=0.5),
        "clearcoat": Clearcoat(factor=1.0, roughness_factor=0.1),
    },
}


@pytest.mark.parametrize("layers", LAYERS.values(), ids=LAYERS)
def test_glass_that_lets_next_to_nothing_through_is_paint(
    look: Callable[..., Traced], props: SimpleNamespace, layers: dict[str, Any]
) -> None:
    """Paths gather image light on its base and fibres, and mirror the rest: together what paint sends."""
    pbr = MetallicRoughness((0.8, 0.5, 0.2, 1.0), metallic_factor=0.2, roughness_factor=0.15)
    paint = Material(pbr=pbr, ior=Ior(1.7), **layers)
    dark = replace(paint, transmission=Transmission(1e-6))
    opaque, glassy = (look(slab(props, 0.0, -0.5), [made], 0.35, 8192) for made in (paint, dark))
    slack = 4 * np.hypot(opaque.standard_error, glassy.standard_error)
    # Facets that scatter twice add to glass alone.
    assert np.all(np.abs(opaque.colour - glassy.colour) < slack + 2e-3)
    assert slack.max() < 0.02
