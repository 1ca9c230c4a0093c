"""Spectra as their means over a few bands of wavelengths, which multiply as spectra do.

Light that meets several layers is attenuated by the product of their spectra. Colours do not multiply so;
means over narrow bands nearly do, and B of them are a small table's worth:

    ∫ f(λ) g(λ) … w(λ) dλ ≈ Σ_b W_b f_b g_b …,   f_b = ∫_b f u dλ / ∫_b u dλ,   W_b = ∫_b w dλ,

where w is the density of linear Rec.709 under a white, and each band holds the same share of u = Σ_c |w_c|.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.quadrature import ColourRule, colour_density
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError

__all__ = ["BANDS_MAX", "BANDS_MIN", "Bands", "bands_of"]

Float64 = NDArray[np.float64]

BANDS_MIN: Final = 3
BANDS_MAX: Final = 64

_SHORTEST_NM, _LONGEST_NM = WAVELENGTH_RANGE_NM
_STEPS: Final = 9400  # of 0.05 nm, between which cumulative sums are linear


@dataclass(frozen=True, slots=True)
class Bands:
    """B bands under a white: a spectrum's colour is Σ_b mean_b · weights[b].

    edges_nm : (B + 1,), rising from the visible range's one end to the other.
    weights : (B, 3) linear Rec.709; columns sum to 1, so that the spectrum 1 is white.
    """

    edges_nm: Float64
    weights: Float64
    white: White

    def shares(self, rule: ColourRule) -> Float64:
        """Return (k, B), ≥ 0, columns sum to 1: what each of a rule's wavelengths adds to each mean.

        A wavelength stands for what lies nearer to it than to the others; an edge cuts that.
        """
        nm = rule.wavelength_nm
        cells = _seen(np.concatenate([[_SHORTEST_NM], 0.5 * (nm[1:] + nm[:-1]), [_LONGEST_NM]]), self.white)
        bounds = _seen(self.edges_nm, self.white)
        low = np.maximum(cells[:-1, None], bounds[None, :-1])
        overlap = np.maximum(np.minimum(cells[1:, None], bounds[None, 1:]) - low, 0.0)
        return np.asarray(overlap / overlap.sum(axis=0))

    def means(self, spectrum: Float64, rule: ColourRule) -> Float64:
        """Return (..., B) of spectra (..., k) at the wavelengths of `rule`; within each one's range."""
        return np.asarray(spectrum @ self.shares(rule))


@cache
def bands_of(count: int, white: White) -> Bands:
    """Return `count` bands under `white`; UsageError for fewer than BANDS_MIN or more than BANDS_MAX."""
    if not BANDS_MIN <= count <= BANDS_MAX:
        raise UsageError(f"There can be {BANDS_MIN} to {BANDS_MAX} bands, not {count}.")
    nm, seen, colour = _cumulative(white)
    edges_nm = np.interp(np.linspace(0.0, 1.0, count + 1), seen, nm)
    edges_nm[0], edges_nm[-1] = _SHORTEST_NM, _LONGEST_NM
    ends = np.stack([np.interp(edges_nm, nm, each) for each in colour.T], axis=-1)
    weights = np.diff(ends, axis=0)
    weights /= weights.sum(axis=0)
    for array in (edges_nm, weights):
        array.setflags(write=False)
    return Bands(edges_nm, weights, white)


def _seen(wavelength_nm: Float64, white: White) -> Float64:
    """Return the share (...) of u below `wavelength_nm`."""
    nm, seen, _ = _cumulative(white)
    return np.asarray(np.interp(wavelength_nm, nm, seen))


@cache
def _cumulative(white: White) -> tuple[Float64, Float64, Float64]:
    """Return wavelengths (n,), ∫ u up to them (n,) and ∫ w (n, 3), all ending at 1."""
    nm = np.linspace(_SHORTEST_NM, _LONGEST_NM, _STEPS + 1)
    density = colour_density(0.5 * (nm[1:] + nm[:-1]), white)
    sums = [np.cumsum(each, axis=0) for each in (np.abs(density).sum(axis=-1), density)]
    seen, colour = (np.concatenate([np.zeros((1, *each.shape[1:])), each / each[-1]]) for each in sums)
    for array in (nm, seen, colour):
        array.setflags(write=False)
    return nm, seen, colour
