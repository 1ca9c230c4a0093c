"""Layers over what light passes: what lies behind shows through them, each crossed once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.baking.layer_fill import bake_layer_plans
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.comparison.methods import film_method
from gltf_iri.comparison.pixels import image_light_of_pixels, surface_of_pixels
from gltf_iri.comparison.shade import shade
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume
from gltf_iri.optics.layer_stack import Sight, coating_transmittance, cosine_in_host
from gltf_iri.optics.microfacet import alpha_ggx, d_ggx, v_smith_ggx_correlated
from gltf_iri.planning.decide import plan_materials
from gltf_iri.reference.layers_method import layers_method
from gltf_iri.rendering.layer_call import layer_table_call
from gltf_iri.rendering.timed_calls import call_colours
from gltf_iri.scene.environment import studio
from gltf_iri.scene.model import Light
from gltf_iri.tolerances import GLSL_LAYERS_MAX_ABS, GLSL_PIXEL_RELATIVE

pytestmark = pytest.mark.gl

LAYER = MirrorLayer(period_max_nm=220.0, cells=6, roughness=0.3)  # reflects green
# Quarter waves of 520 nm, whose gap reaches from 369 nm to 881 nm.
MIRROR = MirrorLayer(ior_2=4.0, period_min_nm=162.5, period_max_nm=162.5, fill=0.8, cells=30)
# What so small a step reflects, no picture shows.
CLEAR = MirrorLayer(ior_2=1.0 + 1e-8, period_max_nm=300.0)
NO_REFLECTION = Specular(factor=0.0)
SIZE = (24, 24)


def layered(
    *layers, colour=(1.0, 1.0, 1.0), metallic=0.0, roughness=0.4, share=1.0, host=1.0, factor=1.0, **others
):
    pbr = MetallicRoughness((*colour, 1.0), metallic_factor=metallic, roughness_factor=roughness)
    bragg = Bragg(factor, layers=layers, host_ior=host) if layers else None
    return Material(pbr=pbr, bragg=bragg, transmission=Transmission(share), **others)


def paint(colour):
    return Material(pbr=MetallicRoughness((*colour, 1.0)), unlit=Unlit())


def placed(shape, z, material, size=1.0):
    world = np.diag([size, size, size, 1.0])
    world[2, 3] = z
    return shape(world=world, material=material)


def sun(x, y, z, lux=2.0):
    return Light(
        "sun",
        "directional",
        (1.0, 0.9, 0.8),
        lux,
        np.zeros(3),
        -np.array([x, y, z]) / np.hypot(np.hypot(x, y), z),
    )


@pytest.fixture(scope="module")
def light():
    return studio()


@pytest.fixture
def drawn(stage):
    """Return a function that draws things of some materials, from small tables of their layers."""

    def draw(things, materials, *, method=None, **options):
        plans = [with_small_tables(plan) for plan in plan_materials(materials, method=method)]
        tables = bake_layer_plans(plans)
        options = {"size": SIZE, "samples": 0, "layer_tables": tables} | options
        return stage.draw(things, materials, plans=plans, **options), plans, tables

    return draw


def with_small_tables(plan):
    if plan.layers is None or plan.layers.tables is None:
        return plan
    return replace(plan, layers=replace(plan.layers, tables=replace(plan.layers.tables, cos_nodes=64)))


PANES = {
    "thin": layered(LAYER, colour=(0.9, 0.7, 0.5), share=0.7),
    "half, partly metal, under coat and fibres": layered(
        LAYER,
        replace(LAYER, period_max_nm=260.0),
        metallic=0.3,
        factor=0.5,
        share=0.9,
        clearcoat=Clearcoat(0.8, roughness_factor=0.3),
        sheen=Sheen((0.3, 0.2, 0.1), None, 0.5),
    ),
    "a body in a host": layered(
        LAYER,
        host=1.4,
        colour=(0.8, 0.9, 1.0),
        volume=Volume(0.8, None, 1.0, (0.9, 0.6, 0.8)),
        dispersion=Dispersion(2.0),
    ),
}


@pytest.mark.parametrize("name", PANES)
def test_pixels_that_light_passes_are_those_of_python(drawn, props, light, name, record_property):
    things = [placed(props.quad, -2.0, 0), placed(props.sphere, 0.0, 1)]
    materials, lights = [paint((0.9, 0.3, 0.1)), PANES[name]], [sun(-0.5, 0.7, 0.8), sun(0.4, 0.5, -0.7)]
    view = props.camera()
    frame, plans, tables = drawn(
        things,
        materials,
        lights=lights,
        environment=light,
        seen_from=view,
        with_inputs=True,
        float_textures=True,
    )
    inputs, plan = frame.inputs, plans[1]
    mask = inputs.material == 1
    pixels = surface_of_pixels(inputs, mask, view), image_light_of_pixels(inputs, mask)
    colours = layers_method(plan, None, tables, "D65")
    shading = shade(*pixels, plan, 1.0, lights, film_method("spectral", "D65"), colours)
    found = shading.rgb
    off = np.abs(frame.rgba[mask][:, :3] - found) / np.maximum(1.0, np.abs(found))
    record_property("measured", f"{name}: GLSL − Python {off.max():.1e}, {mask.sum()} pixels")
    assert mask.sum() > 150
    assert off.max() <= GLSL_PIXEL_RELATIVE
    # Held against truth are each layer, what passes all both ways, and what crosses them once; and something
    # of the picture comes from behind.
    assert shading.film.shape[1] == len(plan.layers.layers) + 2
    assert inputs.transmitted_radiance[mask].max() > 0.5


def test_light_that_comes_from_behind_crosses_each_layer_once(drawn, props):
    wall, colour = np.array([0.9, 0.3, 0.1]), np.array([0.8, 0.9, 1.0])
    things = [placed(props.quad, -1.0, 0), props.quad(material=1)]
    for host in (1.0, 1.4):
        pane = layered(
            LAYER, replace(LAYER, period_max_nm=260.0), host=host, colour=colour, share=0.7, roughness=0.0
        )
        frame, _, tables = drawn(things, [paint(wall), pane])
        crossed = LayerLookup(tables[1]).entering(1.0) * coating_transmittance(host, 1.0)
        assert frame.rgba[12, 12, :3] == pytest.approx(0.7 * colour * wall * crossed, abs=1e-5)
        assert crossed.min() < 0.9


@pytest.mark.parametrize("host", [1.0, 1.4])
def test_a_thin_wall_shows_a_sun_behind_it_through_facets_and_layers(drawn, props, host):
    pane = layered(LAYER, host=host, share=0.8, metallic=0.25, colour=(0.5, 0.9, 0.7))
    behind = sun(0.3, 0.2, -1.0)
    frame, _, tables = drawn([props.quad()], [pane], lights=[behind])
    away = -np.asarray(behind.direction)
    half = away * [1.0, 1.0, -1.0] + [0.0, 0.0, 1.0]
    half /= np.linalg.norm(half)
    alpha = alpha_ggx(0.4)
    lobe = d_ggx(1.0 - half[2] ** 2, alpha) * v_smith_ggx_correlated(-away[2], 1.0, alpha)
    crossed = LayerLookup(tables[0]).entering(1.0) * coating_transmittance(host, 1.0)
    # A quarter is metal, which lets nothing pass.
    expected = (
        0.75 * 0.8 * np.array([0.5, 0.9, 0.7]) * crossed * lobe * -away[2] * 2.0 * np.array([1.0, 0.9, 0.8])
    )
    assert frame.rgba[12, 12, :3] == pytest.approx(expected, rel=1e-4)
    body, _, _ = drawn([props.quad()], [replace(pane, volume=Volume(0.5))], lights=[behind])
    assert not body.rgba[12, 12, :3].any()


@pytest.mark.parametrize("volume", [None, Volume(0.5, None, 1.0, (0.9, 0.6, 0.8))])
def test_layers_that_reflect_nothing_are_glass_without_an_interface(drawn, props, light, volume):
    things = [
        placed(props.quad, -2.0, 0),
        placed(props.quad, 0.0, 1),
    ]  # no light grazes, as it does on a ball
    lights = [sun(-0.5, 0.7, 0.8), sun(0.4, 0.5, -0.7)]
    seen = [
        drawn(
            things,
            [paint((0.9, 0.3, 0.1)), layered(*layers, share=0.7, volume=volume, specular=NO_REFLECTION)],
            lights=lights,
            environment=light,
            seen_from=props.camera(),
        )[0].rgba
        for layers in ((CLEAR,), ())
    ]
    assert np.abs(seen[0] - seen[1]).max() <= 1e-6


def test_a_mirror_of_all_light_shows_nothing_from_behind(drawn, props, furnace):
    things = [placed(props.quad, -1.0, 0), props.quad(material=1)]
    mirror = layered(MIRROR)
    frame, _, tables = drawn(things, [paint((1.0, 1.0, 1.0)), mirror], lights=[sun(0.3, 0.2, -1.0)])
    assert LayerLookup(tables[1]).reflected(0, 1.0, 1.0, 1.0) == pytest.approx(np.ones(3), abs=2e-3)
    assert frame.rgba[12, 12, :3].max() < 2e-3


def test_over_black_nothing_comes_from_behind_and_no_layer_is_asked_for_it(drawn, props):
    things = [placed(props.quad, -1.0, 0), props.quad(material=1)]
    frame, plans, _ = drawn(things, [paint((1.0, 1.0, 1.0)), layered(LAYER, colour=(0.0, 0.0, 0.0))])
    assert plans[1].layers.under == "nothing"
    assert not frame.rgba[12, 12, :3].any()


def test_layers_of_hardly_any_strength_are_the_plain_glass(drawn, props, light):
    things = [placed(props.quad, -2.0, 0), placed(props.sphere, 0.0, 1)]
    lights = [sun(-0.5, 0.7, 0.8), sun(0.4, 0.5, -0.7)]
    faint, plain = (
        drawn(
            things,
            [paint((0.9, 0.3, 0.1)), layered(*layers, share=0.7, factor=1e-9, volume=Volume(0.5))],
            lights=lights,
            environment=light,
            seen_from=props.camera(),
        )[0].rgba
        for layers in ((LAYER,), ())
    )
    assert np.abs(faint - plain).max() < 1e-6


def test_a_white_room_sees_no_more_through_layers_than_it_sends(drawn, props, furnace):
    pane = layered(LAYER, replace(LAYER, period_max_nm=260.0), host=1.4, share=0.5)
    frame, _, _ = drawn([props.sphere()], [pane], environment=furnace, seen_from=props.camera())
    # Linear Rec.709 may exceed white in a channel; what is seen in all may not.
    luminance = frame.rgba[..., :3] @ [0.2126, 0.7152, 0.0722]
    assert 0.5 < luminance[12, 12] < 1.0
    assert luminance.max() <= 1.0 + 1e-5


def test_tables_are_crossed_once_in_glsl_as_in_python(gl_context, record_property):
    g = np.random.default_rng(5)
    cosines = g.uniform(size=500)
    ones = np.ones(len(cosines))
    sight, layers = Sight(ones, cosines, ones, ones, ones), (LAYER, replace(LAYER, period_max_nm=260.0))
    for method in ("layers-bands", "layers-rgb"):
        (plan,) = (with_small_tables(each) for each in plan_materials([layered(*layers)], method=method))
        baked = bake_layer_plans([plan])[0]
        call = layer_table_call(gl_context, baked, sight, [len(layers) + 1])
        try:
            found = call_colours(gl_context, call, len(cosines))
        finally:
            for texture in call.textures.values():
                texture.release()
        off = np.abs(found - LayerLookup(baked).entering(cosines)).max()
        record_property("measured", f"{method}, crossed once: GLSL − Python {off:.1e}")
        assert off <= GLSL_LAYERS_MAX_ABS


def test_layers_computed_directly_are_crossed_once_too(drawn, props, record_property):
    wall = np.array([0.9, 0.3, 0.1])
    things = [placed(props.quad, -2.0, 0, size=2.0), placed(props.sphere, 0.0, 1)]
    pane = layered(LAYER, replace(LAYER, period_max_nm=260.0), host=1.4, roughness=0.0)
    frame, plans, tables = drawn(
        things, [paint(wall), pane], method="layers-single", size=(12, 12), with_inputs=True
    )
    assert not tables
    mask = frame.inputs.material == 1
    cosine = frame.inputs.normal[mask][:, 2].astype(np.float64)
    stack = planned_stack(plans[1].layers, np.ones(mask.sum()))
    crossed = layer_colours("layers-single", stack).entering(cosine_in_host(1.4, cosine))
    expected = wall * crossed * coating_transmittance(1.4, cosine)[:, None]
    off = np.abs(frame.rgba[mask][:, :3] - expected).max()
    record_property("measured", f"layers-single, crossed once: GLSL − Python {off:.1e}")
    assert off <= 1e-3  # 129 fixed wavelengths stand for a rule that settles
