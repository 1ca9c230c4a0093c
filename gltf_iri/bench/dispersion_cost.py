"""What it costs to give every channel one index where the media disperse: `fourier` against the truth.

With constant indices `fourier` errs by a few thousandths of a ΔE: the rest is dispersion.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from gltf_iri.bench.media import FILM_MEDIA, METALS, N_BK7
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Dispersion, Film, base_from_dispersion
from gltf_iri.evaluation.fourier import evaluate_fourier
from gltf_iri.evaluation.spectral import evaluate_spectral

__all__ = ["DispersionRow", "measure_dispersion"]

_THICKNESSES_NM: Final = np.array([0.0, 60.0, 150.0, 300.0, 500.0, 800.0, 1500.0, 3000.0])
_COSINES: Final = np.array([1.0, 0.8, 0.5, 0.2])


@dataclass(frozen=True, slots=True)
class DispersionRow:
    """CIEDE2000 over four angles of one film on one base."""

    film: str
    base: str
    thickness_nm: float
    delta_e_mean: float
    delta_e_max: float


def measure_dispersion(white: White = "D65") -> Iterator[DispersionRow]:
    """Yield a row for each film, base and thickness of the published media."""
    bases: dict[str, Dispersion] = {**METALS, "N-BK7": N_BK7}
    for film_name, film_ior_at in FILM_MEDIA.items():
        for base_name, index_at in bases.items():
            base = base_from_dispersion(index_at)
            film = Film.of(_COSINES, _THICKNESSES_NM[:, None], film_ior_at, base)
            rgb = evaluate_fourier(film, white).rgb
            delta_e = delta_e_2000(rgb, evaluate_spectral(film, white).rgb)
            for thickness_nm, errors in zip(_THICKNESSES_NM, delta_e, strict=True):
                yield DispersionRow(
                    film_name, base_name, float(thickness_nm), float(errors.mean()), float(errors.max())
                )
