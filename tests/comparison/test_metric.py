"""The metric on numbers known beforehand."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.comparison.metric import agreement, colour_error, relative_deviation


def test_deviation_is_absolute_below_one_and_relative_above() -> None:
    value = np.array([[0.5, 0.0, 0.0], [110.0, 0.0, 0.0]])
    reference = np.array([[0.25, 0.0, 0.0], [100.0, 0.0, 0.0]])
    np.testing.assert_allclose(relative_deviation(value, reference), [0.25, 0.1])


def test_agreement_holds_the_largest_of_all_pixels_and_channels() -> None:
    value = np.zeros((3, 3))
    value[1, 2] = 1e-3
    result = agreement(value, np.zeros((3, 3)))
    assert (result.pixels, result.max_abs, result.max_relative) == (3, 1e-3, 1e-3)
    assert result.within(1e-3)
    assert not result.within(0.9e-3)


def test_a_pixel_that_is_no_number_never_agrees() -> None:
    value = np.zeros((2, 3))
    value[0, 0] = np.nan
    result = agreement(value, np.zeros((2, 3)))
    assert result.non_finite == 1
    assert not result.within(1.0)


def test_nothing_to_compare_is_no_figure_and_no_disagreement() -> None:
    nothing = np.zeros((0, 3))
    assert agreement(nothing, nothing).max_relative is None
    assert agreement(nothing, nothing).within(0.0)
    assert colour_error(nothing, nothing).delta_e_mean is None


def test_grey_differs_from_white_by_its_lightness() -> None:
    """Y = 0.18 is L* = 116·0.18^⅓ − 16 = 49.496; ΔE2000 of greys is ΔL*/S_L at the mean lightness."""
    lightness = 116.0 * 0.18 ** (1.0 / 3.0) - 16.0
    offset = ((lightness + 100.0) / 2.0 - 50.0) ** 2
    expected = (100.0 - lightness) / (1.0 + 0.015 * offset / np.sqrt(20.0 + offset))
    error = colour_error(np.full((4, 3), 0.18), np.ones((4, 3)))
    assert error.delta_e_mean == pytest.approx(expected, rel=1e-3)
    assert error.delta_e_max == pytest.approx(error.delta_e_p95, rel=1e-12)
    assert error.max_abs == pytest.approx(0.82)


def test_exposure_reaches_the_colour_difference_but_not_the_linear_one() -> None:
    value, truth = np.full((1, 3), 0.09), np.full((1, 3), 0.1)
    dark, bright = colour_error(value, truth), colour_error(value, truth, exposure=4.0)
    doubled = colour_error(4.0 * value, 4.0 * truth)
    assert bright.delta_e_mean == doubled.delta_e_mean
    assert bright.max_abs == dark.max_abs
