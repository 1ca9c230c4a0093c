"""The colours of layers without tables of their own: image light is met once a layer, as the renderer has it.

Each layer's at the mean cosine of the facets that send it, and what comes from below passes inwards at the
mean cosine of light from all around, 2/3. Twin: shaders/lighting/layers_direct.glsl.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_lookup import ImageColours
from gltf_iri.evaluation.layers import LayerColours
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.facet_mean import mean_cosine
from gltf_iri.optics.host_entrance import cosine_outside, entering_irradiance
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.planning.layer_plan import LayersPlan

__all__ = ["DirectLayers"]

Float64 = NDArray[np.float64]

_MEAN_COSINE = 2.0 / 3.0


@dataclass(frozen=True, slots=True)
class DirectLayers:
    """`ColoursAtPoints` of `colours`, which know of one direction."""

    plan: LayersPlan
    colours: LayerColours

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        return self.colours.reflected(layer, cos_h, cos_i, cos_o)

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers."""
        return self.colours.passed(cos_i, cos_o)

    def entering(self, cos_i: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        return self.colours.entering(cos_i)

    def image(self, n_dot_v: Float64, metal_roughness: Float64) -> ImageColours:
        """Return what image light becomes, seen at the cosine `n_dot_v` in the host; roughness perceptual."""
        host = self.plan.host_ior
        entering = coating_transmittance(host, cosine_outside(host, n_dot_v))[..., None]
        layers = []
        for number, layer in enumerate(self.plan.layers):
            roughness = np.full(n_dot_v.shape, np.sqrt(layer.alpha))
            a, b = dfg_terms(n_dot_v, roughness)
            met = mean_cosine(n_dot_v, roughness)
            layers.append(entering * (a + b)[..., None] * self.reflected(number, met, n_dot_v, n_dot_v))
        if self.plan.under == "nothing":
            nothing = np.zeros((*n_dot_v.shape, 3))
            return ImageColours(tuple(layers), nothing, nothing, nothing)
        inwards = np.broadcast_to(cosine_in_host(host, _MEAN_COSINE), n_dot_v.shape)
        a, b = dfg_terms(n_dot_v, metal_roughness)
        metal = entering * self.passed(n_dot_v, n_dot_v)
        return ImageColours(
            tuple(layers),
            entering_irradiance(host) * self.passed(inwards, n_dot_v),
            a[..., None] * metal,
            b[..., None] * metal,
        )
