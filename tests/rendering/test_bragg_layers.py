"""Pictures of Bragg layers: each pixel is what Python makes of what the pixel was shaded with."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from bragg_files import CUTICLE, MATERIALS, bragg_ball

from gltf_iri.baking.layer_fill import bake_layer_plans
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.microfacet import ALPHA_MIN, alpha_ggx, d_ggx, v_smith_ggx_correlated
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_switches import is_whole
from gltf_iri.scene.environment import studio
from gltf_iri.scene.load import load
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

pytestmark = pytest.mark.gl

SIZE = (64, 64)

# Filled tables by what they hold: many tests draw the same ball.
_FILLED = {}


def tables_of(plans):
    key = repr([plan.layers for plan in plans])
    if key not in _FILLED:
        _FILLED[key] = bake_layer_plans(plans)
    return _FILLED[key]


def with_small_tables(layers):
    if layers.tables is None:
        return layers
    nodes = min(layers.tables.period_nodes, 12)
    return replace(layers, tables=replace(layers.tables, cos_nodes=48, period_nodes=nodes))


@pytest.fixture(scope="module")
def light():
    return studio()


@pytest.fixture
def shown(stage, tmp_path):
    """Return a function that draws a ball, under its two suns where is_lit, and tells all about it."""

    def draw(name, environment=None, *, is_lit=True, method=None, size=SIZE, **changes):
        model = load(bragg_ball(tmp_path / name, name, **changes))
        scene = model.scene() if is_lit else replace(model.scene(), lights=())
        plans = plan_materials(model.materials, method=method, document=model.document, scene=scene)
        plans = tuple(replace(plan, layers=with_small_tables(plan.layers)) for plan in plans)
        tables = tables_of(plans)
        options = {"size": size, "with_inputs": True, "float_textures": True, "layer_tables": tables}
        (camera,) = scene.cameras
        frame = stage.renderer.render(model, scene, plans, camera, environment, **options)
        plain = frame
        if not is_whole(plans[0]):
            bare = plan_materials([replace(each, bragg=None) for each in model.materials])
            plain = stage.renderer.render(model, scene, bare, camera, environment, size=size, samples=0)
        return Shown(frame, plain, plans[0], tables.get(0), scene, camera)

    return draw


class Shown:
    """A picture, what its pixels were shaded with, and where a factor mixes the same without layers."""

    def __init__(self, frame, plain, plan, baked, scene, camera):
        self.plan, self.baked, self.scene, self.frame = plan, baked, scene, frame
        inputs = frame.inputs
        normal = inputs.normal.astype(np.float64)
        eye = np.linalg.inv(camera.view)[:3, 3]
        view = eye - inputs.position
        view /= np.linalg.norm(view, axis=-1, keepdims=True)
        # Cosines near 0 have lost their digits in float32.
        self.mask = (inputs.material == 0) & (np.sum(normal * view, axis=-1) > 0.05)
        self.n, self.v = normal[self.mask], view[self.mask]
        self.n_dot_v = np.minimum(np.sum(self.n * self.v, axis=-1), 1.0)
        self.inputs = SimpleNamespace(
            **{f: getattr(inputs, f)[self.mask].astype(np.float64) for f in inputs.__dataclass_fields__}
        )
        self.drawn = frame.rgba[self.mask][:, :3].astype(np.float64)
        self.plain = plain.rgba[self.mask][:, :3].astype(np.float64)
        layers = plan.layers
        period_nm = [np.mean(layer.period_nm) for layer in layers.layers]  # colours come from elsewhere
        i = self.inputs
        self.stack = LayerStack.of(
            tuple(
                BraggLayer.of(
                    layer.n1, layer.n2, layer.fill * nm, (1 - layer.fill) * nm, layer.cells, layer.alpha
                )
                for layer, nm in zip(layers.layers, period_nm, strict=True)
            ),
            layers.host_ior,
            LayerBase.of(
                (1.0 - i.metallic[:, None]) * i.base_color,
                i.base_color,
                i.metallic,
                alpha_ggx(i.perceptual_roughness),
            ),
        )

    def colours(self):
        return LayerLookup(self.baked, self.inputs.bragg_period_texel)

    def under_lights(self, colours):
        """Return what the layers send of the scene's suns (n, 3), and the coating's mirror image of them."""
        sent, mirrored = np.zeros_like(self.drawn), np.zeros_like(self.drawn)
        for sun in self.scene.lights:
            to_light = -np.asarray(sun.direction)
            n_dot_l = self.n @ to_light
            facing = np.maximum(n_dot_l, 0.0)
            across_l, across_v = to_light - n_dot_l[:, None] * self.n, self.v - self.n_dot_v[:, None] * self.n
            lengths = np.linalg.norm(across_l, axis=-1) * np.linalg.norm(across_v, axis=-1)
            cos_phi = np.clip(np.sum(across_l * across_v, axis=-1) / np.maximum(lengths, 1e-12), -1.0, 1.0)
            lux = sun.intensity * facing[:, None] * np.asarray(sun.colour)
            sent += lux * brdf(self.stack, Pose.of(np.minimum(facing, 1.0), self.n_dot_v, cos_phi), colours)
            h = self.v + to_light
            h /= np.linalg.norm(h, axis=-1, keepdims=True)
            tilt = np.sum(np.cross(self.n, h) ** 2, axis=-1)
            weight = coating_reflectance(self.stack.host_ior, np.sum(self.v * h, axis=-1))
            lobe = d_ggx(tilt, ALPHA_MIN) * v_smith_ggx_correlated(facing, self.n_dot_v, ALPHA_MIN)
            mirrored += lux * (weight * np.where(facing > 0.0, lobe, 0.0))[:, None]
        return sent, mirrored

    def under_sky(self, colours):
        """Return what the layers send of image light (n, 3), of what each of their lobes receives."""
        i, host = self.inputs, self.stack.host_ior
        image = colours.image(cosine_in_host(host, self.n_dot_v), i.perceptual_roughness)
        radiance = (i.bragg_radiance_0, i.bragg_radiance_1, i.bragg_radiance_2, i.bragg_radiance_3)
        sent = sum(colour * part for colour, part in zip(image.layers, radiance, strict=False))
        metal = i.base_color * image.slope + image.offset
        sent = sent + i.metallic[:, None] * metal * i.bragg_metal_radiance
        bent = (host / self.stack.exit_ior) ** 2
        scattered = self.stack.base.diffuse * bent * image.diffuse * i.irradiance
        if host == 1.0:
            return sent + scattered
        passed = coating_transmittance(host, self.n_dot_v)[:, None]
        return passed * (sent + scattered) + (1.0 - passed) * i.bragg_coating_radiance

    def mixed(self, layered):
        return self.plain + self.inputs.bragg_factor[:, None] * (layered - self.plain)


@pytest.mark.parametrize("name", MATERIALS)
def test_pixels_under_lights_are_those_of_python(shown, name, record_property):
    ball = shown(name)
    sent, mirrored = ball.under_lights(ball.colours())
    expected = ball.mixed(sent + mirrored)
    # The coating mirrors like a lobe of roughness 0.03, which amplifies the rounding of directions.
    judged = mirrored.max(axis=-1) < 1e-3
    assert judged.mean() > 0.95
    off = np.abs(ball.drawn - expected) / np.maximum(1.0, np.abs(expected))
    record_property("measured", f"{name}: GLSL − Python under lights {off[judged].max():.1e}")
    assert ball.drawn.max() > 0.5
    assert off[judged].max() <= GLSL_PIXEL_RELATIVE
    assert off.max() < 0.02


@pytest.mark.parametrize("name", MATERIALS)
def test_pixels_under_a_sky_are_those_of_python(shown, light, name, record_property):
    ball = shown(name, light, is_lit=False)
    expected = ball.mixed(ball.under_sky(ball.colours()))
    off = np.abs(ball.drawn - expected) / np.maximum(1.0, np.abs(expected))
    record_property("measured", f"{name}: GLSL − Python under a sky {off.max():.1e}")
    assert ball.drawn.max() > 0.1
    assert off.max() <= GLSL_PIXEL_RELATIVE


@pytest.mark.parametrize("method", ["layers-rgb", "layers-single-table"])
def test_other_methods_come_out_of_the_same_tables(shown, method):
    ball = shown("two over metal", method=method)
    assert ball.plan.layers.method == method
    sent, _ = ball.under_lights(ball.colours())
    assert np.abs(ball.drawn - sent).max() <= GLSL_PIXEL_RELATIVE * np.maximum(1.0, sent).max()


def test_the_truth_is_drawn_directly(shown, record_property):
    ball = shown("beetle", method="layers-single", size=(32, 32))
    assert ball.plan.layers.tables is None and ball.baked is None
    stack = replace(ball.stack, base=LayerBase.of())
    sent, _ = ball.under_lights(layer_colours("layers-single", stack))
    off = np.abs(ball.drawn - sent) / np.maximum(1.0, sent)
    record_property("measured", f"layers-single in GLSL − Python {off.max():.1e}")
    assert off.max() <= 1e-3  # 512 fixed wavelengths stand for a rule that settles


def test_periods_drawn_directly_count_from_the_darkest_texel(shown):
    textured = CUTICLE | {"periodMinimum": 120.0, "roughness": 0.05**0.5}
    ball = shown(
        "beetle",
        method="layers-single",
        size=(12, 12),
        darkest_texel=0.4,
        layers=[textured],
        braggPeriodTexture={"index": 0},
    )
    assert ball.baked is None and ball.plan.layers.texel.low > 0.35
    (layer,) = ball.stack.layers
    period_nm = 120.0 + 40.0 * ball.inputs.bragg_period_texel
    assert np.ptp(period_nm) > 10.0
    share = CUTICLE["fill"]
    films = replace(layer, d1_nm=share * period_nm, d2_nm=(1.0 - share) * period_nm)
    stack = LayerStack.of((films,), ball.stack.host_ior)
    sent, _ = ball.under_lights(layer_colours("layers-single", stack))
    assert sent.max() > 0.1
    assert np.all(np.abs(ball.drawn - sent) <= 1e-3 * np.maximum(1.0, sent))  # as the truth is above


def test_what_a_renderer_would_cut_short_is_refused(stage, shown):
    if "llvmpipe" not in stage.renderer.context.info["GL_RENDERER"]:
        pytest.skip("only llvmpipe ends long loops")
    with pytest.raises(MissingCapabilityError, match="layers-single-table"):
        shown("two over metal", studio(), method="layers-single", layers=[{"cells": 9}] * 4)


def test_layers_without_their_tables_are_refused(stage, tmp_path):
    model = load(bragg_ball(tmp_path, "beetle"))
    scene = model.scene()
    plans = plan_materials(model.materials)
    with pytest.raises(UsageError, match="bake_layer_plans"):
        stage.renderer.render(model, scene, plans, scene.cameras[0], None, size=SIZE)


def test_a_factor_of_0_draws_the_plain_material(shown):
    ball = shown("painted", braggFactor=1e-9)
    assert ball.plan.calls_for(Effect.BRAGG)
    assert np.abs(ball.drawn - ball.plain).max() < 1e-6


def test_a_white_sky_shows_the_albedo_of_a_layer_over_nothing(shown, furnace):
    ball = shown("beetle", furnace, is_lit=False)
    expected = LayerLookup(ball.baked).image(ball.n_dot_v).layers[0]
    assert np.abs(ball.drawn - expected).max() < 1e-4
    assert ball.drawn.max() < 1.0
