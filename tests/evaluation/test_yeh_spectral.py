"""The truth for mirrors is an integral that has converged, and knows what one film's truth knows."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.mirror_set import low_contrast_set, mirror_set
from gltf_iri.colour.adaptive import integrate_adaptive
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.yeh_spectral import mirror_spectrum
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.tolerances import SPECTRAL_COLOUR_MAX_ABS


@pytest.mark.parametrize(
    "mirror",
    [
        mirror_set(20, 4),
        low_contrast_set(30, 4),
        Mirror.of([0.3, 0.9], 1.4, 1.8 + 0.02j, 120.0, 150.0, 40, 1.0),
        Mirror.of([0.3, 0.6], 1.5, 1.2, 120.0, 90.0, 12),
    ],
    ids=["20 cells", "low contrast", "absorbing", "total reflection inside"],
)
@pytest.mark.parametrize("white", ["D65", "E"])
def test_panels_between_the_observers_steps_give_the_same_colour(mirror: Mirror, white: str) -> None:
    nodes, gauss = np.polynomial.legendre.leggauss(16)
    edges_nm = np.linspace(360.0, 830.0, 470 * 24 + 1)
    half = 0.5 * np.diff(edges_nm)[:, None]
    wavelength_nm = (edges_nm[:-1, None] + half * (1.0 + nodes)).ravel()
    weights = colour_density(wavelength_nm, white) * (half * gauss).reshape(-1, 1)  # type: ignore[arg-type]
    summed = mirror_spectrum(mirror, wavelength_nm) @ weights
    assert np.abs(evaluate("yeh-spectral", mirror, white=white).rgb - summed).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_of_200_cells_panels_begun_eight_times_finer_find_nothing_more() -> None:
    """Dips next to the band edges are so narrow that even panels of an eighth of a fringe pass over them."""
    mirror = mirror_set(200, 4)

    def reflectance(rows: NDArray[np.intp], wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        columns = (mirror.n2.real, mirror.d1_nm, mirror.d2_nm, mirror.cos_theta_h)
        n2, d1_nm, d2_nm, cosine = (each[rows, None] for each in columns)
        return bragg_reflectance(1.0, 1.0, n2, d1_nm, d2_nm, 200, wavelength_nm, cosine)

    opd_nm = 400.0 * (mirror.d1_nm + mirror.n2.real * mirror.d2_nm)
    finer = integrate_adaptive(reflectance, np.arange(4), white="D65", opd_nm=8.0 * opd_nm)
    assert np.abs(evaluate("yeh-spectral", mirror).rgb - finer).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_one_cell_has_the_colour_of_the_film() -> None:
    cosine, d2_nm = np.array([0.2, 0.7, 1.0]), np.array([[90.0], [400.0]])
    mirror = evaluate("yeh-spectral", Mirror.of(cosine, 1.3, 1.9, 77.0, d2_nm, 1)).rgb
    film = evaluate("spectral", Film.of(cosine, d2_nm, 1.9, base_from_ior(1.3), 1.3)).rgb
    assert np.abs(mirror - film).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_many_cells_differ_from_more_by_less_and_less() -> None:
    rgb = [evaluate("yeh-spectral", mirror_set(cells, 2)).rgb for cells in (200, 1000, 4000)]
    first, second = (np.abs(b - a).max() for a, b in itertools.pairwise(rgb))
    assert second <= 0.3 * first
    assert second <= 1e-5


def test_cells_that_no_light_reaches_show_no_fringes() -> None:
    """Without that a million absorbing cells would be asked for a million fringes."""
    rgb = [
        evaluate("yeh-spectral", Mirror.of(0.8, 1.4 + 0.02j, 1.8, 120.0, 150.0, cells, 1.0)).rgb
        for cells in (1000, 10**6)
    ]
    assert np.abs(rgb[0] - rgb[1]).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_a_spectrum_is_the_reflectance_row_by_row() -> None:
    mirror = Mirror.of([[0.5], [0.9]], 1.0, [1.4, 1.8, 2.0], 90.0, 80.0, 10)
    wavelength_nm = np.array([400.0, 500.0])
    spectrum = mirror_spectrum(mirror, wavelength_nm)
    assert spectrum.shape == (2, 3, 2)
    one = bragg_reflectance(1.0, 1.0, 1.8, 90.0, 80.0, 10, 500.0, 0.9)
    assert spectrum[1, 1, 1] == pytest.approx(float(one), abs=1e-14)


def test_more_fringes_than_can_be_summed_are_refused_in_a_sentence() -> None:
    with pytest.raises(UsageError, match="too many fringes"):
        evaluate("yeh-spectral", Mirror.of(0.8, 1.0, 1.5, 1e6, 1e6, 10**6))
