"""Method `layers-rgb`: every factor a colour, and colours multiplied where physics multiplies spectra.

R_rgb of each layer's facets by one of the methods for mirrors, T_rgb(θ) = ∫ (1 − R_rgb(θ_d)) F_α dθ_d, the
filter of Fourneau et al. 2024, Eq. 28, over colours, as a renderer of three channels takes both (§5). The
first layer's reflection is as exact as the mirror method. Beyond it a channel knows the mean of each factor,
but not whether their band gaps meet.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.bloch import evaluate_bloch
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.landmarks import evaluate_landmarks, evaluate_landmarks_sub
from gltf_iri.evaluation.layers import BraggLayer, LayeredSurface, LayerStack, evaluate_layered
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.yeh_spectral import evaluate_yeh_spectral
from gltf_iri.optics.rough_bragg import filter_nodes

__all__ = ["LAYER_REFLECTANCES", "LayersRgb", "evaluate_layers_rgb"]

Float64 = NDArray[np.float64]

LAYER_REFLECTANCES: Final[Mapping[str, Callable[[Mirror, White], Evaluation]]] = MappingProxyType(
    {
        "bloch": evaluate_bloch,
        "yeh-spectral": evaluate_yeh_spectral,
        "landmarks": evaluate_landmarks,
        "landmarks-sub": evaluate_landmarks_sub,
    }
)


class LayersRgb:
    """`LayerColours` of a stack of any shape.

    reflectance : a name of `LAYER_REFLECTANCES`. Its functions raise UsageError where the mirror method has
    no answer: `bloch` where light is reflected totally within a cell.
    """

    def __init__(self, stack: LayerStack, white: White, *, reflectance: str = "bloch") -> None:
        self._stack, self._white = stack, white
        self._mirror_colour = LAYER_REFLECTANCES[reflectance]

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) times those of T_k(i) and T_k(o), k < layer."""
        own = self._colour(self._stack.layers[layer], cos_h)
        return np.asarray(own * self._through(layer, cos_i, cos_o))

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colours of all T_k(i) and T_k(o) multiplied; 1 where there is none."""
        return self._through(len(self._stack.layers), cos_i, cos_o)

    def entering(self, cos_i: Float64) -> Float64:
        """Return (..., 3), the colours of all T_k(i) multiplied: of light that crosses the layers once."""
        return self._through(len(self._stack.layers), cos_i)

    def _through(self, above: int, *cosines: Float64) -> Float64:
        colour = np.ones((*np.broadcast_shapes(*map(np.shape, cosines)), 3))
        for layer in self._stack.layers[:above]:
            for cosine in cosines:
                colour = colour * self._passed(layer, cosine)
        return colour

    def _colour(self, layer: BraggLayer, cosine: Float64) -> Float64:
        return self._mirror_colour(layer.mirror(cosine, self._stack.host_ior), self._white).rgb

    def _passed(self, layer: BraggLayer, cosine: Float64) -> Float64:
        """Return T_rgb (..., 3) of one layer at `cosine` (...)."""
        if not layer.alpha.any():
            return np.asarray(1.0 - self._colour(layer, cosine))
        shape = np.broadcast_shapes(np.shape(cosine), self._stack.host_ior.shape, layer.shape)
        nodes, weights = filter_nodes(np.broadcast_to(cosine, shape), layer.alpha)
        # The nodes lie before the axes that the layer's own arrays broadcast with.
        reflected = self._colour(layer, np.moveaxis(nodes, -1, 0))
        return np.asarray(np.einsum("...n,n...c->...c", weights, 1.0 - reflected))


def evaluate_layers_rgb(surface: LayeredSurface, white: White, *, reflectance: str = "bloch") -> Evaluation:
    """Evaluate `layers-rgb` under `white`; UsageError where `reflectance` has no answer."""
    return evaluate_layered(
        surface, LayersRgb(surface.stack, white, reflectance=reflectance), "layers-rgb", white
    )
