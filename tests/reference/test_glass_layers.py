"""Paths through Bragg layers over glass: closed forms of panes and plates, and no light out of nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from gltf_iri.baking.layer_fill import filled_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.gather import gather_surface
from gltf_iri.reference.glass import Scenery, Traced, trace_glass
from gltf_iri.reference.glass_layers import LocalCrossing, cross_layers
from gltf_iri.reference.image_light import reflected
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.points import gather_points
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Tracer
from gltf_iri.scene.environment import white
from gltf_iri.scene.model import Environment

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
BLUE = MirrorLayer(ior_2=1.6, period_max_nm=190.0, fill=0.5, cells=3)
GREEN = MirrorLayer(ior_2=1.5, period_max_nm=230.0, fill=0.4, cells=4)


def glass(*layers: MirrorLayer, host: float = 1.0, factor: float = 1.0, **changes: Any) -> Material:
    """Clear glass, a thin wall unless it has a volume, under `layers`."""
    made = Material(
        pbr=MetallicRoughness(metallic_factor=0.0, roughness_factor=0.0),
        transmission=Transmission(1.0),
        ior=Ior(1.5),
        bragg=Bragg(factor=factor, host_ior=host, layers=layers),
    )
    return replace(made, **changes)


def body(colour: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Volume:
    """A volume that leaves `colour` of light over each metre."""
    return Volume(thickness_factor_m=1.0, attenuation_distance_m=1.0, attenuation_color=colour)


def rough(layer: MirrorLayer, roughness: float) -> MirrorLayer:
    return replace(layer, roughness=roughness)


def paint(roughness: float = 0.0, metallic: float = 0.0, colour: float = 1.0) -> MetallicRoughness:
    return MetallicRoughness(
        base_color_factor=(colour, colour, colour, 1.0), metallic_factor=metallic, roughness_factor=roughness
    )


def room(front: float, behind: float) -> Environment:
    """White light from the half of the sky that the rays come from, and from the other."""
    sky = np.full((128, 256, 3), behind, np.float32)
    sky[:, 128:] = front  # azimuth above 0: towards +Z
    return Environment("room", sky)


FILLED: dict[str, LayerLookup] = {}


def colours_of(plan: LayersPlan) -> LayerLookup:
    """Colours that are multiplied: of smooth layers each lets through just what it does not mirror."""
    if repr(plan.layers) not in FILLED:
        tables = LayerTables(3, True, 513, 1, "f4", 0.0)
        made = LayersPlan(plan.layers, plan.host_ior, "base", plan.texel, "layers-rgb", tables=tables)
        FILLED[repr(plan.layers)] = LayerLookup(filled_layers(made, "D65", has_sky=False))
    return FILLED[repr(plan.layers)]


class Look:
    """Traces rays aslant to a shape, all alike."""

    def __init__(self, props: SimpleNamespace, shape: Any, material: Material, cosine: float) -> None:
        self.stage = build_stage(*props.scene_of(shape, material))
        (self.plan,), self.tracer = self.stage.plans, Tracer(self.stage)
        assert self.plan.layers is not None
        self.layers: LayersPlan = self.plan.layers
        self.cosine = cosine
        self.direction = np.array([[np.sqrt(1.0 - cosine**2), 0.0, -cosine]])
        self.hits = self.tracer.first_hits(-5.0 * self.direction + [0.01, 0.02, 0.0], self.direction)

    def film_on(self, slot: int, surface: Surface) -> FilmOn:
        colours = colours_of(self.layers)
        return FilmOn(surface, 1.3, lambda film, sight: pytest.fail("there is no film"), lambda _: colours)

    def through(self, sky: Environment, paths: int = 8192, depth: int = 24) -> Traced:
        scenery = Scenery(self.tracer, self.stage, EnvironmentMap(sky), None, (), self.film_on)
        rng = np.random.default_rng(3)
        return trace_glass(scenery, self.direction, self.hits, paths=paths, depth=depth, rng=rng)

    def surface(self) -> Surface:
        hits = self.hits
        points = gather_points(
            self.stage.scene, hits.primitive, hits.triangle, hits.barycentric, hits.is_front
        )
        return gather_surface(self.stage, 0, points, -self.direction)

    def shares(self) -> tuple[np.ndarray, np.ndarray]:
        """Return what smooth layers mirror at the rays' angle, each once, and what crosses them once."""
        colours, host = colours_of(self.layers), self.layers.host_ior
        inside, enters = cosine_in_host(host, self.cosine), coating_transmittance(host, self.cosine)
        sent = sum(colours.reflected(k, inside, inside, inside) for k in range(len(self.layers.layers)))
        return 1.0 - enters + enters**2 * np.asarray(sent), enters * colours.entering(inside)


@pytest.fixture
def look(props: SimpleNamespace) -> Callable[..., Look]:
    def made(shape: Any, material: Material, cosine: float = 0.8) -> Look:
        return Look(props, shape, material, cosine)

    return made


@pytest.fixture
def slab(props: SimpleNamespace) -> Any:
    """A plate of half a metre, wide enough for every echo."""
    corners = [
        [sx * 30.0, sy * 30.0, z] for z in (0.0, -0.5) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    normals = np.repeat(np.float32([[0, 0, 1], [0, 0, -1]]), 4, axis=0)
    return props.triangles(corners, [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]], normals=normals)


STACKS = {"one": ((BLUE,), 1.0), "two": ((BLUE, GREEN), 1.0), "two in a host": ((BLUE, GREEN), 1.3)}


@pytest.mark.parametrize("stack", STACKS.values(), ids=STACKS)
@pytest.mark.parametrize("cosine", [1.0, 0.5])
def test_a_pane_shows_what_it_mirrors_and_what_it_lets_through(
    look: Callable[..., Look], props: SimpleNamespace, stack: Any, cosine: float
) -> None:
    layers, host = stack
    seen = look(props.quad(), glass(*layers, host=host), cosine)
    mirrored, through = seen.shares()
    for sky, expected in ((room(1.0, 0.0), mirrored), (room(0.0, 1.0), through)):
        traced = seen.through(sky)
        # ALPHA_MIN's facets move the angle by thousandths of a radian.
        assert np.all(np.abs(traced.colour[0] - expected) < 4 * traced.standard_error[0] + 1e-3)
    assert mirrored.max() > 0.1
    assert np.all((mirrored + through) @ LUMINANCE <= 1.0 + 1e-3)


def test_a_pane_has_the_colours_of_the_truth(look: Callable[..., Look], props: SimpleNamespace) -> None:
    """Of a single layer colours are all that there is to know, and R + T = 1 in every channel."""
    seen = look(props.quad(), glass(BLUE), 0.7)
    truth = layer_colours("layers-single", planned_stack(seen.layers))
    cosine = np.array(0.7)
    mirrored, through = seen.shares()
    assert_allclose(mirrored, truth.reflected(0, cosine, cosine, cosine), atol=5e-4)
    assert_allclose(through, truth.entering(cosine), atol=5e-4)
    traced = seen.through(white())
    assert np.all(np.abs(traced.colour - 1.0) < 4 * traced.standard_error + 1e-3)


@pytest.mark.parametrize("stack", STACKS.values(), ids=STACKS)
def test_a_plate_mirrors_alike_from_both_sides_at_one_outside_angle(
    look: Callable[..., Look], slab: Any, stack: Any
) -> None:
    """White outside, a left of each slanted crossing: R + T² (a + R a²) / (1 − (R a)²)."""
    layers, host = stack
    colour = (0.9, 0.5, 0.2)
    seen = look(slab, glass(*layers, host=host, volume=body(colour)), 0.6)
    r, t = seen.shares()
    inside = np.sqrt(1.0 - (1.0 - 0.6**2) / 1.5**2)
    a = np.array(colour) ** (0.5 / inside)
    expected = r + t**2 * (a + r * a**2) / (1.0 - (r * a) ** 2)
    traced = seen.through(white(), paths=16384)
    assert np.all(np.abs(traced.colour[0] - expected) < 4 * traced.standard_error[0] + 2e-3)
    assert traced.standard_error.max() < 1.5e-2


@pytest.mark.parametrize("changes", [{}, {"dispersion": Dispersion(5.0)}], ids=["clear", "dispersion"])
def test_a_sphere_under_one_smooth_layer_cannot_be_seen_in_a_white_room(
    look: Callable[..., Look], props: SimpleNamespace, changes: dict[str, Any]
) -> None:
    seen = look(props.sphere(32), glass(BLUE, volume=body(), **changes), 0.8)
    traced = seen.through(white(), depth=16)
    assert np.all(np.abs(traced.colour - 1.0) < 4 * traced.standard_error + traced.lost[:, None] + 1e-3)
    assert traced.lost.max() < 5e-3


ROUGH = {
    "layers": (glass(rough(BLUE, 0.6), rough(GREEN, 0.4)), 0.2),
    "base": (glass(BLUE, pbr=paint(0.7)), 0.2),
    "all, in a host": (glass(rough(BLUE, 0.5), GREEN, host=1.3, pbr=paint(0.6)), 0.2),
    "over some metal": (glass(rough(BLUE, 0.5), pbr=paint(0.5, metallic=0.4)), 0.2),
}


@pytest.mark.parametrize("shape", ["wall", "body"])
@pytest.mark.parametrize("made", ROUGH.values(), ids=ROUGH)
def test_a_white_room_is_not_left_brighter(
    look: Callable[..., Look], props: SimpleNamespace, made: Any, shape: str
) -> None:
    material, least = made
    changes = {"volume": body()} if shape == "body" else {}
    solid = props.sphere(24) if shape == "body" else props.quad()
    traced = look(solid, replace(material, **changes), 0.5).through(white(), paths=4096)
    seen, error = traced.colour[0] @ LUMINANCE, traced.standard_error[0] @ LUMINANCE
    assert least < seen < 1.0 + 4 * error
    assert error < 0.02


def test_clear_layers_let_rough_glass_send_all_on(look: Callable[..., Look], props: SimpleNamespace) -> None:
    """Layers in a host that mirror next to nothing: what is left is the base, which loses nothing."""
    clear = MirrorLayer(ior_2=1.0001, period_max_nm=1.0, fill=0.5)
    for shape, changes in ((props.quad(), {}), (props.sphere(24), {"volume": body()})):
        seen = look(shape, glass(clear, pbr=paint(0.6), **changes), 0.6)
        traced = seen.through(white(), paths=2048)
        assert np.all(np.abs(traced.colour - 1.0) < 4 * traced.standard_error + traced.lost[:, None] + 1e-3)


@pytest.mark.parametrize("made", ROUGH.values(), ids=ROUGH)
def test_paths_are_mirrored_as_image_light_is(
    look: Callable[..., Look], props: SimpleNamespace, made: Any
) -> None:
    """White in front and darkness behind: the mean over paths is ∫ f cosθ of `evaluate_lobes`."""
    seen = look(props.quad(), made[0], 0.6)
    traced = seen.through(room(1.0, 0.0), paths=16384)
    surface, sky = seen.surface(), EnvironmentMap(room(1.0, 0.0))
    rng = np.random.default_rng(1)
    colour, error = reflected(surface, seen.plan, sky, seen.film_on(0, surface), samples=8192, rng=rng)
    # Half of the horizon's texels count to either side.
    slack = 4 * traced.standard_error + 7 * error + 4e-3
    assert np.all(np.abs(traced.colour - colour) < slack)
    assert slack.max() < 0.04


def test_the_factor_mixes_layers_and_plain_glass(look: Callable[..., Look], props: SimpleNamespace) -> None:
    bare = Specular(factor=0.5)
    ends = []
    for factor in (1e-9, 0.3, 1.0):
        seen = look(props.quad(), glass(BLUE, factor=factor, specular=bare), 0.5)
        ends.append(seen.through(room(1.0, 0.2), paths=16384))
    plain, mixed, whole = (end.colour[0] for end in ends)
    error = sum(end.standard_error[0] for end in ends)
    assert np.abs(whole - plain).max() > 0.1
    assert np.all(np.abs(mixed - (0.7 * plain + 0.3 * whole)) < 4 * error)


def test_point_light_from_behind_crosses_all_layers_once(
    look: Callable[..., Look], props: SimpleNamespace
) -> None:
    """Against glass that mirrors nothing, whatever the light's angle: T_c · entering at the viewer's."""
    rng = np.random.default_rng(4)
    light = rng.normal(size=(40, 3))
    light[:, 2] = -np.abs(light[:, 2])
    light /= np.linalg.norm(light, axis=1, keepdims=True)
    clear = Specular(factor=0.0)
    material = glass(BLUE, GREEN, host=1.3, factor=0.5, pbr=paint(0.7, 0.2, 0.6), specular=clear)
    seen = look(props.quad(), material, 0.6)
    surface = seen.surface().take(np.zeros(40, np.int64))
    film = seen.film_on(0, surface)
    bare, stack = (
        evaluate_lobes(replace(surface, bragg_factor=np.full(40, factor)), light, film, seen.plan)
        for factor in (0.0, 1.0)
    )
    assert bare.max() > 1e-3
    assert_allclose(stack, seen.shares()[1] * bare, rtol=1e-9)
    # Nothing of a point's light passes a volume.
    thick = look(props.quad(), replace(material, volume=body()), 0.6)
    assert not evaluate_lobes(surface, light, film, thick.plan).any()


def test_base_colour_metal_and_what_passes_are_paid_on_entering_alone(
    look: Callable[..., Look], props: SimpleNamespace
) -> None:
    """Out of a body only layers, host and facets stand in the way, whatever its surface is made of."""
    seen = look(props.sphere(), glass(BLUE, GREEN, host=1.3, pbr=paint(0.5), volume=body()), 0.6)
    clear = seen.surface().take(np.zeros(200, np.int64))
    made = replace(
        clear,
        base_color=0.5 * clear.base_color,
        metallic=np.full(200, 0.4),
        transmission=np.full(200, 0.7),
    )
    back = np.tile([0.3, -0.2, np.sqrt(0.87)], (200, 1))

    def crossed(surface: Surface, leaves: bool) -> LocalCrossing:
        colours, rng = colours_of(seen.layers), np.random.default_rng(11)
        ways = np.full(200, 1.5), np.full(200, leaves), back
        return cross_layers(surface, seen.layers, lambda _: colours, *ways, rng)

    one, other = crossed(clear, True), crossed(made, True)
    assert 0 < one.passes.sum() < 200
    assert_array_equal(one.passes, other.passes)
    assert_array_equal(one.direction, other.direction)
    assert_array_equal(one.weight, other.weight)
    # On entering each is paid: a path that passes weighs the more, the rarer it is chosen to.
    into, tinted = crossed(clear, False), crossed(made, False)
    spent = [np.where(each.passes[:, None], each.weight, 0.0).mean(axis=0) for each in (into, tinted)]
    assert np.all(spent[1] < 0.4 * spent[0])


def test_what_is_transmitted_is_not_scattered(look: Callable[..., Look], props: SimpleNamespace) -> None:
    """The diffuse base below the layers keeps 1 − transmission."""
    seen = look(props.quad(), glass(BLUE, pbr=paint(0.5, colour=0.8)), 0.6)
    surface, light = seen.surface(), np.array([[0.3, -0.5, np.sqrt(0.66)]])
    sent = [
        evaluate_lobes(
            replace(surface, transmission=np.array([t])), light, seen.film_on(0, surface), seen.plan
        )
        for t in (0.0, 0.25, 1.0)
    ]
    assert np.all(sent[0] > sent[2])
    assert_allclose(sent[1], 0.75 * sent[0] + 0.25 * sent[2], rtol=1e-12)
