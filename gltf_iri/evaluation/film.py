"""The input and output that every film method shares."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.errors import UsageError
from gltf_iri.optics.gulbrandsen import index_from_edge_tint
from gltf_iri.optics.ior import fresnel0_to_ior
from gltf_iri.planning.method import ParameterValue

__all__ = [
    "INDEX_MAX",
    "THICKNESS_MAX_NM",
    "Base",
    "Dispersion",
    "Evaluation",
    "Film",
    "base_from_dispersion",
    "base_from_edge_tint",
    "base_from_f0",
    "base_from_ior",
    "index_by_wavelength",
]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

# A medium's index by wavelength: (k,) nm → (k,), asked between 360 and 830 nm. `index_by_wavelength` asks it.
Dispersion = Callable[[Float64], NDArray[np.complex128] | Float64]

# Stands for a dispersive film in methods that know one index only: helium's d line.
_REFERENCE_NM = 587.56

# Beyond any matter and any film, yet so small that no square, product or ratio of two overflows.
INDEX_MAX = 1e6
THICKNESS_MAX_NM = 1e12


@dataclass(frozen=True, slots=True)
class Base:
    """The medium under the film, in the two forms that methods want.

    f0 : (..., 3) reflectance at normal incidence under air, channel by channel.
    index : (..., 3) complex refractive index n + ik, k ≥ 0, channel by channel; equal channels are common.
    index_at : the index by wavelength, which the truth then uses instead of `index`.
    """

    f0: Float64
    index: Complex128
    index_at: Dispersion | None = None


def base_from_f0(f0: ArrayLike) -> Base:
    """Return the base whose real index is (1 + √F0)/(1 − √F0); `f0` is (..., 3) in [0, 1].

    F0 = 1 gives an infinite index, the perfect mirror.
    """
    colour = np.asarray(f0, dtype=np.float64)
    if colour.shape[-1:] != (3,):
        raise UsageError("The base reflectance wants three channels in its last axis.")
    if not np.all((colour >= 0.0) & (colour <= 1.0)):
        raise UsageError("The base reflectance F0 must lie in [0, 1].")
    return Base(colour, fresnel0_to_ior(colour).astype(np.complex128))


def base_from_ior(ior: ArrayLike) -> Base:
    """Return the base of index n + ik (any shape), whose F0 under air is |(n − 1)/(n + 1)|²."""
    index = np.repeat(_checked_index(ior)[..., None], 3, axis=-1)
    return Base(_reflectance_under_air(index), index)


def base_from_edge_tint(f0: ArrayLike, edge_tint: ArrayLike) -> Base:
    """Return the metal that reflects `f0` straight on and turns to `edge_tint` (Gulbrandsen 2014).

    Both are (..., 3) in [0, 1]; an edge tint of 0 is the real index of `base_from_f0`.
    """
    plain = base_from_f0(f0)
    tint = np.asarray(edge_tint, dtype=np.float64)
    if tint.shape[-1:] != (3,) or not np.all((tint >= 0.0) & (tint <= 1.0)):
        raise UsageError("The edge tint wants three channels, each in [0, 1].")
    colour, tint = np.broadcast_arrays(plain.f0, tint)
    return Base(colour, index_from_edge_tint(colour, tint))


def base_from_dispersion(index_at: Dispersion) -> Base:
    """Return the base of index n + ik by wavelength; its F0 is its colour at normal incidence under D65.

    F0 is cut to [0, 1]: a spectrum outside the Rec.709 gamut has no glTF base colour.
    """

    def bare(rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
        index = _checked_index(index_by_wavelength(index_at, wavelength_nm))
        return np.broadcast_to(_reflectance_under_air(index), (len(rows), wavelength_nm.shape[-1]))

    f0 = np.clip(integrate_colour(bare, 1, white="D65")[0], 0.0, 1.0)
    index = _checked_index(index_by_wavelength(index_at, np.array([_REFERENCE_NM])))
    return Base(f0, index * np.ones(3), index_at)


def index_by_wavelength(dispersion: Dispersion, wavelength_nm: Float64) -> Complex128:
    """Return the index at `wavelength_nm` of any shape: a dispersion is asked for a row of wavelengths only.

    Raises UsageError where it answers with another number of indices than it was asked for.
    """
    asked = np.asarray(wavelength_nm, dtype=np.float64)
    index = np.asarray(dispersion(asked.ravel()), dtype=np.complex128)
    if index.shape != (asked.size,):
        raise UsageError(f"An index by wavelength has the shape {index.shape}, not ({asked.size},) as asked.")
    return index.reshape(asked.shape)


def _reflectance_under_air(index: Complex128) -> Float64:
    """Return |(n − 1)/(n + 1)|², straight on."""
    return np.asarray(np.abs((index - 1.0) / (index + 1.0)) ** 2)


def _checked_index(index: ArrayLike) -> Complex128:
    checked = np.asarray(index, dtype=np.complex128)
    if not np.all((checked.real >= 0.0) & (checked.imag >= 0.0) & (np.abs(checked) <= INDEX_MAX)):
        raise UsageError(
            f"The base index n + ik wants n ≥ 0 and k ≥ 0, at most {INDEX_MAX:g} (waves are exp(−iωt))."
        )
    return checked


@dataclass(frozen=True, slots=True)
class Film:
    """A thin film seen from outside. Arrays broadcast; colours have their channels in a last axis of 3.

    cos_theta_1 : cosine of the outside angle, in [0, 1].
    thickness_nm : film thickness, ≥ 0.
    film_ior, outside_ior : real refractive indices.
    film_ior_at : the film's real index by wavelength, which the truth then uses instead of `film_ior`.
    """

    cos_theta_1: Float64
    thickness_nm: Float64
    film_ior: Float64
    base: Base
    outside_ior: Float64
    film_ior_at: Dispersion | None = None

    @classmethod
    def of(
        cls,
        cos_theta_1: ArrayLike,
        thickness_nm: ArrayLike,
        film_ior: ArrayLike | Dispersion,
        base: Base,
        outside_ior: ArrayLike = 1.0,
    ) -> Film:
        """Check ranges and shapes and return the film; UsageError for values out of range and NaN.

        A callable `film_ior` is a dispersive film, real at every wavelength; methods with one index take the
        one at 587.56 nm.
        """
        film_ior_at = film_ior if callable(film_ior) else None
        one_ior = film_ior
        if callable(film_ior):
            at_reference = index_by_wavelength(film_ior, np.array([_REFERENCE_NM]))
            if at_reference.imag.any():
                raise UsageError("The film absorbs nothing: its index by wavelength must be real.")
            one_ior = at_reference.real[0]
        arrays = [np.asarray(a, dtype=np.float64) for a in (cos_theta_1, thickness_nm, one_ior, outside_ior)]
        cosine, thickness, film, outside = arrays
        if not np.all((cosine >= 0.0) & (cosine <= 1.0)):
            raise UsageError("The cosine of the outside angle must lie in [0, 1].")
        if not np.all((thickness >= 0.0) & (thickness <= THICKNESS_MAX_NM)):
            raise UsageError(f"The film thickness must lie in [0, {THICKNESS_MAX_NM:g}] nanometres.")
        if not all(np.all((index >= 1.0 / INDEX_MAX) & (index <= INDEX_MAX)) for index in (film, outside)):
            raise UsageError(
                f"The indices of film and outside must lie in [{1.0 / INDEX_MAX:g}, {INDEX_MAX:g}]."
            )
        checked = cls(cosine, thickness, film, base, outside, film_ior_at)
        try:
            _ = checked.shape
        except ValueError:
            shapes = ", ".join(str(a.shape) for a in (*arrays, base.f0[..., 0]))
            raise UsageError(
                f"Cosine, thickness, film index, outside index and base do not broadcast: {shapes}."
            ) from None
        return checked

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the result without its channel axis."""
        return np.broadcast_shapes(
            self.cos_theta_1.shape,
            self.thickness_nm.shape,
            self.film_ior.shape,
            self.outside_ior.shape,
            self.base.f0.shape[:-1],
        )


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Reflectance colours and what a reader must know about them.

    rgb : (..., 3) linear Rec.709, not gamut-clamped.
    backend : "numpy", "numba", or the OpenGL renderer.
    undefined : for each case that occurred and that the method leaves undefined, the mask (...) of its rows.
    parameters : what the method's parameters were.
    delta_e : what the p95 of CIEDE2000 lies below, where a budget chose the method; else None.
    ns_per_colour : what the map of costs says that a colour costs by it, where a budget chose; else None.
    """

    rgb: Float64
    method: str
    white: str
    backend: str = "numpy"
    undefined: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    parameters: Mapping[str, ParameterValue] = field(default_factory=dict)
    delta_e: float | None = None
    ns_per_colour: float | None = None
