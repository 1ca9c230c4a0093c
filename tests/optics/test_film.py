"""The phase of a film, where light runs along it."""

from __future__ import annotations

import numpy as np

from gltf_iri.optics.film import tangent_over_q


def test_phase_is_continuous_where_light_grazes_inside_the_film() -> None:
    on_either_side = tangent_over_q([-1e-12, 0.0, 1e-12], 0.7)
    assert np.abs(on_either_side - 2.0 * np.pi * 0.7).max() <= 1e-10
