"""Means over bands: white is white, one is one, and products come out as those of the spectra."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gltf_iri.colour.bands import BANDS_MAX, BANDS_MIN, bands_of
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.wavelength_grid import grid_rule
from gltf_iri.errors import UsageError

COUNTS = (BANDS_MIN, 4, 7, 16, BANDS_MAX)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("white", ["D65", "E"])
def test_white_is_white(count: int, white: str) -> None:
    np.testing.assert_allclose(bands_of(count, white).weights.sum(axis=0), 1.0, atol=1e-12)


@pytest.mark.parametrize("count", COUNTS)
def test_means_of_a_constant_are_that_constant_by_any_rule(count: int) -> None:
    bands = bands_of(count, "D65")
    for rule in (colour_rule(256, "D65"), grid_rule(95, "D65")):
        means = bands.means(np.full((2, len(rule.wavelength_nm)), 0.3), rule)
        np.testing.assert_allclose(means, np.full((2, count), 0.3), atol=1e-12)


def test_bands_lie_in_the_order_of_wavelengths_and_within_the_visible_range() -> None:
    centres = bands_of(16, "D65").centres_nm
    assert np.all(np.diff(centres) > 0.0)
    assert centres[0] > 400.0
    assert centres[-1] < 700.0


def test_the_more_bands_the_less_they_err_of_products() -> None:
    rule = colour_rule(512, "D65")
    opd_nm = np.array([900.0, 1300.0, 1700.0, 2300.0])
    fringes = 0.5 + 0.5 * np.cos(2.0 * np.pi / rule.wavelength_nm * opd_nm[:, None])
    one, other = np.triu_indices(4, 1)
    truth = (fringes[one] * fringes[other]) @ rule.weights
    errors = []
    for count in (4, 8, 16, BANDS_MAX):
        bands = bands_of(count, "D65")
        means = bands.means(fringes, rule)
        errors.append(float(delta_e_2000((means[one] * means[other]) @ bands.weights, truth).max()))
    assert all(fine < 0.5 * coarse for coarse, fine in itertools.pairwise(errors))
    assert errors[-1] < 0.12


def test_what_as_many_cosines_hold_is_met_exactly() -> None:
    # On s, which runs evenly from band to band, cos(πs) is its value at each centre.
    bands = bands_of(16, "D65")
    rule = colour_rule(512, "D65")
    wave = np.cos(np.pi * np.interp(rule.wavelength_nm, *_place()))
    np.testing.assert_allclose(bands.means(wave, rule), np.cos(np.pi * (np.arange(16) + 0.5) / 16), atol=2e-3)


def _place() -> tuple[np.ndarray, np.ndarray]:
    """Return wavelengths and s there, read off the centres of all numbers of bands."""
    pairs = {0.0: 360.0, 1.0: 830.0}
    for count in range(BANDS_MIN, BANDS_MAX + 1):
        pairs.update(zip((np.arange(count) + 0.5) / count, bands_of(count, "D65").centres_nm, strict=True))
    places = np.array(sorted(pairs))
    return np.array([pairs[s] for s in places]), places


@pytest.mark.parametrize("count", [BANDS_MIN - 1, BANDS_MAX + 1])
def test_too_few_and_too_many_bands_are_refused(count: int) -> None:
    with pytest.raises(UsageError, match="3 to 64 bands"):
        bands_of(count, "D65")
