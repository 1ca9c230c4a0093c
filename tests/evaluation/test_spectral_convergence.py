"""Colours stand still where the spectrum is hard: resonances, thick films, kinked tables."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.colour.adaptive import integrate_adaptive
from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum
from gltf_iri.tolerances import COLOUR_CONVERGENCE


def test_both_quadratures_agree() -> None:
    opd_nm = np.array([0.0, 500.0, 3000.0, 20_000.0])

    def fringes(rows: NDArray[np.intp], wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        return 0.5 + 0.4 * np.cos(2.0 * np.pi * opd_nm[rows, None] / wavelength_nm)

    fast = integrate_colour(fringes, 4, white="D65", opd_nm=opd_nm)
    slow = integrate_adaptive(fringes, np.arange(4), white="D65", opd_nm=opd_nm)
    assert np.abs(fast - slow).max() <= COLOUR_CONVERGENCE


def test_all_reflecting_surface_is_white() -> None:
    for white in ("D65", "E"):
        rgb = integrate_colour(lambda rows, w: np.ones((len(rows), w.shape[-1])), 2, white=white)
        assert np.abs(rgb - 1.0).max() <= 1e-14


def test_narrow_resonance_loses_no_energy() -> None:
    """Grazing light over a bright metal: a fine enough midpoint sum sees the same dip."""
    film = Film.of(1e-3, 200.0, 1.5, base_from_f0(np.full(3, 0.999)))
    rgb = evaluate("spectral", film).rgb
    edges = np.linspace(1.0 / 830.0, 1.0 / 360.0, 2_000_001)
    wavelength_nm = 2.0 / (edges[1:] + edges[:-1])
    from gltf_iri.colour.quadrature import colour_density

    spectrum = film_spectrum(film, wavelength_nm)[0]
    density = colour_density(wavelength_nm, "D65") * (np.diff(edges) * wavelength_nm**2)[:, None]
    assert np.abs((spectrum[:, None] * density).sum(axis=0) - rgb).max() <= 1e-8


def test_thick_film_fades_to_the_mean_of_its_fringes() -> None:
    """⟨R⟩ over a whole fringe is R12 + T12²R23/(1 − R12 R23) for light straight on."""
    r12, r23 = (0.5 / 2.5) ** 2, (1.0 / 4.0) ** 2
    mean = r12 + (1.0 - r12) ** 2 * r23 / (1.0 - r12 * r23)
    rgb = evaluate("spectral", Film.of(1.0, 1e6, 1.5, base_from_f0(np.full(3, (1.5 / 3.5) ** 2)))).rgb
    assert np.abs(rgb - mean).max() <= 2e-5


def test_spectrum_that_never_settles_is_refused() -> None:
    def noise(rows: NDArray[np.intp], wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.where(wavelength_nm * 1e13 % 2.0 < 1.0, 1.0, np.nan) * np.ones((len(rows), 1))

    with pytest.raises(UsageError, match="do not settle"):
        integrate_colour(noise, 1, white="D65")
