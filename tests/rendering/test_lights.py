"""Punctual lights against KHR_lights_punctual's formulas on a surface that only scatters."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.scene.model import Light

# Without reflection the surface sends E · colour / π.
CHALK = Material(
    pbr=MetallicRoughness((0.5, 0.25, 1.0, 1.0), metallic_factor=0.0), specular=Specular(factor=0.0)
)
DOWN = np.array([0.0, 0.0, -1.0])


def lamp(kind, **more):
    return Light("", kind, (1.0, 0.5, 0.25), 8.0, np.array([0.2, 0.1, 1.5]), DOWN, **more)


def lit(stage, props, *lights):
    frame = stage.draw(props.quad(), CHALK, lights=lights, size=(65, 65), with_inputs=True)
    return frame.inputs.position.astype(np.float64), frame.inputs.colour.astype(np.float64)


def scattered(illuminance):
    return illuminance[..., None] * np.array([0.5, 0.25, 1.0]) * np.array([1.0, 0.5, 0.25]) / np.pi


def test_a_point_light_falls_off_with_the_square_of_the_distance(stage, props):
    light = lamp("point")
    position, colour = lit(stage, props, light)
    towards = light.position - position
    distance = np.linalg.norm(towards, axis=-1)
    assert colour == pytest.approx(scattered(8.0 * towards[..., 2] / distance**3), rel=1e-5)


def test_more_lights_than_fit_are_told(stage, props):
    with pytest.raises(MissingCapabilityError, match="1000000 lights"):
        lit(stage, props, *[lamp("point")] * 1_000_000)


def test_the_range_windows_the_falloff(stage, props):
    light = lamp("point", range_m=1.8)
    position, colour = lit(stage, props, light)
    towards = light.position - position
    distance = np.linalg.norm(towards, axis=-1)
    window = np.clip(1.0 - (distance / 1.8) ** 4, 0.0, 1.0)
    assert (window == 0.0).any()
    assert colour == pytest.approx(
        scattered(8.0 * window * towards[..., 2] / distance**3), rel=1e-4, abs=1e-6
    )


def test_a_spot_fades_between_its_cones(stage, props):
    light = lamp("spot", inner_cone_rad=0.2, outer_cone_rad=0.5)
    position, colour = lit(stage, props, light)
    towards = light.position - position
    distance = np.linalg.norm(towards, axis=-1)
    cosine = towards[..., 2] / distance
    fade = np.clip((cosine - np.cos(0.5)) / (np.cos(0.2) - np.cos(0.5)), 0.0, 1.0) ** 2
    assert (fade == 0.0).any() and (fade == 1.0).any()
    assert colour == pytest.approx(scattered(8.0 * fade * cosine / distance**2), rel=1e-4, abs=1e-5)


def test_a_directional_light_does_not_fall_off(stage, props):
    _, colour = lit(stage, props, lamp("directional"))
    assert colour == pytest.approx(np.broadcast_to(scattered(np.float64(8.0)), colour.shape), rel=1e-6)


def test_lights_add_up_and_one_behind_the_surface_adds_nothing(stage, props):
    behind = Light("", "directional", (1.0, 1.0, 1.0), 5.0, np.zeros(3), -DOWN)
    _, one = lit(stage, props, lamp("point"))
    _, three = lit(stage, props, lamp("point"), behind, lamp("point"))
    assert three == pytest.approx(2.0 * one, rel=1e-6)


def test_a_light_straight_behind_what_leans_over_the_edge_leaves_finite_pixels(stage, props):
    # Normals that lean away from the viewer, towards a light that shines right into the camera.
    normals = np.tile(np.float32([0.8, 0.0, -0.6]), (4, 1))
    into_the_camera = Light("", "directional", (1.0, 1.0, 1.0), 5.0, np.zeros(3), -DOWN)
    frame = stage.draw(props.quad(normals=normals), Material(), lights=[into_the_camera])
    assert np.isfinite(frame.rgba).all()


def test_a_scene_without_any_light_is_black_and_says_so(stage, props):
    frame = stage.draw(props.quad(), CHALK)
    assert frame.rgba[32, 32].tolist() == [0, 0, 0, 1]
    assert any("no light" in note for note in frame.notes)
