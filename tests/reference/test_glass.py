"""Paths through glass against closed forms: Snell in angles, Beer's law, and nothing lost in a white room."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn, in_one_direction
from gltf_iri.reference.glass import Scenery, Traced, trace_glass
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Tracer
from gltf_iri.scene.environment import white
from gltf_iri.scene.model import Environment

NO_MIRROR = Specular(factor=0.0)


def _glass(roughness: float = 0.0, **changes: Any) -> Material:
    made = Material(
        pbr=MetallicRoughness(metallic_factor=0.0, roughness_factor=roughness),
        transmission=Transmission(1.0),
        volume=Volume(thickness_factor_m=1.0),
        ior=Ior(1.5),
    )
    return replace(made, **changes)


@pytest.fixture
def look(props: SimpleNamespace) -> Callable[..., Traced]:
    """Trace parallel rays down −Z at the given places (x, y)."""

    def trace(
        primitives: Any,
        materials: Any,
        places: Any,
        environment: Environment | None = None,
        *,
        paths: int = 64,
        depth: int = 8,
        seed: int = 0,
        backdrop: tuple[float, float, float] | None = None,
    ) -> Traced:
        stage = build_stage(*props.scene_of(primitives, materials))
        tracer = Tracer(stage)

        def film_on(slot: int, surface: Surface) -> FilmOn:
            film = stage.materials[slot].iridescence or Iridescence()
            method = partial(evaluate, stage.plans[slot].method or "khr")
            return FilmOn(surface, film.film_ior, in_one_direction(method))

        sky = EnvironmentMap(environment or white())
        scenery = Scenery(tracer, stage, sky, backdrop, (), film_on)
        xy = np.atleast_2d(np.asarray(places, np.float64))
        origins = np.column_stack([xy, np.full(len(xy), 5.0)])
        directions = np.tile([0.0, 0.0, -1.0], (len(xy), 1))
        hits = tracer.first_hits(origins, directions)
        assert hits.valid.all()
        return trace_glass(
            scenery, directions, hits, paths=paths, depth=depth, rng=np.random.default_rng(seed)
        )

    return trace


def _slope_map(height: int = 512) -> Environment:
    """A map whose radiance is (½ + ½ direction), so that colours are directions."""
    rows, columns = np.mgrid[0:height, 0 : 2 * height]
    azimuth, polar = 2 * np.pi * ((columns + 0.5) / (2 * height) - 0.5), np.pi * (rows + 0.5) / height
    direction = np.stack(
        [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], axis=-1
    )
    return Environment("slope", (0.5 + 0.5 * direction).astype(np.float32))


FILM = Iridescence(factor=1.0, film_ior=1.8, thickness_min_nm=400.0, thickness_max_nm=400.0)


@pytest.mark.parametrize(
    "changes",
    [{}, {"iridescence": FILM}, {"dispersion": Dispersion(5.0)}, {"clearcoat": Clearcoat(factor=0.7)}],
    ids=["bare", "film", "dispersion", "coat"],
)
def test_a_clear_sphere_cannot_be_seen_in_a_white_room(
    look: Callable[..., Traced], props: SimpleNamespace, changes: dict[str, Any]
) -> None:
    places = [[0.0, 0.0], [0.3, 0.2], [0.0, -0.6], [0.7, 0.3]]
    traced = look(props.sphere(32), _glass(**changes), places, paths=1024, depth=12)
    slack = 4 * traced.standard_error + traced.lost[:, None] + 1e-9
    # The coat's albedo is that of a rough mirror at ALPHA_MIN; its facets shadow nothing visible.
    assert np.all(np.abs(traced.colour - 1.0) < slack + (2e-3 if "clearcoat" in changes else 0.0))
    assert traced.lost.max() < 2e-3


@pytest.mark.parametrize("roughness", [0.3, 0.7, 1.0])
@pytest.mark.parametrize("is_thick", [True, False], ids=["body", "wall"])
def test_rough_glass_cannot_be_seen_either(
    look: Callable[..., Traced], props: SimpleNamespace, roughness: float, is_thick: bool
) -> None:
    shape = props.sphere(32) if is_thick else props.quad()
    glass = _glass(roughness) if is_thick else _glass(roughness, volume=None)
    traced = look(shape, glass, [[0.0, 0.0], [0.5, 0.2], [0.9, 0.1]], paths=1024, depth=24)
    slack = 4 * traced.standard_error + traced.lost[:, None] + 1e-4
    assert np.all(np.abs(traced.colour - 1.0) < slack)
    assert traced.lost.max() < 0.02


def test_light_leaves_a_sphere_where_snell_sends_it(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    """Entering at sin θ = h, light turns by θ − θ′ twice, sin θ′ = h / n."""
    height = np.array([0.0, 0.2, 0.4, 0.6, 0.8])
    material = _glass(ior=Ior(1.5), specular=NO_MIRROR)
    traced = look(
        props.sphere(256),
        material,
        np.column_stack([height, np.zeros(5)]),
        _slope_map(),
        paths=2,
    )
    turn = 2 * (np.arcsin(height) - np.arcsin(height / 1.5))
    expected = np.column_stack([-np.sin(turn), np.zeros(5), -np.cos(turn)])
    assert_allclose(2 * traced.colour - 1, expected, atol=3e-3)
    assert_allclose(traced.lost, 0.0)


def test_a_dispersed_ray_leaves_in_three_directions(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    material = _glass(dispersion=Dispersion(4.0), specular=NO_MIRROR)
    traced = look(props.sphere(256), material, [[0.6, 0.0]], _slope_map(), paths=4096)
    turns = 2 * (np.arcsin(0.6) - np.arcsin(0.6 / np.array([1.45, 1.5, 1.55])))
    expected = [-np.sin(turns[0]), 0.0, -np.cos(turns[2])]
    assert_allclose(2 * traced.colour[0] - 1, expected, atol=0.02 + 8 * traced.standard_error.max())


def _slab(props: SimpleNamespace, thickness_m: float) -> Any:
    x = 20.0
    corners = [
        [sx * x, sy * x, z] for z in (0.0, -thickness_m) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    faces = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]
    normals = np.repeat(np.float32([[0, 0, 1], [0, 0, -1]]), 4, axis=0)
    return props.triangles(corners, faces, normals=normals)


def test_a_slab_absorbs_by_beers_law(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    colour = np.array([0.8, 0.4, 0.1])
    volume = Volume(thickness_factor_m=1.0, attenuation_distance_m=2.0, attenuation_color=tuple(colour))
    traced = look(_slab(props, 3.0), _glass(volume=volume, specular=NO_MIRROR), [[0.0, 0.0]], paths=2)
    assert_allclose(traced.colour[0], colour**1.5, rtol=1e-6)


def test_a_mirroring_slab_absorbs_along_every_echo(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    """White outside, a left of each crossing: R + (1 − R)² (a + R a²) / (1 − (R a)²), both exits summed."""
    volume = Volume(thickness_factor_m=1.0, attenuation_distance_m=1.0, attenuation_color=(0.9, 0.5, 0.2))
    slab = _glass(volume=volume, ior=Ior(2.5))
    traced = look(_slab(props, 1.0), slab, [[0.0, 0.0]], paths=4096, depth=16)
    r, a = (1.5 / 3.5) ** 2, np.array([0.9, 0.5, 0.2])
    expected = r + (1 - r) ** 2 * (a + r * a**2) / (1 - (r * a) ** 2)
    assert np.all(np.abs(traced.colour[0] - expected) < 4 * traced.standard_error[0] + traced.lost[0])


def test_the_tint_of_a_body_is_paid_once(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    pbr = MetallicRoughness(base_color_factor=(0.5, 0.6, 0.7, 1.0), metallic_factor=0.0, roughness_factor=0.0)
    traced = look(props.sphere(32), _glass(pbr=pbr, specular=NO_MIRROR), [[0.1, 0.2]], paths=2)
    assert_allclose(traced.colour[0], [0.5, 0.6, 0.7], rtol=1e-6)


def test_a_thin_wall_tints_and_bends_nothing(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    pbr = MetallicRoughness(base_color_factor=(0.5, 0.6, 0.7, 1.0), metallic_factor=0.0, roughness_factor=0.0)
    wall = _glass(pbr=pbr, volume=None, specular=NO_MIRROR)
    traced = look(props.quad(), wall, [[0.1, 0.2]], _slope_map(), paths=2)
    # ALPHA_MIN spreads light by thousandths of a radian.
    assert_allclose(traced.colour[0], [0.25, 0.3, 0.0], atol=5e-3)


def test_straight_light_sees_the_backdrop_and_bent_light_the_sky(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    backdrop = (0.1, 0.2, 0.3)
    wall = _glass(volume=None, specular=NO_MIRROR)
    through = look(props.quad(), wall, [[0.0, 0.0]], paths=2, backdrop=backdrop)
    assert_allclose(through.colour[0], backdrop, rtol=1e-6)
    body = look(props.sphere(16), _glass(specular=NO_MIRROR), [[0.3, 0.0]], paths=2, backdrop=backdrop)
    assert_allclose(body.colour[0], 1.0, rtol=1e-6)


def test_what_is_reflected_is_not_transmitted(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    """A wall with white above and black below: straight down it shows R of the white and T of the black."""
    half = np.zeros((256, 512, 3), np.float32)
    half[:, 256:] = 1.0  # azimuth above 0: towards +Z, where the rays come from
    wall = _glass(volume=None, ior=Ior(2.0))
    traced = look(props.quad(), wall, [[0.0, 0.0]], Environment("half", half), paths=4096)
    expected = float(f_schlick(1.0 / 9.0, 1.0))
    assert abs(traced.colour[0, 0] - expected) < 4 * traced.standard_error[0, 0]


def test_an_opaque_wall_behind_glass_shows_what_it_emits(
    look: Callable[..., Traced], props: SimpleNamespace
) -> None:
    lamp = Material(
        pbr=MetallicRoughness(base_color_factor=(0.0, 0.0, 0.0, 1.0), roughness_factor=1.0),
        emissive_factor=(0.2, 0.4, 0.6),
    )
    world = np.diag([9.0, 9.0, 1.0, 1.0])
    world[2, 3] = -3.0
    behind = props.quad(world=world)
    dark = Environment("dark", np.zeros((2, 4, 3), np.float32))
    body = replace(props.sphere(32), material=1)
    traced = look([behind, body], [lamp, _glass(specular=NO_MIRROR)], [[0.1, 0.0]], dark, paths=2)
    assert_allclose(traced.colour[0], [0.2, 0.4, 0.6], rtol=1e-6)


def test_the_standard_error_is_honest(look: Callable[..., Traced], props: SimpleNamespace) -> None:
    """Twenty seeds: squared deviations from their mean against the errors stated."""
    places = [[0.0, 0.0], [0.4, 0.3], [0.8, 0.0]]
    runs = [look(props.sphere(24), _glass(0.4), places, _slope_map(64), paths=64, seed=s) for s in range(20)]
    colours = np.array([run.colour for run in runs])
    stated = np.mean([run.standard_error**2 for run in runs], axis=0)
    ratio = colours.var(axis=0, ddof=1) / stated
    # χ² of 19 degrees of freedom, nine values: 0.2 to 2.9 holds 99.99 % of each.
    assert np.all((ratio > 0.2) & (ratio < 2.9))
    again = look(props.sphere(24), _glass(0.4), places, _slope_map(64), paths=64, seed=3)
    assert_allclose(again.colour, runs[3].colour, rtol=0, atol=0)
