"""Landmarks are what their equations say they are, whichever way they are sought."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.optics.envelope_weight import envelope_weight, mean_envelope_ratio, normal_r_squared
from gltf_iri.optics.landmarks import ROOT_FINDERS, Band, RootFinder, band, envelope_transmittance, zero_point

Float64 = NDArray[np.float64]

# In modes. Newton's are met at r₁₂² < 0.25, twice that of any glass; halvings leave their last interval.
FINDER_ERROR = {"newton-2": 1e-9, "newton-1": 2e-4, "bisect-10": 0.5**10}


class Cells:
    """Random cells: path lengths q d, X of one polarisation, and a mode."""

    def __init__(self, count: int, *, r_max: float = 0.5) -> None:
        g = np.random.default_rng(20240501)
        self.path_1, self.path_2 = g.uniform(10.0, 900.0, (2, count))
        r = g.uniform(-r_max, r_max, count)
        self.contrast = (1.0 + r) / (1.0 - r)
        self.r_squared = r * r
        self.total = self.path_1 + self.path_2
        self.lean = (self.path_1 - self.path_2) / self.total
        self.mode = g.integers(0, 8, count).astype(np.float64)

    def cos_bloch(self, t: Any) -> Float64:
        """cos KΛ by Eq. 8, with ω = πt/(q₁d₁ + q₂d₂)."""
        omega = np.pi * t / self.total
        k1d1, k2d2 = omega * self.path_1, omega * self.path_2
        both = self.contrast + 1.0 / self.contrast
        return np.asarray(np.cos(k1d1) * np.cos(k2d2) - 0.5 * both * np.sin(k1d1) * np.sin(k2d2))

    def c_squared(self, t: Any) -> Float64:
        sine = np.sin(np.pi * t / self.total * self.path_2)
        return np.asarray((0.5 * (self.contrast - 1.0 / self.contrast) * sine) ** 2)

    def band(self, finder: RootFinder) -> Band:
        return band(self.mode, self.lean, self.r_squared, finder)


def test_two_newton_steps_meet_the_defining_equations() -> None:
    cells = Cells(5000)
    found = cells.band("newton-2")
    sign = np.where(cells.mode % 2 == 0, 1.0, -1.0)
    np.testing.assert_allclose(sign * cells.cos_bloch(found.start), 1.0, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(cells.cos_bloch(found.airy), 0.0, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(sign * cells.cos_bloch(found.end), -1.0, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("finder", ROOT_FINDERS)
def test_root_finders_find_the_same_landmarks(finder: RootFinder) -> None:
    cells = Cells(5000)
    exact = band_by_bisection(cells)
    found = cells.band(finder)
    for name in ("start", "airy", "end"):
        error = np.abs(getattr(found, name) - getattr(exact, name))
        assert error.max() < FINDER_ERROR[finder], name


def band_by_bisection(cells: Cells) -> Band:
    """Sixty halvings on cos KΛ, which nearly closed gaps leave uncertain by 1e-9."""

    def halve(low: Float64, high: Float64, level: Any) -> Float64:
        for _ in range(60):
            middle = 0.5 * (low + high)
            is_before = sign * cells.cos_bloch(middle) > level
            low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
        return low

    sign = np.where(cells.mode % 2 == 0, 1.0, -1.0)
    airy = halve(cells.mode, cells.mode + 1.0, 0.0)
    # The first band starts at ω = 0, where there is no gap.
    start = np.where(cells.mode == 0.0, 0.0, halve(cells.mode, airy, 1.0))
    return Band(start, airy, halve(airy, cells.mode + 1.0, -1.0))


@pytest.mark.parametrize("finder", ROOT_FINDERS)
def test_landmarks_come_in_their_order_for_every_contrast(finder: RootFinder) -> None:
    cells = Cells(5000, r_max=1.0)
    found = cells.band(finder)
    zero = zero_point(found, cells.lean)
    ordered = [cells.mode, found.start, found.airy, found.end, cells.mode + 1.0]
    assert all(np.all(a <= b) for a, b in pairwise(ordered))
    assert np.all((found.start <= zero) & (zero <= found.end))


def test_modes_lie_in_gaps_and_bands_between_them() -> None:
    cells = Cells(5000)
    found = cells.band("newton-2")
    assert np.all(np.abs(cells.cos_bloch(cells.mode)) >= 1.0 - 1e-12)  # Appendix A
    for share in (0.01, 0.3, 0.99):
        inside = found.start + share * (found.end - found.start)
        assert np.all(np.abs(cells.cos_bloch(inside)) <= 1.0)
        in_gap = cells.mode + share * (found.start - cells.mode)
        assert np.all(np.abs(cells.cos_bloch(in_gap)) >= 1.0 - 1e-12)


def test_nothing_passes_inside_gaps() -> None:
    cells = Cells(5000)
    found = cells.band("newton-2")
    width = found.start - cells.mode
    wide = width > 1e-3
    seen = envelope_transmittance(cells.mode + 0.5 * width, cells.lean, cells.r_squared)
    np.testing.assert_array_equal(seen[wide], 0.0)
    assert wide.sum() > 2000


def test_zero_points_reflect_nothing() -> None:
    cells = Cells(5000)
    found = cells.band("newton-2")
    zero = zero_point(found, cells.lean)
    is_one = zero != found.airy
    assert 0.2 < is_one.mean() < 0.9
    np.testing.assert_allclose(cells.c_squared(zero)[is_one], 0.0, atol=1e-24)
    seen = envelope_transmittance(zero, cells.lean, cells.r_squared)[is_one]
    np.testing.assert_allclose(seen, 1.0, rtol=0.0, atol=1e-12)


def test_the_envelope_is_equation_11() -> None:
    cells = Cells(5000)
    found = cells.band("newton-2")
    t = found.start + np.random.default_rng(2).uniform(0.02, 0.98, 5000) * (found.end - found.start)
    c = cells.c_squared(t)
    envelope = c / (c + 1.0 - cells.cos_bloch(t) ** 2)
    np.testing.assert_allclose(
        1.0 - envelope_transmittance(t, cells.lean, cells.r_squared), envelope, rtol=0.0, atol=1e-10
    )


def test_airy_points_reflect_like_one_slab() -> None:
    cells = Cells(5000)
    airy = cells.band("newton-2").airy
    r12 = (1.0 - cells.contrast) / (1.0 + cells.contrast)
    turned = np.exp(-2j * np.pi * airy / cells.total * cells.path_2)
    slab = np.abs(r12 * (1.0 - turned) / (1.0 - r12 * r12 * turned)) ** 2  # Eq. 10
    np.testing.assert_allclose(
        1.0 - envelope_transmittance(airy, cells.lean, cells.r_squared), slab, rtol=0.0, atol=1e-8
    )


@pytest.mark.parametrize("finder", ROOT_FINDERS)
def test_equal_media_leave_no_gap(finder: RootFinder) -> None:
    mode = np.arange(6.0)
    found = band(mode, 0.3, 0.0, finder)
    np.testing.assert_array_equal(found.start, mode)
    np.testing.assert_array_equal(found.end, mode + 1.0)


def test_the_published_weight_fits_its_mean_at_normal_incidence() -> None:
    n2 = np.array([1.3, 1.5, 2.0])
    r12 = normal_r_squared(1.0, n2)
    np.testing.assert_allclose(envelope_weight(r12, 1.0), mean_envelope_ratio(r12), rtol=0.0, atol=0.015)
    np.testing.assert_array_equal(envelope_weight(r12, 0.0), 1.0)


def test_the_mean_ratio_settles_with_the_number_of_cells() -> None:
    r12 = normal_r_squared(1.0, 1.5)
    limit = float(mean_envelope_ratio(r12))
    distances = [abs(float(mean_envelope_ratio(r12, cells)) - limit) for cells in (10, 30, 90)]
    assert distances[0] > distances[1] > distances[2]
    assert distances[2] < 0.002
