"""Spectra as their means over a few bands of wavelengths, which multiply as spectra do.

Light that meets several layers is attenuated by the product of their spectra. Colours do not multiply so;
means over narrow bands nearly do, and B of them are a small table's worth:

    ∫ f(λ) g(λ) … w(λ) dλ ≈ Σ_b W_b f_b g_b …

where w is the density of linear Rec.709 under a white. Bands lie evenly in s ∝ ∫ Σ_c |w_c| dλ/λ, from 0 to 1,
where a colour looks everywhere about equally close. On s, a mean is the value at s_b = (b + ½)/B of the
spectrum's part that B cosines hold, and a product of such values is weighed by the polynomial through them:

    f_b = ∫₀¹ f K_b ds,   W_b = ∫ w K_b dλ / B,   K_b(s) = 1 + 2 Σ_{m<B} cos(mπ s_b) cos(mπ s).

K_b has a peak 1/B wide and fading side lobes, also negative ones: where a spectrum jumps, means may leave its
range by a fifth of the jump. Bands that end sharply stay within but err twice as much
(spec/decisions/layers-bands.md).
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
_STEPS: Final = 4700  # of 0.1 nm, between which s runs straight


@dataclass(frozen=True, slots=True)
class Bands:
    """B bands under a white: a spectrum's colour is Σ_b mean_b · weights[b].

    centres_nm : (B,), rising; where each band's peak lies.
    weights : (B, 3) linear Rec.709; columns sum to 1, so that the spectrum 1 is white.
    """

    centres_nm: Float64
    weights: Float64
    white: White

    def shares(self, rule: ColourRule) -> Float64:
        """Return (k, B): what each of a rule's rising wavelengths adds to each mean; columns sum to 1.

        A wavelength stands for what lies nearer to it than to the others.
        """
        nm = rule.wavelength_nm
        ends_nm = np.concatenate([[_SHORTEST_NM], 0.5 * (nm[1:] + nm[:-1]), [_LONGEST_NM]])
        ends = np.interp(ends_nm, *_eye(self.white))
        count = len(self.centres_nm)
        orders = np.arange(1, count)
        sines = np.diff(np.sin(np.pi * np.outer(ends, orders)), axis=0) / (np.pi * orders)
        return np.asarray(np.diff(ends)[:, None] + 2.0 * sines @ _cosines(count).T)

    def means(self, spectrum: Float64, rule: ColourRule) -> Float64:
        """Return (..., B) of spectra (..., k) at the wavelengths of `rule`; of the spectrum 1 they are 1."""
        return np.asarray(spectrum @ self.shares(rule))


@cache
def bands_of(count: int, white: White) -> Bands:
    """Return `count` bands under `white`; UsageError for fewer than BANDS_MIN or more than BANDS_MAX."""
    if not BANDS_MIN <= count <= BANDS_MAX:
        raise UsageError(f"There can be {BANDS_MIN} to {BANDS_MAX} bands, not {count}.")
    nm, places = _eye(white)
    middle_nm, middles = 0.5 * (nm[1:] + nm[:-1]), 0.5 * (places[1:] + places[:-1])
    density = colour_density(middle_nm, white)
    density /= density.sum(axis=0)
    moments = np.cos(np.pi * np.outer(np.arange(1, count), middles)) @ density
    weights = (1.0 + 2.0 * _cosines(count) @ moments) / count
    centres_nm = np.interp(_centres(count), places, nm)
    for array in (centres_nm, weights):
        array.setflags(write=False)
    return Bands(centres_nm, weights, white)


def _centres(count: int) -> Float64:
    return np.asarray((np.arange(count) + 0.5) / count)


def _cosines(count: int) -> Float64:
    """Return cos(mπ s_b), (B, B − 1), for m = 1 … B − 1."""
    return np.asarray(np.cos(np.pi * np.outer(_centres(count), np.arange(1, count))))


@cache
def _eye(white: White) -> tuple[Float64, Float64]:
    """Return wavelengths (n,) over the visible range and their s (n,), which rises from 0 to 1."""
    nm = np.linspace(_SHORTEST_NM, _LONGEST_NM, _STEPS + 1)
    middle_nm = 0.5 * (nm[1:] + nm[:-1])
    steps = np.abs(colour_density(middle_nm, white)).sum(axis=-1) / middle_nm
    places = np.concatenate([[0.0], np.cumsum(steps) / steps.sum()])
    places[-1] = 1.0
    for array in (nm, places):
        array.setflags(write=False)
    return nm, places
