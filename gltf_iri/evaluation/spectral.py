"""Method `spectral`, the truth: exact reflectance of both polarisations, integrated until it has converged.

A base given by its F0 has one real index per channel, and each channel of the answer uses its own; equal
channels are computed once. Indices may depend on the wavelength (`Base.index_at`, `Film.film_ior_at`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Complex128, Evaluation, Film, Float64, index_by_wavelength
from gltf_iri.optics.film import film_reflectance

__all__ = ["FilmRows", "evaluate_spectral", "film_spectrum"]


def evaluate_spectral(film: Film, white: White) -> Evaluation:
    """Evaluate the truth under `white`; raises UsageError where a spectrum is too fine to be integrated."""
    flat = FilmRows(film)
    rgb = integrate_colour(flat.reflectance, flat.count, white=white, opd_nm=flat.opd_nm())
    return Evaluation(rgb.reshape(*film.shape, 3), "spectral", str(white))


def film_spectrum(film: Film, wavelength_nm: Float64) -> Float64:
    """Return the reflectance (*film.shape, 3, k) at `wavelength_nm` (k,), channel by channel of the base."""
    flat = FilmRows(film)
    values = flat.reflectance(np.arange(flat.count), np.asarray(wavelength_nm, dtype=np.float64))
    if values.ndim == 2:
        values = np.repeat(values[:, :, None], 3, axis=2)
    return np.moveaxis(values, 2, 1).reshape(*film.shape, 3, -1)


class FilmRows:
    """A film whose broadcast shape is laid out as rows."""

    def __init__(self, film: Film) -> None:
        self.count = int(np.prod(film.shape, dtype=np.intp))
        self._film = film
        self._cosine, self._thickness_nm, self._film_ior, self._outside_ior = (
            np.broadcast_to(a, film.shape).reshape(-1, 1)
            for a in (film.cos_theta_1, film.thickness_nm, film.film_ior, film.outside_ior)
        )
        index: Complex128 = np.broadcast_to(film.base.index, (*film.shape, 3)).reshape(-1, 3)
        self._base_index = index
        # A grey base's channels share one spectrum.
        self._is_grey = film.base.index_at is not None or bool(np.all(index == index[:, :1]))

    def opd_nm(self) -> Float64:
        """Return (count,): an upper bound of the fringes' path difference."""
        return np.asarray((2.0 * self._film_ior * self._thickness_nm)[:, 0])

    def reflectance(self, rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
        """Return (r, k), or (r, k, 3) where the base's channels differ, at `wavelength_nm` (k,) or (r, k)."""
        film = self._film
        film_ior = self._film_ior[rows]
        if film.film_ior_at is not None:
            film_ior = index_by_wavelength(film.film_ior_at, wavelength_nm).real
        if film.base.index_at is not None:
            bases = [index_by_wavelength(film.base.index_at, wavelength_nm)]
        else:
            bases = [self._base_index[rows, c : c + 1] for c in range(1 if self._is_grey else 3)]
        grids = [
            film_reflectance(
                self._outside_ior[rows],
                film_ior,
                n3,
                self._thickness_nm[rows],
                wavelength_nm,
                self._cosine[rows],
            )
            for n3 in bases
        ]
        return grids[0] if len(grids) == 1 else np.stack(grids, axis=-1)
