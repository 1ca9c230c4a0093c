"""The bounds of the p95 that a budget relies on."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.colour.quantile import CONFIDENCE, LOOKS, SHARE, bounds, ranks


@pytest.mark.parametrize("count", LOOKS)
def test_the_upper_bound_misses_the_true_p95_as_seldom_as_is_said(count: int) -> None:
    below = np.random.default_rng(0).binomial(count, SHARE, 400_000)
    _, high = ranks(count)
    # The bound lies below the true p95 where more errors than its place do.
    allowed = (1.0 - CONFIDENCE) / len(LOOKS)
    assert np.mean(below > high) <= allowed * 1.3 + 1e-5
    assert np.mean(below > high - 1) > allowed * 0.7


@pytest.mark.parametrize("count", LOOKS)
def test_the_p95_lies_between_the_bounds(count: int) -> None:
    low, high = bounds(np.linspace(0.0, 1.0, count))
    assert low < SHARE < high
    assert high - low < 1.4 / np.sqrt(count)


def test_colours_that_are_undefined_are_infinitely_wrong() -> None:
    errors = np.full(256, 0.1)
    errors[:30] = np.nan
    assert bounds(errors)[0] == np.inf
    errors[2:] = 0.1
    assert bounds(errors)[1] == pytest.approx(0.1)


def test_of_few_errors_the_greatest_bounds() -> None:
    assert bounds(np.arange(20.0))[1] == 19.0
