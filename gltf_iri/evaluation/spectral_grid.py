"""Method `spectral-grid`: the truth's reflectance at a fixed number of evenly spaced wavelengths."""

from __future__ import annotations

from typing import Final

from gltf_iri.colour.spaces import White
from gltf_iri.colour.wavelength_grid import integrate_on_grid
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.spectral import FilmRows

__all__ = ["GRID_SAMPLES", "evaluate_spectral_grid"]

GRID_SAMPLES: Final = 31  # a step of 16 nm; measured spectra commonly have 10 or 20


def evaluate_spectral_grid(film: Film, white: White, *, samples: int = GRID_SAMPLES) -> Evaluation:
    """Evaluate `spectral-grid` at `samples` wavelengths from 360 to 830 nm (`colour/wavelength_grid.py`).

    Both polarisations, every inter-reflection and dispersion, as in the truth; fringes so fine that
    neighbouring wavelengths miss them alias. Raises UsageError where so few see nothing of the light.
    """
    rows = FilmRows(film)
    rgb = integrate_on_grid(rows.reflectance, rows.count, samples, white=white)
    return Evaluation(rgb.reshape(*film.shape, 3), "spectral-grid", str(white))
