"""The colours of a checked film, as physics has them and as the text has them to the letter."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film as OpticalFilm
from gltf_iri.evaluation.film import base_from_f0
from gltf_iri.evaluation.fourier import evaluate_fourier
from gltf_iri.evaluation.incoherent import evaluate_incoherent
from gltf_iri.evaluation.khr import F0_OFFSET, evaluate_khr
from gltf_iri.evaluation.khr_guarded import MAX_F0

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from gltf_iri.validation.iridescence.film import Base, Film

    Float64 = NDArray[np.float64]

__all__ = [
    "COSINES",
    "MIDDLE",
    "MIDDLE_DECODED",
    "bases_of",
    "film_colours",
    "largest_difference",
    "thicknesses",
]

# From straight on to 78°: towards grazing light all surfaces are white.
COSINES = np.linspace(1.0, 0.2, 9)

# A texel's middle value, and what is left of it where data is decoded as a colour.
MIDDLE = 0.5
MIDDLE_DECODED = float(srgb_decode(MIDDLE))

# A base colour that its texture multiplies is half of its factor, for want of better knowledge.
_TEXTURED = 0.5

# How finely a range of thicknesses is looked at: over 400 nm of range, steps of 12 nm.
_SAMPLES = 33

_METHODS: dict[str, Any] = {
    "truth": evaluate_fourier,  # within ΔE 0.01 of the converged integral
    "letter": lambda film, white: evaluate_khr(film, white, backend="numpy"),
    "mean": evaluate_incoherent,
    "cut": lambda film, white: evaluate_khr(_cut(film), white, backend="numpy"),
}


def film_colours(
    base: Base,
    thickness_nm: ArrayLike,
    film_ior: float,
    *,
    cosines: ArrayLike = COSINES,
    outside_ior: float = 1.0,
    method: str = "truth",
) -> Float64:
    """Return (cosines, thicknesses, 3) linear Rec.709 under D65.

    method : "truth", "letter" (the extension's text), "cut" (the same, with F0 cut to 0.9999, as by most
        renderers), or "mean" over all phases.
    Raises UsageError where a value is beyond what the optics take.
    """
    share = 1.0 if base.is_known else _TEXTURED
    f0 = np.clip(share * np.asarray(base.f0, dtype=np.float64), 0.0, 1.0)
    angles = np.atleast_1d(np.asarray(cosines, dtype=np.float64))[:, None]
    nm = np.atleast_1d(np.asarray(thickness_nm, dtype=np.float64))
    film = OpticalFilm.of(angles, nm, film_ior, base_from_f0(f0), outside_ior)
    with np.errstate(all="ignore"):  # the letter of the text divides by zero
        return np.broadcast_to(_METHODS[method](film, "D65").rgb, (*film.shape, 3))


def _cut(film: OpticalFilm) -> OpticalFilm:
    """Return the film on a base whose F0 is 0.9999 at most once the text has added to it."""
    return replace(film, base=base_from_f0(np.minimum(film.base.f0, MAX_F0 - F0_OFFSET)))


def thicknesses(film: Film) -> Float64:
    """Return thicknesses all over the film's range; one where it has one."""
    if film.least_nm == film.greatest_nm:
        return np.array([film.greatest_nm])
    return np.linspace(film.least_nm, film.greatest_nm, _SAMPLES)


def bases_of(film: Film) -> tuple[Base, ...]:
    """Return what the film lies on; UsageError where the file does not say."""
    if not film.bases:
        raise UsageError("The file does not say what the film lies on.")
    return film.bases


def largest_difference(one: Float64, other: Float64) -> float:
    """Return the largest CIEDE2000; NaN where a colour is not a number."""
    return float(np.max(delta_e_2000(one, other)))
