"""Workload `dispersion`: what it costs to give every channel one index where the media disperse.

With constant indices `fourier` errs by a few thousandths of a ΔE: the rest is dispersion.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.colour_rows import WHITE, ColourRow, Contestant, colour_rows
from gltf_iri.bench.media import FILM_MEDIA, METALS, N_BK7
from gltf_iri.evaluation.film import Dispersion, Film, base_from_dispersion
from gltf_iri.evaluation.registry import evaluate

__all__ = ["DISPERSIVE_PAIRS", "measure_dispersion"]

_THICKNESSES_NM: Final = np.array([0.0, 60.0, 150.0, 300.0, 500.0, 800.0, 1500.0, 3000.0])
_COSINES: Final = np.array([1.0, 0.8, 0.5, 0.2])
_METHOD: Final = "fourier"

_BASES: Final[dict[str, Dispersion]] = {**METALS, "N-BK7": N_BK7}

# Film and base, by the names of their media.
DISPERSIVE_PAIRS: Final = tuple((film, base) for film in FILM_MEDIA for base in _BASES)


def measure_dispersion(after_pair: Callable[[], None] = lambda: None) -> list[ColourRow]:
    """Return a row for each film on each base of the published media, over thicknesses and angles."""
    rows: list[ColourRow] = []
    for film_name, base_name in DISPERSIVE_PAIRS:
        base = base_from_dispersion(_BASES[base_name])
        film = Film.of(_COSINES, _THICKNESSES_NM[:, None], FILM_MEDIA[film_name], base)
        truth = evaluate("spectral", film, white=WHITE).rgb.reshape(-1, 3)
        contestant = Contestant(_METHOD, "numpy", partial(_colours, film))
        rows += colour_rows(f"{film_name} on {base_name}", [contestant], truth, 1)
        after_pair()
    return rows


def _colours(film: Film) -> NDArray[np.float64]:
    return evaluate(_METHOD, film, white=WHITE, backend="numpy").rgb.reshape(-1, 3)
