"""Light of punctual sources, where GLSL and Python could part."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.rendering.punctual_lights import pack_lights
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Light

DOWN = np.array([0.0, 0.0, -1.0])


@pytest.mark.parametrize("width", [0.0, 2e-4])
def test_the_sharpest_cone_still_fades_over_a_thousandth_in_cosine(width):
    outer_cosine = 0.8
    angles = {"inner_cone_rad": np.arccos(outer_cosine + width), "outer_cone_rad": np.arccos(outer_cosine)}
    lamp = Light("", "spot", (1.0, 1.0, 1.0), 1.0, np.zeros(3), DOWN, **angles)
    cosine = outer_cosine + np.array([-1e-4, 0.0, 2.5e-4, 5e-4, 1e-3, 2e-3])
    place = np.column_stack([np.sqrt(1.0 - cosine**2), np.zeros_like(cosine), -cosine])  # at 1 m
    _, illuminance = arriving(lamp, place)
    np.testing.assert_allclose(illuminance[:, 0], [0.0, 0.0, 0.0625, 0.25, 1.0, 1.0], atol=1e-9)
    scale, offset = pack_lights([lamp])[0, 3, :2]
    np.testing.assert_allclose((scale, offset), (1000.0, -800.0), rtol=1e-6)
