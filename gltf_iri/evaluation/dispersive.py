"""A film's rows, channel by channel: which index stands for a channel where indices depend on the wavelength.

Belcour & Barla 2017 (section 4) let the indices of a spectral band be those at the peak of its sensitivity.
Here the channel's centroid in wavenumber stands for it, 1/λ_j = ∫ ν S_j dν: whatever is linear in ν over the
channel is then right to first order, negative lobes included.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Film, Float64, index_by_wavelength

__all__ = ["FilmBand", "film_bands", "representative_wavelengths_nm"]

Number = TypeVar("Number", bound=np.generic)

_DEGREE = 64  # the rule integrates ν exactly from degree 1 on


@dataclass(frozen=True, slots=True)
class FilmBand:
    """Films (r,) as the channels `channels` see them: one film index and one base index each.

    base_index is float64 where no base absorbs and complex128 otherwise.
    """

    channels: slice
    outside_ior: Float64
    film_ior: Float64
    base_index: NDArray[Any]
    thickness_nm: Float64
    cos_theta_1: Float64

    def rows(self, rows: slice | NDArray[np.intp]) -> FilmBand:
        """Return these `rows` of the band."""
        return replace(
            self,
            outside_ior=self.outside_ior[rows],
            film_ior=self.film_ior[rows],
            base_index=self.base_index[rows],
            thickness_nm=self.thickness_nm[rows],
            cos_theta_1=self.cos_theta_1[rows],
        )

    def of_thickness(self, thickness_nm: Float64) -> FilmBand:
        """Return the same films `thickness_nm` (r,) thick."""
        return replace(self, thickness_nm=thickness_nm)


@cache
def representative_wavelengths_nm(white: White) -> tuple[float, float, float]:
    """Return λ_j of R, G and B: what is linear in wavenumber has its channel's mean there."""
    rule = colour_rule(_DEGREE, white)
    red, green, blue = 1.0 / ((1.0 / rule.wavelength_nm) @ rule.weights)
    return float(red), float(green), float(blue)


def film_bands(film: Film, white: White) -> Iterator[FilmBand]:
    """Yield the film as contiguous rows: once for all channels where these share their indices, else each."""
    outside, thickness, cosine = (
        _rows(a, film.shape) for a in (film.outside_ior, film.thickness_nm, film.cos_theta_1)
    )
    nm = np.array(representative_wavelengths_nm(white))
    film_ior = np.repeat(film.film_ior[..., None], 3, axis=-1)
    if film.film_ior_at is not None:
        film_ior = index_by_wavelength(film.film_ior_at, nm).real
    index = film.base.index
    if film.base.index_at is not None:
        index = index_by_wavelength(film.base.index_at, nm)
    base: NDArray[Any] = index if np.any(index.imag) else index.real
    is_grey = bool(np.all(base == base[..., :1]) and np.all(film_ior == film_ior[..., :1]))
    for channel in (0,) if is_grey else (0, 1, 2):
        yield FilmBand(
            slice(0, 3) if is_grey else slice(channel, channel + 1),
            outside,
            _rows(film_ior[..., channel], film.shape),
            _rows(base[..., channel], film.shape),
            thickness,
            cosine,
        )


def _rows(values: NDArray[Number], shape: tuple[int, ...]) -> NDArray[Number]:
    return np.ascontiguousarray(np.broadcast_to(values, shape)).reshape(-1)
