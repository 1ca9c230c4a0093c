"""Arrays broadcast, or the call is wrong."""

from __future__ import annotations

import numpy as np
import pytest

import gltf_iri
from gltf_iri.errors import UsageError


def test_shapes_that_do_not_broadcast_are_a_wrong_call():
    with pytest.raises(UsageError, match="do not broadcast"):
        gltf_iri.evaluate(cos_theta_1=[0.1, 0.2, 0.3], thickness_nm=[1.0, 2.0])


def test_angles_and_thicknesses_span_a_table():
    table = gltf_iri.evaluate(cos_theta_1=np.ones((5, 1)), thickness_nm=np.arange(7.0)).rgb
    assert table.shape == (5, 7, 3)
