"""What one layer reflects and lets pass, over the period and the cosine.

Both are linear in the reflectance. So spectra are asked for at the tables' own cosines, and at Chebyshev
points, of which matrices make means over facets (`facet_matrix`): by the filter F_α, and over a lobe.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, terms_for, to_coefficients
from gltf_iri.baking.layer_spectra import Weighing, layer_spectra
from gltf_iri.optics.filter_panels import FilterPanels
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer

__all__ = ["LayerFactors", "layer_factors", "passed_at", "passing_moments"]

Float64 = NDArray[np.float64]

_VALUES_AT_ONCE: Final = 1 << 22  # bounds memory, and how long an interrupt waits
_ROWS_AT_ONCE: Final = 64  # of 1536 points of a lobe: their numbers stay in a core's cache

# What means over facets may err by, about: half precision rounds by more.
_MAX_ERROR: Final = 2e-5

_PANELS: Final = 64  # of 16 angles of the filter: series of 384 terms swing half as often


@dataclass(frozen=True, slots=True)
class LayerFactors:
    """Of one layer, at p texels and c cosines.

    reflected, transmitted : (p, c, B) as a `Weighing` keeps them; colour : (p, c, 3) of what is reflected.
    colour_series : (p, terms, 3), sky_series : (p, terms, S), Chebyshev coefficients over the cosine of
        what is reflected, as a colour and by the sums that were asked for.
    """

    reflected: Float64
    colour: Float64
    transmitted: Float64
    colour_series: Float64
    sky_series: Float64


def layer_factors(
    plan: LayersPlan,
    layer: PlannedLayer,
    texel: Float64,
    cosines: Float64,
    weighing: Weighing,
    sky_shares: Float64,
) -> LayerFactors:
    """Return the factors of `layer` at the texels (p,) and the cosines (c,) in the host.

    sky_shares : (k, S) of more sums over the wavelengths of the weighing's rule.
    """
    rule, bands = weighing.rule, weighing.shares.shape[1]
    both = np.concatenate([weighing.shares, rule.weights], axis=1)
    all_sums = np.concatenate([both, sky_shares], axis=1)

    def kept(at: Float64, texels: Float64, sums: Float64) -> Float64:
        """Return (texels, at, sums)."""
        step = max(1, _VALUES_AT_ONCE // (len(at) * len(sums)))
        parts = [
            layer_spectra(plan, layer, texels[i : i + step, None], at, rule) @ sums
            for i in range(0, len(texels), step)
        ]
        return np.concatenate(parts)

    direct = kept(cosines, texel, both)
    hardest = texel[[0, len(texel) // 2, -1]]
    terms = terms_for(lambda at: kept(at, hardest, both), _MAX_ERROR)
    values = kept(chebyshev_cosines(terms), texel, all_sums)
    series = np.einsum("jk,pkb->pjb", to_coefficients(terms), values)
    of_bands, of_colour, of_sky = np.split(series, [bands, bands + 3], axis=2)
    reflected = direct[..., :bands]
    smooth = layer.alpha <= ALPHA_MIN
    transmitted = 1.0 - reflected if smooth else passed_at(cosines, layer.alpha, of_bands)
    return LayerFactors(reflected, direct[..., bands:], transmitted, of_colour, of_sky)


def passed_at(cosines: Float64, alpha: float, series: Float64) -> Float64:
    """Return (p, c, B), T = ∫ (1 − R) F_α dθ_d of a series (p, terms, B) of R; of smooth layers 1 − R."""
    moments = passing_moments(cosines, alpha, series.shape[1])
    return np.asarray(moments[:, :1] - np.einsum("cj,pjb->pcb", moments, series))


def passing_moments(cosines: Float64, alpha: float, terms: int) -> Float64:
    """Return ∫ T_j(2 cosθ_d − 1) F_α dθ_d, (c, terms), at the cosines (c,); the first is G₁.

    Of layers as smooth as can be the filter has all its weight, 1, at the light's own angle.
    """
    if alpha <= ALPHA_MIN:
        return np.asarray(chebvander(2.0 * cosines - 1.0, terms - 1))
    return _kept_moments(cosines.tobytes(), alpha, terms)


@lru_cache(maxsize=32)
def _kept_moments(told: bytes, alpha: float, terms: int) -> Float64:
    """Return the moments of rough layers; those of the same tables are asked for again and again."""
    cosines, panels = np.frombuffer(told), _panels()
    vander = chebvander(2.0 * panels.cosines - 1.0, terms - 1)
    parts = [
        panels.weights(cosines[i : i + _ROWS_AT_ONCE], alpha) @ vander
        for i in range(0, len(cosines), _ROWS_AT_ONCE)
    ]
    moments = np.concatenate(parts)
    moments.setflags(write=False)
    return moments


@cache
def _panels() -> FilterPanels:
    return FilterPanels.of(_PANELS)
