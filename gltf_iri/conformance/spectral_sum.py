"""Spectra to linear Rec.709 on panels that are halved until no colour moves: the vectors' own integration.

RGB = M ∫ S(λ) D65(λ) (x̄, ȳ, z̄) dλ from 360 to 830 nm, each row scaled so that S ≡ 1 is (1, 1, 1). On a panel
S is the polynomial through its Gauss points, and what it is multiplied with is integrated exactly: linear
pieces of 1 nm (observer) and 5 nm (D65). Nothing is shared with `gltf_iri.colour.integrate` but the tables.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Final

import numpy as np
from numpy.polynomial.legendre import leggauss, legval
from numpy.typing import NDArray

from gltf_iri.colour.observer import colour_matching, illuminant
from gltf_iri.colour.spaces import XYZ_TO_REC709
from gltf_iri.errors import GltfIriError

__all__ = ["NotSettledError", "Spectra", "colour_sum"]

Float64 = NDArray[np.float64]

# spectra(wavelength_nm (k,)) → (q, k), as many spectra as are summed at once.
Spectra = Callable[[Float64], Float64]

POINTS: Final = 14
_WIDTH_NM: Final = 16
_FIRST_NM, _LAST_NM = 360, 830

# Of one panel: some thousands of them together stay below 1e-10, a tenth of the last decimal that is kept.
_PANEL_TOLERANCE: Final = 5e-13

# Beyond, a row takes too long to be worth its place.
_PANELS_MAX: Final = 6000


class NotSettledError(GltfIriError):
    """A value that no affordable number of points settles."""


def colour_sum(spectra: Spectra, *, tolerance: float = _PANEL_TOLERANCE) -> Float64:
    """Return the colours (q, 3) of `spectra`.

    tolerance : a panel is done when its halves move no channel by more.
    Raises NotSettledError where that takes more than 6000 panels.
    """
    panels = _first_panels()
    sums = _panel_sums(spectra, panels)
    total, count = np.zeros(sums.shape[1:]), len(panels)
    while len(panels) > 0:
        count += 2 * len(panels)
        if count > _PANELS_MAX:
            raise NotSettledError("The colour moves with every halving of its panels of wavelengths.")
        halves = _halved(panels)
        finer = _panel_sums(spectra, halves)
        both = finer[0::2] + finer[1::2]
        # Not "moved > tolerance": a NaN must not count as settled.
        is_open = ~(np.abs(both - sums).max(axis=(1, 2)) <= tolerance)
        total += both[~is_open].sum(axis=0)
        kept = np.repeat(is_open, 2)
        panels, sums = halves[kept], finer[kept]
    return total


def _first_panels() -> Float64:
    """Return (p, 2): start and width. Whole nanometres stay whole down to a width of 1."""
    starts = np.arange(_FIRST_NM, _LAST_NM - _WIDTH_NM + 1, _WIDTH_NM)
    panels = [(float(start), float(_WIDTH_NM)) for start in starts]
    rest = float(starts[-1] + _WIDTH_NM)
    while rest < _LAST_NM:
        width = 2.0 ** np.floor(np.log2(_LAST_NM - rest))
        panels.append((rest, width))
        rest += width
    return np.array(panels)


def _halved(panels: Float64) -> Float64:
    start, half = panels[:, 0], 0.5 * panels[:, 1]
    return np.stack([start, half, start + half, half], axis=-1).reshape(-1, 2)


def _panel_sums(spectra: Spectra, panels: Float64) -> Float64:
    """Return (p, q, 3), what each panel adds to each colour."""
    nodes, _ = leggauss(POINTS)
    wavelength_nm = panels[:, :1] + panels[:, 1:] * (0.5 + 0.5 * nodes)
    values = spectra(wavelength_nm.reshape(-1)).reshape(-1, len(panels), POINTS)
    weights = np.stack([_weights(float(start), float(width)) for start, width in panels])
    return np.asarray(np.einsum("qpn,pnc->pqc", values, weights))


@cache
def _weights(start_nm: float, width_nm: float) -> Float64:
    """Return (POINTS, 3): what S at each Gauss point of a panel adds to R, G and B."""
    return np.asarray(_raw_weights(start_nm, width_nm) / _white())


@cache
def _white() -> Float64:
    return np.asarray(
        np.sum([_raw_weights(float(s), float(w)).sum(axis=0) for s, w in _first_panels()], axis=0)
    )


def _raw_weights(start_nm: float, width_nm: float) -> Float64:
    """Return ∫ ℓ_j(λ) M D65 (x̄, ȳ, z̄) dλ of the Lagrange polynomials ℓ_j through the panel's Gauss points."""
    nodes, gauss = leggauss(POINTS)
    # A piece of 1 nm holds a polynomial of degree POINTS + 1 at most: as many Gauss points are exact.
    pieces = max(1, round(width_nm))
    inside = ((np.arange(pieces)[:, None] + 0.5 + 0.5 * nodes) / pieces).reshape(-1)
    wavelength_nm = start_nm + width_nm * inside
    step = np.tile(0.5 * gauss, pieces) * (width_nm / pieces)
    light = illuminant(wavelength_nm, "D65") * step
    rgb = (colour_matching(wavelength_nm) * light[:, None]) @ XYZ_TO_REC709.T
    # ℓ_j = Σ_k (2k + 1)/2 · gauss_j P_k(node_j) P_k
    degrees = np.eye(POINTS)
    at_nodes, there = legval(nodes, degrees), legval(2.0 * inside - 1.0, degrees)
    lagrange = gauss * np.einsum("k,kj,ki->ij", np.arange(POINTS) + 0.5, at_nodes, there)
    return np.asarray(lagrange.T @ rgb)
