"""Normals that files write shorter than they should."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.scene.normals import unit


@pytest.mark.parametrize("length", [1.0, 1e-3, 1e-12, 1e-38])
def test_a_normal_of_any_length_keeps_its_direction(length):
    directions, lost = unit(np.array([[0.0, -length, 0.0], [length, 0.0, length]], np.float32))
    assert not lost.any()
    np.testing.assert_allclose(directions, [(0.0, -1.0, 0.0), (0.5**0.5, 0.0, 0.5**0.5)], atol=1e-7)


def test_only_a_normal_of_length_0_is_lost():
    directions, lost = unit(np.zeros((1, 3), np.float32))
    assert lost.all()
    np.testing.assert_array_equal(directions, [(0.0, 0.0, 1.0)])
