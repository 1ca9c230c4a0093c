"""What becomes of a white sky on a stack of layers, over the viewer's cosine: colours of whole spectra.

A lobe's light comes from many directions, and passes the layers above at each of its own angles. Since all
periods run along one value, what a layer sends of a white sky through those above is a number of that value
and of the viewer's cosine alone:

    S_l(λ) = Π_{k<l} T_k(o) ∫ T_h(i) R_l(h) Π_{k<l} T_k(i) w cosθ_i dω_i,

over the directions in the host that light enters it from; T_h is what its surface lets in. With R_l and
Π T_k(i) as Chebyshev series over their cosines the integral is a sum of their coefficients' products, whose
factors no spectrum changes (`facet_matrix`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, chebyshev_moments, terms_for, to_coefficients
from gltf_iri.baking.layer_factors import LayerFactors, passed_at
from gltf_iri.colour.bands import Bands, bands_of
from gltf_iri.colour.spaces import White
from gltf_iri.optics.host_entrance import cosine_outside, entering_nodes
from gltf_iri.optics.layer_lobe import LobeNodes, lobe_nodes
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN
from gltf_iri.planning.layer_plan import LayersPlan

__all__ = ["SkyColours", "metal_roughness_nodes", "sky_bands", "sky_colours"]

Float64 = NDArray[np.float64]

# Of products of spectra that lobes have smoothed: 64 leave 2e-4 of three layers of ten cells in air, 48 1e-3.
_BANDS: Final = 64

# What series leave out, about: of what passes those above over the light's cosine, and of the colour behind
# them over the viewer's outside, which is smooth over its root.
_MAX_ERROR: Final = 5e-4
_TERMS_MAX: Final = 96
_FEWEST_TERMS: Final = 24


@dataclass(frozen=True, slots=True)
class SkyColours:
    """Colours, linear Rec.709, at P texels and C cosines of the viewer, as `BakedLayers` has them.

    sent : (L, P, C, 3), scattered : (P, C, 3), mirrored : (R, 2, P, C, 3).
    """

    sent: Float64
    scattered: Float64
    mirrored: Float64


def sky_bands(white: White) -> Bands:
    """Return the bands that products of spectra under a white sky are summed by."""
    return bands_of(_BANDS, white)


def metal_roughness_nodes(plan: LayersPlan) -> Float64:
    """Return the perceptual roughnesses (R,) that the metal below is tabulated at; none without one."""
    span = plan.metal_roughness
    return np.zeros(0) if span is None else np.linspace(span.low, span.high, plan.metal_nodes)


def sky_colours(
    plan: LayersPlan, factors: Sequence[LayerFactors], cosines: Float64, white: White
) -> SkyColours:
    """Return what becomes of a white sky, seen at the cosines (C,) in the host.

    factors : of every layer, with the sums of `sky_bands`.
    """
    periods, count = len(factors[0].colour), len(cosines)
    bands = sky_bands(white)
    above = _Above.nothing(periods)
    sent: list[Float64] = []
    for layer, of in zip(plan.layers, factors, strict=True):
        if not sent:  # nothing lies above, and its colours are known
            lobe = _lobe(plan, cosines, layer.alpha)
            moments = chebyshev_moments(lobe.cos_h, lobe.weights, of.colour_series.shape[1])
            sent.append(np.einsum("cj,pjb->pcb", moments, of.colour_series))
        else:

            def behind(
                seen: Float64, alpha: float = layer.alpha, of: LayerFactors = of, above: _Above = above
            ) -> Float64:
                sums = _sent(_lobe(plan, seen, alpha), of.sky_series, above)
                return (above.at(seen) * sums) @ bands.weights

            sent.append(_smooth(behind, cosines, plan.host_ior))
        above = above.and_below(layer.alpha, of.sky_series)
    scattered = np.zeros((periods, count, 3))
    roughness = metal_roughness_nodes(plan)
    mirrored = np.zeros((len(roughness), 2, periods, count, 3))
    if plan.under == "base":
        towards_viewer = above.at(cosines)
        inside, entering = entering_nodes(plan.host_ior)
        passed = np.einsum("s,psb->pb", entering, above.at(inside))
        scattered = (towards_viewer * passed[:, None]) @ bands.weights
        for place, each in enumerate(roughness):
            lobe = _lobe(plan, cosines, max(each * each, ALPHA_MIN))
            grazing = (1.0 - lobe.cos_h) ** 5
            for term, share in enumerate((1.0 - grazing, grazing)):
                moments = chebyshev_moments(lobe.cos_o, lobe.weights * share, above.terms)
                passed = np.einsum("ck,pkb->pcb", moments, above.series)
                mirrored[place, term] = (towards_viewer * passed) @ bands.weights
    return SkyColours(np.stack(sent), scattered, mirrored)


def _smooth(colours: Callable[[Float64], Float64], cosines: Float64, host_ior: float) -> Float64:
    """Return `colours` (P, C, 3) at `cosines`, through a series over √cosθ outside where that takes fewer."""
    terms = _FEWEST_TERMS
    while 2 * terms <= len(cosines):
        values = colours(cosine_in_host(host_ior, chebyshev_cosines(terms) ** 2))
        series = np.einsum("jk,pkc->pjc", to_coefficients(terms), values)
        if np.max(np.abs(series[:, -terms // 4 :])) <= _MAX_ERROR:
            places = 2.0 * np.sqrt(cosine_outside(host_ior, cosines)) - 1.0
            return np.asarray(np.einsum("nj,pjc->pnc", chebvander(places, terms - 1), series))
        terms *= 2
    return colours(cosines)


def _lobe(plan: LayersPlan, cosines: Float64, alpha: float) -> LobeNodes:
    """Return the directions of light that facets send to viewers at the cosines (C,) in the host.

    Its `cos_o` are those of light, which comes the way that it would go; `weights` hold what the host's
    surface lets in. Cosines that no viewer outside has are those along the surface.
    """
    n = plan.host_ior
    outside = np.maximum(cosine_outside(n, cosines), N_DOT_V_MIN)
    lobe = lobe_nodes(outside, alpha, n)
    return lobe._replace(weights=lobe.weights * coating_transmittance(n, lobe.cos_outside))


@dataclass(frozen=True, slots=True)
class _Above:
    """What passes some layers, (P, terms, B) Chebyshev coefficients over the cosine."""

    layers: tuple[tuple[float, Float64], ...]  # α and the series of R
    series: Float64

    @classmethod
    def nothing(cls, periods: int) -> _Above:
        return cls((), np.ones((periods, 1, 1)))

    @property
    def terms(self) -> int:
        return len(self.series[0])

    def at(self, cosines: Float64) -> Float64:
        """Return (P, n, B)."""
        through = np.ones((len(self.series), len(cosines), 1))
        for alpha, series in self.layers:
            through = through * passed_at(cosines, alpha, series)
        return through

    def and_below(self, alpha: float, series: Float64) -> _Above:
        """Return the same with another layer."""
        layers = (*self.layers, (alpha, series))
        hardest = [0, len(series) // 2, len(series) - 1]
        few = _Above(tuple((a, s[hardest]) for a, s in layers), self.series[hardest])
        terms = min(terms_for(few.at, _MAX_ERROR), _TERMS_MAX)
        values = _Above(layers, self.series).at(chebyshev_cosines(terms))
        return _Above(layers, np.einsum("jk,pkb->pjb", to_coefficients(terms), values))


def _sent(lobe: LobeNodes, reflected: Float64, above: _Above) -> Float64:
    """Return Σ weights R(cos_h) Π T(cos_o) over each lobe, (P, C, B)."""
    periods, terms, bands = reflected.shape
    flat = np.moveaxis(reflected, 1, 0).reshape(terms, -1)
    sums = np.zeros((periods, len(lobe.weights), bands))
    for row in range(len(lobe.weights)):
        facets = chebvander(2.0 * lobe.cos_h[row] - 1.0, terms - 1)
        light = chebvander(2.0 * lobe.cos_o[row] - 1.0, above.terms - 1) * lobe.weights[row, :, None]
        mixed = ((light.T @ facets) @ flat).reshape(above.terms, periods, bands)
        sums[:, row] = np.einsum("kpb,pkb->pb", mixed, above.series)
    return sums
