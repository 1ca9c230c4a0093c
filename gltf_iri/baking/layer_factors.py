"""What one layer reflects, lets pass and sends of a white sky, over the period and the cosine.

All are linear in the reflectance. So spectra are asked for at the tables' own cosines, and at Chebyshev
points, of which matrices make the means over facets: by the filter F_α and over the lobe (`facet_matrix`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, chebyshev_moments, terms_for, to_coefficients
from gltf_iri.baking.layer_spectra import Weighing, layer_spectra
from gltf_iri.optics.filter_panels import FilterPanels
from gltf_iri.optics.layer_lobe import layer_lobe
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer

__all__ = ["LayerFactors", "SkyFactors", "layer_factors", "passing_moments", "sky_factors"]
__all__ += ["sky_nodes"]

Float64 = NDArray[np.float64]

_VALUES_AT_ONCE: Final = 1 << 22  # bounds memory, and how long an interrupt waits
_ROWS_AT_ONCE: Final = 64  # of 768 points of a lobe: their numbers stay in a core's cache

# What means over facets may err by, about: half precision rounds by more.
_MAX_ERROR: Final = 2e-5

_SKY_NODES: Final = 48
_PANELS: Final = 64  # of 16 angles of the filter: series of 384 terms swing half as often
_LOBE: Final = {"slopes": 48, "turns": 16}


@dataclass(frozen=True, slots=True)
class LayerFactors:
    """Of one layer, at p texels and c cosines.

    reflected, transmitted : (p, c, B) as a `Weighing` keeps them; colour : (p, c, 3) of what is reflected.
    series : (p, terms, B + 3), Chebyshev coefficients over the cosine of reflected and colour.
    """

    reflected: Float64
    colour: Float64
    transmitted: Float64
    series: Float64


@dataclass(frozen=True, slots=True)
class SkyFactors:
    """What a layer makes of a white sky, as `BakedLayers` has it.

    albedo : (p, c, B); colour : (p, c, 3) of it.
    passed : (p, s, B), what passes of light from the directions of `sky_nodes`.
    """

    albedo: Float64
    colour: Float64
    passed: Float64


def layer_factors(
    plan: LayersPlan, layer: PlannedLayer, texel: Float64, cosines: Float64, weighing: Weighing
) -> LayerFactors:
    """Return the factors of `layer` at the texels (p,) and the cosines (c,) in the host."""
    both = np.concatenate([weighing.shares, weighing.rule.weights], axis=1)

    def kept(at: Float64, texels: Float64) -> Float64:
        """Return (texels, at, B + 3)."""
        step = max(1, _VALUES_AT_ONCE // (len(at) * len(both)))
        parts = [
            layer_spectra(plan, layer, texels[i : i + step, None], at, weighing.rule) @ both
            for i in range(0, len(texels), step)
        ]
        return np.concatenate(parts)

    bands = weighing.shares.shape[1]
    direct = kept(cosines, texel)
    hardest = texel[[0, len(texel) // 2, -1]]
    terms = terms_for(lambda at: kept(at, hardest), _MAX_ERROR)
    values = kept(chebyshev_cosines(terms), texel)
    series = np.einsum("jk,pkb->pjb", to_coefficients(terms), values)
    reflected = direct[..., :bands]
    if layer.alpha <= ALPHA_MIN:
        transmitted = 1.0 - reflected
    else:
        transmitted = _passed(cosines, layer.alpha, series[..., :bands])
    return LayerFactors(reflected, direct[..., bands:], transmitted, series)


def sky_nodes(host_ior: float) -> tuple[Float64, Float64]:
    """Return cosines in the host and weights (s,) of a mean over a white sky, as the coating lets it in.

    2∫ f T c dc / 2∫ T c dc over the cosine c outside, T the coating's transmittance.
    """
    nodes, weights = gauss_unit(_SKY_NODES)
    entering = nodes * weights * coating_transmittance(host_ior, nodes)
    return cosine_in_host(host_ior, nodes), np.asarray(entering / np.sum(entering))


def sky_factors(layer: PlannedLayer, factors: LayerFactors, cosines: Float64, sky: Float64) -> SkyFactors:
    """Return what the layer of `factors` makes of a white sky at the cosines (c,).

    sky : the cosines (s,) of `sky_nodes`.
    """
    series = factors.series
    bands = factors.reflected.shape[-1]
    moments = np.concatenate(
        [
            chebyshev_moments(
                *layer_lobe(np.maximum(cosines[i : i + _ROWS_AT_ONCE], N_DOT_V_MIN), layer.alpha, **_LOBE),
                series.shape[1],
            )
            for i in range(0, len(cosines), _ROWS_AT_ONCE)
        ]
    )
    albedo = np.einsum("cj,pjb->pcb", moments, series)
    passed = _passed(sky, layer.alpha, series[..., :bands])
    return SkyFactors(albedo[..., :bands], albedo[..., bands:], passed)


def _passed(cosines: Float64, alpha: float, series: Float64) -> Float64:
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
