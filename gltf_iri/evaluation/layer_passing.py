"""One layer's transmissivity at many cosines: sampled as often as its changes ask for.

Where there are more cosines than nodes to know them by, T is piecewise polynomial in θ_i, on panels that are
halved until each is foretold; else T is computed at the cosines themselves.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.evaluation.layer_spectra import LayerSpectra

__all__ = ["LayerPassing"]

Float64 = NDArray[np.float64]

# Of the transmissivity at single wavelengths; colours, which are means over many, err by less.
_TOLERANCE: Final = 1e-9
_JUDGED_DEGREE: Final = 64

_POINTS: Final = 14
_FIRST_PANELS: Final = 4

# Where each half is asked what the whole foretells: between the points, and near the ends.
_PROBES: Final = (-0.985, -0.55, 0.07, 0.45, 0.81, 0.99)

_KEPT_VALUES: Final = 1 << 24  # bounds memory: cosines × wavelengths


class LayerPassing:
    """T of `spectra` at `cosine` (n,); rows of cosines are asked for by their number."""

    def __init__(self, spectra: LayerSpectra, cosine: Float64) -> None:
        self._spectra = spectra
        self._sampled, self._place = np.unique(cosine, return_inverse=True)
        self._theta = np.arccos(cosine)
        self._edges: Float64 | None = None
        self._tables: dict[tuple[int, float], Float64] = {}
        if spectra.alpha > 0.0:
            self._edges = _panel_edges(spectra, most=len(self._sampled) // (2 * _POINTS))
        if self._edges is not None:
            self._sampled = np.cos(_theta_of(self._edges[:-1], self._edges[1:], _points())).reshape(-1)

    def transmissivity(self, rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
        """Return T (r, k) of the cosines numbered `rows` at `wavelength_nm` (k,)."""
        if self._spectra.alpha == 0.0 or len(self._sampled) * len(wavelength_nm) > _KEPT_VALUES:
            return self._spectra.transmissivity(np.cos(self._theta[rows]), wavelength_nm)
        # Rules of ever more wavelengths are asked for, each for one block of rows after another.
        key = len(wavelength_nm), float(wavelength_nm[0])
        if key not in self._tables:
            self._tables[key] = self._spectra.transmissivity(self._sampled, wavelength_nm)
        table = self._tables[key]
        if self._edges is None:
            return np.asarray(table[self._place[rows]])
        theta = self._theta[rows]
        panel = np.clip(np.searchsorted(self._edges, theta, side="right") - 1, 0, len(self._edges) - 2)
        width = np.diff(self._edges)[panel]
        spread = np.zeros((len(rows), len(table)))
        columns = panel[:, None] * _POINTS + np.arange(_POINTS)
        place = 2.0 * (theta - self._edges[panel]) / width - 1.0
        np.put_along_axis(spread, columns, _lagrange(place), axis=1)
        return np.asarray(spread @ table)


def _panel_edges(spectra: LayerSpectra, most: int) -> Float64 | None:
    """Return edges of panels of θ_i on which T is a polynomial; None where there were more than `most`.

    Judged at the wavelengths of one rule.
    """
    wavelength_nm = colour_rule(_JUDGED_DEGREE, "D65").wavelength_nm
    edges = np.linspace(0.0, 0.5 * np.pi, _FIRST_PANELS + 1)
    low, high = edges[:-1], edges[1:]
    done: list[Float64] = []
    while len(low) > 0:
        if sum(map(len, done)) + len(low) > most:
            return None
        foretold = _lagrange(np.array(_PROBES)) @ _sampled(spectra, low, high, _points(), wavelength_nm)
        truth = _sampled(spectra, low, high, np.array(_PROBES), wavelength_nm)
        is_open = np.abs(foretold - truth).max(axis=(1, 2)) > _TOLERANCE
        done.append(low[~is_open])
        low, high = low[is_open], high[is_open]
        middle = 0.5 * (low + high)
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
    return np.append(np.sort(np.concatenate(done)), 0.5 * np.pi)


def _sampled(
    spectra: LayerSpectra, low: Float64, high: Float64, place: Float64, wavelength_nm: Float64
) -> Float64:
    """Return T (panels, places, k) at `place` in [−1, 1] of panels from `low` to `high`."""
    theta = _theta_of(low, high, place)
    return spectra.transmissivity(np.cos(theta).reshape(-1), wavelength_nm).reshape(*theta.shape, -1)


def _theta_of(low: Float64, high: Float64, place: Float64) -> Float64:
    theta = low[:, None] + (high - low)[:, None] * 0.5 * (1.0 + place)
    return np.asarray(np.minimum(theta, 0.5 * np.pi))


def _points() -> Float64:
    """Chebyshev points of the first kind on (−1, 1), rising."""
    return np.asarray(-np.cos(np.pi * (np.arange(_POINTS) + 0.5) / _POINTS))


def _lagrange(place: Float64) -> Float64:
    """Return (..., points), the Lagrange polynomials of the points at `place` (...) in [−1, 1]."""
    weights = (-1.0) ** np.arange(_POINTS) * np.sin(np.pi * (np.arange(_POINTS) + 0.5) / _POINTS)
    difference = place[..., None] - _points()
    # At a point itself 0/0: so near to it all digits agree.
    difference = np.where(np.abs(difference) < 1e-14, 1e-14, difference)
    terms = weights / difference
    return np.asarray(terms / terms.sum(axis=-1, keepdims=True))
