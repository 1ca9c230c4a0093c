"""Any light and RGB space will do, in every method that integrates over the spectrum."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import gltf_iri
from gltf_iri.backends import has_numba
from gltf_iri.colour.observer import colour_matching, illuminant
from gltf_iri.colour.spaces import Light
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum
from gltf_iri.planning.method import METHODS, method_names

Float64 = NDArray[np.float64]

# XYZ to linear Display P3 (its primaries and D65, by SMPTE EG 432-1), to four decimals.
DISPLAY_P3 = [[2.4935, -0.9314, -0.4027], [-0.8295, 1.7627, 0.0236], [0.0358, -0.0762, 0.9569]]


def lamp_power(wavelength_nm: Float64) -> Float64:
    """A black body of 2856 K, to a factor."""
    return wavelength_nm**-5.0 / np.expm1(1.4388e7 / (2856.0 * wavelength_nm))


LAMP = Light("lamp in P3", lamp_power, DISPLAY_P3)
DAYLIGHT = Light("daylight", lambda wavelength_nm: illuminant(wavelength_nm, "D65"))

FILM = Film.of(
    np.linspace(0.05, 1.0, 9)[:, None], np.array([0.0, 5.0, 300.0, 900.0, 3000.0]), 1.4, base_from_ior(2.0)
)
METAL = Film.of(0.7, np.array([100.0, 600.0]), 1.7, base_from_ior(0.3 + 3j))
MIRROR = Mirror.of(np.linspace(0.2, 1.0, 5), 1.0, 1.5, 200.0, 150.0, 10)


@pytest.mark.parametrize("method", [*method_names("film"), *method_names("mirror")])
def test_a_shipped_white_written_out_is_the_same(method: str) -> None:
    subject = METAL if METHODS[method].domain == "film" else MIRROR
    ours = evaluate(method, subject, white=DAYLIGHT)
    assert ours.white == DAYLIGHT.name
    assert np.abs(ours.rgb - evaluate(method, subject, white="D65").rgb).max() <= 1e-12


def test_the_truth_is_the_plain_sum_over_a_dense_grid() -> None:
    wavelength_nm = np.linspace(360.0, 830.0, 47_001)
    weights = (colour_matching(wavelength_nm) * lamp_power(wavelength_nm)[:, None]) @ np.transpose(DISPLAY_P3)
    weights[[0, -1]] *= 0.5
    expected = film_spectrum(METAL, wavelength_nm)[..., 0, :] @ (weights / weights.sum(axis=0))
    assert np.abs(evaluate("spectral", METAL, white=LAMP).rgb - expected).max() <= 1e-8


@pytest.mark.parametrize("backend", ["numpy", *(["numba"] if has_numba() else [])])
def test_fourier_keeps_its_tolerance_under_any_light(backend: str) -> None:
    for film in (FILM, METAL):
        series = evaluate("fourier", film, white=LAMP, backend=backend).rgb
        assert np.abs(series - evaluate("spectral", film, white=LAMP).rgb).max() <= 1e-4


def test_mirrors_keep_their_distance_from_the_truth() -> None:
    truth = evaluate("yeh-spectral", MIRROR, white=LAMP).rgb
    assert np.abs(evaluate("bloch", MIRROR, white=LAMP).rgb - truth).max() <= 3e-3


def test_all_that_is_reflected_is_white() -> None:
    rgb = gltf_iri.evaluate("fourier", cos_theta_1=0.0, thickness_nm=300.0, white=LAMP).rgb
    np.testing.assert_allclose(rgb, 1.0, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("method", ["spectral", "fourier"])
def test_a_channel_that_sees_nothing_is_refused(method: str) -> None:
    blind = Light("no blue", np.ones_like, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    with pytest.raises(UsageError, match="sees nothing"):
        evaluate(method, METAL, white=blind)
