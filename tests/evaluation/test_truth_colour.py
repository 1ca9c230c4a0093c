"""Colours of the truth against a plain 50-digit integration that shares no code with the package."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

from gltf_iri.colour.tables import import_colour_science
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.tolerances import SPECTRAL_COLOUR_MAX_ABS

Exact = Callable[..., tuple[Any, Any]]

# Linear Rec.709 from XYZ, seven decimals: the extension's own matrix.
MATRIX = (
    (3.2404542, -1.5371385, -0.4985314),
    (-0.9692660, 1.8760108, 0.0415560),
    (0.0556434, -0.2040259, 1.0572252),
)
BOOLE = (7, 32, 12, 32, 7)  # Boole's rule on each step of the observer's table


def integrated(reflectance: Callable[[Any], Any], white: str) -> list[float]:
    """Return the colour by Boole's rule over every nanometre, in arbitrary precision."""
    colour = import_colour_science()
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].values
    d65 = dict(zip(range(300, 781, 5), colour.SDS_ILLUMINANTS["D65"].values, strict=True))

    def power(wavelength: Any) -> Any:
        if white == "E":
            return mpf(1)
        if wavelength >= 780:
            return mpf(d65[780])
        low = int(wavelength) // 5 * 5
        return mpf(d65[low]) + (mpf(d65[low + 5]) - mpf(d65[low])) * (wavelength - low) / 5

    total = [mpf(0)] * 3
    whole = [mpf(0)] * 3
    for cell in range(470):
        for quarter, weight in enumerate(BOOLE):
            wavelength = mpf(360 + cell) + mpf(quarter) / 4
            share = mpf(quarter) / 4
            xyz = [
                mpf(a) + (mpf(b) - mpf(a)) * share for a, b in zip(*observer[cell : cell + 2], strict=True)
            ]
            lit = weight * power(wavelength)
            seen = lit * reflectance(wavelength)
            for c, row in enumerate(MATRIX):
                density = sum(mpf(m) * v for m, v in zip(row, xyz, strict=True))
                total[c] += density * seen
                whole[c] += density * lit
    return [float(t / w) for t, w in zip(total, whole, strict=True)]


CASES = {
    "ordinary": (1.0, 1.3, 1.5, 400.0, 0.8, "D65"),
    "flat white": (1.0, 1.3, 1.5, 400.0, 0.8, "E"),
    "strong, steep": (1.0, 2.2, 1.2, 800.0, 0.05, "D65"),
    "gold-like": (1.0, 1.5, 0.3 + 2.9j, 300.0, 0.6, "D65"),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_colour_agrees_with_plain_integration(
    case: tuple[float, float, complex, float, float, str], film_reflectance: Exact
) -> None:
    n1, n2, n3, d_nm, cosine, white = case

    def mean(wavelength: Any) -> Any:
        s, p = film_reflectance(n1, n2, n3, d_nm, wavelength, cosine)
        return (s + p) / 2

    with mp.workdps(30):
        expected = integrated(mean, white)
    rgb = evaluate("spectral", Film.of(cosine, d_nm, n2, base_from_ior(n3), n1), white=white).rgb
    assert np.abs(rgb - expected).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_each_channel_of_a_coloured_base_uses_its_own_index() -> None:
    f0 = np.array([0.9, 0.6, 0.3])
    angles = np.linspace(0.0, 1.0, 5)
    together = evaluate("spectral", Film.of(angles, 350.0, 1.4, base_from_f0(f0))).rgb
    for channel, value in enumerate(f0):
        alone = evaluate("spectral", Film.of(angles, 350.0, 1.4, base_from_f0(np.full(3, value)))).rgb
        assert np.abs(together[:, channel] - alone[:, channel]).max() <= 1e-12


def test_constant_dispersion_is_no_dispersion() -> None:
    from gltf_iri.evaluation.film import base_from_dispersion

    def gold(wavelength_nm: NDArray[np.float64]) -> NDArray[np.complex128]:
        return np.full(wavelength_nm.shape, 0.3 + 2.9j)

    def glass(wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.full(wavelength_nm.shape, 1.4)

    plain = Film.of(0.7, 300.0, 1.4, base_from_ior(0.3 + 2.9j))
    dispersive = Film.of(0.7, 300.0, glass, base_from_dispersion(gold))
    for method in ("khr", "khr-guarded", "spectral"):
        difference = evaluate(method, plain).rgb - evaluate(method, dispersive).rgb
        assert np.abs(difference).max() <= 1e-12


def test_methods_with_one_index_take_that_of_the_helium_line() -> None:
    def cauchy(wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        return 1.4 + 5e3 / wavelength_nm**2

    base = base_from_ior(1.5)
    dispersive, plain = (
        evaluate("khr", Film.of(0.8, 300.0, index, base)).rgb for index in (cauchy, 1.4 + 5e3 / 587.56**2)
    )
    assert np.abs(dispersive - plain).max() <= 1e-14


def test_dispersion_moves_the_colour_as_its_wavelength_says() -> None:
    """A bare base whose index rises towards the blue reflects more blue, by the Fresnel law of each λ."""
    from gltf_iri.evaluation.film import base_from_dispersion

    def flint(wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        return 1.6 + 2e4 / wavelength_nm**2

    expected = integrated(lambda w: ((0.6 + 2e4 / w**2) / (2.6 + 2e4 / w**2)) ** 2, "D65")
    rgb = evaluate("spectral", Film.of(1.0, 0.0, 1.3, base_from_dispersion(flint))).rgb
    assert np.abs(rgb - expected).max() <= SPECTRAL_COLOUR_MAX_ABS
    assert rgb[2] > rgb[0]


def test_a_table_of_indices_is_integrated_through_its_kinks() -> None:
    """No polynomial follows a kink: both the base's F0 and the film's truth take the slow road."""
    from gltf_iri.evaluation.film import base_from_dispersion

    table_nm = np.array([360.0, 450.0, 500.0, 550.0, 650.0, 830.0])
    n, k = np.array([1.6, 1.4, 1.1, 0.9, 0.8, 0.7]), np.array([1.9, 1.9, 1.8, 2.0, 2.4, 3.0])

    def metal(wavelength_nm: NDArray[np.float64]) -> NDArray[np.complex128]:
        assert wavelength_nm.ndim == 1  # what a dispersion is promised to be asked
        return np.interp(wavelength_nm, table_nm, n) + 1j * np.interp(wavelength_nm, table_nm, k)

    def bare(wavelength: Any) -> Any:
        index = complex(metal(np.array([float(wavelength)]))[0])
        return abs((index - 1) / (index + 1)) ** 2

    base = base_from_dispersion(metal)
    expected = integrated(bare, "D65")
    assert np.abs(base.f0 - expected).max() <= SPECTRAL_COLOUR_MAX_ABS
    rgb = evaluate("spectral", Film.of([1.0, 1.0], 0.0, 1.5, base)).rgb
    assert np.abs(rgb - expected).max() <= SPECTRAL_COLOUR_MAX_ABS


def test_a_dispersion_of_the_wrong_shape_or_an_absorbing_film_is_refused() -> None:
    with pytest.raises(UsageError, match="shape"):
        Film.of(1.0, 300.0, lambda wavelength_nm: np.ones((1, len(wavelength_nm))), base_from_ior(1.5))
    with pytest.raises(UsageError, match="absorbs"):
        Film.of(1.0, 300.0, lambda wavelength_nm: wavelength_nm * 0.0 + (1.5 + 0.1j), base_from_ior(1.5))


def test_a_base_without_index_reflects_everything() -> None:
    """n → 0 is total reflection at every angle, the formula's 0/0 notwithstanding."""
    nearly = evaluate("spectral", Film.of([1.0, 0.5], 300.0, 1.5, base_from_ior(1e-12))).rgb
    rgb = evaluate("spectral", Film.of([1.0, 0.5, 0.0], 300.0, 1.5, base_from_ior(0.0))).rgb
    assert np.abs(nearly - 1.0).max() <= 1e-9
    assert np.abs(rgb - 1.0).max() <= 1e-12
