"""Diffuse surfaces under a map with a sun in it: E/π is the sum over all of the map's texels."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.rendering.environment_lamps import split_lamps
from gltf_iri.scene.model import Environment
from gltf_iri.scene.studio import directions

HEIGHT = 128


@pytest.mark.parametrize("tilt_deg", [0.0, 50.0, 100.0])
def test_a_sun_in_the_map_lights_chalk_as_much_as_its_texels_say(stage, props, tilt_deg):
    """The sun is taken out of the map and lit by formula; a third of the light is the sky's."""
    sky = np.ones((HEIGHT, 2 * HEIGHT, 3), np.float32)
    tilt = np.radians(tilt_deg)
    towards = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    sun = np.unravel_index(np.argmax(directions(HEIGHT) @ towards), sky.shape[:2])
    sky[sun] = (1e4, 6e3, 3e3)
    assert len(split_lamps(sky)[0]) == 1
    steradians = np.diff(-np.cos(np.pi * np.arange(HEIGHT + 1) / HEIGHT)) * (np.pi / HEIGHT)
    facing = np.maximum(directions(HEIGHT)[..., 2], 0.0) * steradians[:, None]
    expected = np.einsum("yx,yxc->c", facing, sky.astype(float)) / np.pi
    chalk = Material(pbr=MetallicRoughness(metallic_factor=0.0))
    seen = stage.draw(props.quad(), chalk, environment=Environment("sun", sky), with_inputs=True).inputs
    assert seen.irradiance[32, 32] == pytest.approx(expected, rel=5e-3)
