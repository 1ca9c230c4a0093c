"""The cumulative integrals that weigh pieces of a spectrum."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.colour.cumulative import cumulative_colour, cumulative_steps
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.spaces import WHITES, White

# Linear between 1024 steps; the sharpest turn of the weights leaves this.
STEP_ERROR = 3e-5


@pytest.mark.parametrize("white", WHITES)
def test_a_box_weighs_what_the_dense_sum_over_it_does(white: White) -> None:
    g = np.random.default_rng(3)
    low_nm, high_nm = np.sort(g.uniform(340.0, 850.0, (2, 200)), axis=0)
    step_nm = 0.01
    wavelength_nm = np.arange(360.0 + 0.5 * step_nm, 830.0, step_nm)
    density = colour_density(wavelength_nm, white) * step_nm
    inside = (wavelength_nm > low_nm[:, None]) & (wavelength_nm < high_nm[:, None])
    differences = cumulative_colour(1.0 / low_nm, white) - cumulative_colour(1.0 / high_nm, white)
    # A dense sum misses up to a step of its own at either end.
    rough = 2.0 * np.abs(density).max()
    np.testing.assert_allclose(differences, inside @ density, rtol=0.0, atol=2.0 * STEP_ERROR + rough)


@pytest.mark.parametrize("white", WHITES)
def test_the_integrals_run_from_nothing_to_white(white: White) -> None:
    steps = cumulative_steps(white)
    np.testing.assert_allclose(steps[0], 0.0, rtol=0.0, atol=1e-15)
    np.testing.assert_array_equal(steps[-1], 1.0)
    np.testing.assert_array_equal(cumulative_colour(np.array([0.0, 1e300]), white), [steps[0], steps[-1]])


def test_linear_steps_are_close_to_the_integral() -> None:
    steps = cumulative_steps("D65")
    # What a line misses of a curve, h²f″/8, from second differences.
    assert np.abs(np.diff(steps, 2, axis=0)).max() / 8.0 < STEP_ERROR
