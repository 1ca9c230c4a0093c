"""A stack's colours out of its tables: factors linear between texels, multiplied band by band, as GLSL does.

Twin: shaders/lighting/layer_tables.glsl. Along an axis of n texels from 0 to 1 a coordinate t lies at texel
t·(n − 1), so that the first and the last centre stand for its ends (OpenGL 4.6, 8.14.3, with
s = (t·(n − 1) + ½)/n and CLAMP_TO_EDGE).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.baking.baked_layers import BakedLayers

__all__ = ["ImageColours", "LayerLookup"]

Float64 = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class ImageColours:
    """What a stack makes of image light, which its host's surface lets in; colours (..., 3), white 1.

    layers : of each layer's own prefiltered radiance, outermost first.
    diffuse : of the irradiance, over a white Lambertian base as if it lay in the host. slope, offset : of the
        radiance of a metal base's lobe, F0·slope + offset.
    """

    layers: tuple[Float64, ...]
    diffuse: Float64
    slope: Float64
    offset: Float64


class LayerLookup:
    """`LayerColours` of filled tables where the texture of periods is `texel` (...), which broadcasts."""

    def __init__(self, baked: BakedLayers, texel: ArrayLike = 1.0) -> None:
        self._baked = baked
        span = baked.plan.texel
        value, width = np.asarray(texel, np.float64), span.high - span.low
        self._period = np.clip((value - span.low) / width, 0.0, 1.0) if width > 0.0 else 0.0 * value

    def reflected(self, layer: int, cos_h: ArrayLike, cos_i: ArrayLike, cos_o: ArrayLike) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o); cosines in the host."""
        shape = np.broadcast_shapes(*(np.shape(x) for x in (self._period, cos_h, cos_i, cos_o)))
        if layer == 0:
            return np.broadcast_to(self._at(self._baked.first, cos_h)[..., :3], (*shape, 3))
        factors = self._at(self._baked.reflected[layer], cos_h)
        return np.broadcast_to(
            (factors * self._through(layer, cos_i, cos_o)) @ self._baked.weights, (*shape, 3)
        )

    def passed(self, cos_i: ArrayLike, cos_o: ArrayLike) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers."""
        return np.asarray(self._through(len(self._baked.plan.layers), cos_i, cos_o) @ self._baked.weights)

    def entering(self, cos_i: ArrayLike) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        return np.asarray(self._through(len(self._baked.plan.layers), cos_i) @ self._baked.weights)

    def image(self, n_dot_v: ArrayLike, metal_roughness: ArrayLike = 0.0) -> ImageColours:
        """Return what image light becomes, seen at the cosine `n_dot_v` in the host.

        metal_roughness : perceptual, of the metal below; not read where there is none.
        """
        baked = self._baked
        layers = tuple(self._at(each, n_dot_v)[..., :3] for each in baked.sent)
        diffuse = self._at(baked.scattered, n_dot_v)[..., :3]
        span, nodes = baked.plan.metal_roughness, len(baked.mirrored)
        if span is None:
            return ImageColours(layers, diffuse, np.zeros_like(diffuse), np.zeros_like(diffuse))
        width = span.high - span.low
        value = (np.asarray(metal_roughness, np.float64) - span.low) / (width if width > 0.0 else 1.0)
        cell, on = _cell(value, nodes)
        below = np.minimum(cell + 1, nodes - 1)
        terms = []
        for term in (0, 1):
            seen = np.stack([self._at(each[term], n_dot_v)[..., :3] for each in baked.mirrored])
            here, there = (
                np.take_along_axis(seen, np.broadcast_to(place, seen.shape[1:-1])[None, ..., None], axis=0)[0]
                for place in (cell, below)
            )
            terms.append(np.asarray((1.0 - on) * here + on * there))
        return ImageColours(layers, diffuse, *terms)

    def _through(self, layers: int, *cosines: ArrayLike) -> Float64:
        """Return Π_{k<layers} T_k, once for each of `cosines`, (..., B')."""
        product = np.ones(self._baked.weights.shape[0])
        for transmitted in self._baked.transmitted[:layers]:
            for cosine in cosines:
                product = product * self._at(transmitted, cosine)
        return product

    def _at(self, texels: Floats, cosine: ArrayLike) -> Float64:
        """Return (..., n) of texels (P, C, n), bilinear."""
        periods, cosines, _ = texels.shape
        row, down = _cell(self._period, periods)
        column, right = _cell(np.asarray(cosine, np.float64), cosines)
        below, beside = np.minimum(row + 1, periods - 1), np.minimum(column + 1, cosines - 1)
        upper = (1.0 - right) * texels[row, column] + right * texels[row, beside]
        if periods == 1:
            return np.asarray(upper, np.float64)
        lower = (1.0 - right) * texels[below, column] + right * texels[below, beside]
        return np.asarray((1.0 - down) * upper + down * lower)


def _cell(coordinate: Float64, nodes: int) -> tuple[NDArray[np.intp], Float64]:
    """Return the texel before each coordinate in [0, 1] and how far on it lies (..., 1), in texels."""
    place = np.clip(coordinate, 0.0, 1.0) * (nodes - 1)
    # NaN, which no index can be, stays in the weight.
    cell = np.fmin(np.fmax(np.floor(place), 0.0), max(nodes - 2, 0)).astype(np.intp)
    return cell, np.asarray(place - cell)[..., None]
