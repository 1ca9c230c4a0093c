"""Laws that films keep at one wavelength, asked of the optics functions that methods are made of.

A method's colour is an integral over wavelengths and cannot keep them. Methods that take one wavelength a
channel can, and are asked themselves.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from laws_law import Float64, Law, distance
from numpy.typing import ArrayLike

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.airy import film_power
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.film import film_reflectance
from gltf_iri.optics.granier_heidrich import WAVELENGTHS_NM
from gltf_iri.optics.stack import stack

__all__ = ["SPECTRAL_LAWS", "SUBJECTS"]

# slab(n1, n2, n3, d_nm, cos θ₁) → R, unpolarised, at WAVELENGTH_NM
Slab = Callable[[ArrayLike, ArrayLike, ArrayLike, ArrayLike, ArrayLike], Float64]

WAVELENGTH_NM = WAVELENGTHS_NM[1]
SINES = np.linspace(0.0, 0.999, 23)
FILM_IOR = np.array([1.1, 1.5, 2.4])[:, None]
EXIT_IOR = 1.33
D_NM = np.array([0.0, 35.0, 310.0])[:, None, None]


def _film(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Float64:
    return film_reflectance(n1, n2, n3, d_nm, WAVELENGTH_NM, cosine)


def _airy(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Float64:
    powers = film_power(n1, n2, n3, d_nm, WAVELENGTH_NM, cosine)
    return 0.5 * (powers.R_s + powers.R_p)


def _stack(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Float64:
    powers = stack([n1, n2, n3], [d_nm], WAVELENGTH_NM, cosine)
    return 0.5 * (powers.R_s + powers.R_p)


def _mirror(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Float64:
    """One cell, the first film of which has no thickness: the film n2 between host and n1."""
    return bragg_reflectance(n1, n3, n2, 0.0, d_nm, 1, WAVELENGTH_NM, cosine)


def _naive(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Float64:
    wavelengths = dict.fromkeys(("red_nm", "green_nm", "blue_nm"), WAVELENGTH_NM)
    return evaluate("naive-rgb", _film_of(n1, n2, n3, d_nm, cosine), parameters=wavelengths).rgb[..., 1]


def _granier_heidrich(
    n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike
) -> Float64:
    return evaluate("granier-heidrich", _film_of(n1, n2, n3, d_nm, cosine)).rgb[..., 1]


def _film_of(n1: ArrayLike, n2: ArrayLike, n3: ArrayLike, d_nm: ArrayLike, cosine: ArrayLike) -> Film:
    return Film.of(cosine, d_nm, n2, base_from_ior(n3), n1)


SUBJECTS: dict[str, Slab] = {
    "optics/film": _film,
    "optics/airy": _airy,
    "optics/stack": _stack,
    "optics/bragg": _mirror,
    "naive-rgb": _naive,
    "granier-heidrich": _granier_heidrich,
}


def _cosine(index: ArrayLike, host: float = 1.0) -> Float64:
    return np.sqrt(1.0 - (host * SINES / np.asarray(index)) ** 2)


def full_order(subject: str) -> float:
    slab = SUBJECTS[subject]
    order_nm = WAVELENGTH_NM / (2.0 * FILM_IOR * _cosine(FILM_IOR))
    thin = slab(1.0, FILM_IOR, EXIT_IOR, D_NM, _cosine(1.0))
    return distance(thin, slab(1.0, FILM_IOR, EXIT_IOR, D_NM + order_nm, _cosine(1.0)))


def absentee(subject: str) -> float:
    slab = SUBJECTS[subject]
    half_wave_nm = WAVELENGTH_NM / (2.0 * FILM_IOR * _cosine(FILM_IOR))
    bare = film_reflectance(1.0, 1.2, EXIT_IOR, 0.0, WAVELENGTH_NM, _cosine(1.0))
    return distance(slab(1.0, FILM_IOR, EXIT_IOR, half_wave_nm, _cosine(1.0)), bare)


def invisible(subject: str) -> float:
    """A quarter wave of n₂ = √(n₁n₃) cancels all reflection (Born & Wolf, §1.6.4)."""
    return distance(SUBJECTS[subject](1.0, 1.5, 2.25, WAVELENGTH_NM / 6.0, 1.0), 0.0)


def backwards(subject: str) -> float:
    slab = SUBJECTS[subject]
    down = slab(1.0, FILM_IOR, EXIT_IOR, D_NM, _cosine(1.0))
    return distance(down, slab(EXIT_IOR, FILM_IOR, 1.0, D_NM, _cosine(EXIT_IOR)))


def passive(subject: str) -> float:
    """R within 0 and 1, total reflection and frustrated films among the rest."""
    slab = SUBJECTS[subject]
    reflected = [slab(n1, FILM_IOR, n3, D_NM, _cosine(1.0)) for n1 in (1.0, 1.7) for n3 in (1.0, 1.33, 3.0)]
    return max(float(np.maximum(-each, each - 1.0).max()) for each in reflected)


SPECTRAL_LAWS = {
    "full order": Law("A film thicker by λ/(2n₂ cos θ₂) reflects the same.", full_order, 1e-12),
    "absentee": Law("A film of half a wave is not there.", absentee, 1e-12),
    "quarter wave": Law(
        "A quarter wave of the root of the base's index cancels all reflection.", invisible, 1e-14
    ),
    "backwards": Law("Light that comes from below along its path is reflected as much.", backwards, 1e-12),
    "0 ≤ R ≤ 1": Law("R is within 0 and 1.", passive, 0.0),
}
