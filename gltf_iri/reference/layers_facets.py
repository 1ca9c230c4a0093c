"""What a simulated path meets in a stack: facets' reflectances, and what of light gets by a layer's facets.

Either is had at a few wavelengths for many paths. By facets drawn as light sees them (Fourneau et al. 2024,
Eq. 23), a layer passes the mean of the facets' own transmissivity, masked once more on the way out,

    T(θ) = G₁(θ) ∫ (1 − R(i·m)) D(m) G₁(i) (i·m)/(i·n) dm,

and by Eq. 28 the same mean is an integral over one angle, tabulated here over θ without its factor G₁.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import LayerStack
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.optics.visible_normals import draw_facet, mirrored

__all__ = ["StackFacets", "passing_chance"]

Float64 = NDArray[np.float64]

# Nodes of the table over θ, so many that cubics through four of them err by 1e-5.
_NODES_AN_ALPHA: Final = 15.0
_NODES_MIN: Final = 65
_NODES_MAX: Final = 4096

# G₁ vanishes at grazing: the table's last node stands for it just above.
_COS_MIN: Final = 1e-6


@dataclass(frozen=True)
class StackFacets:
    """One stack at `wavelength_nm` (W,), whose tables are made at need, or taken from `tables`.

    Raises UsageError where the stack is of arrays.
    """

    stack: LayerStack
    wavelength_nm: Float64
    tables: Callable[[], Sequence[Float64]] | None = None

    def __post_init__(self) -> None:
        base = self.stack.base
        shapes = [layer.shape for layer in self.stack.layers] + [
            base.metal_share.shape,
            base.metal_alpha.shape,
        ]
        is_one = all(shape == () for shape in [*shapes, self.stack.host_ior.shape])
        if not is_one or base.diffuse.shape != (3,) or base.metal_f0.shape != (3,):
            raise UsageError("One stack is simulated at a time: give numbers for its layers, host and base.")

    @property
    def count(self) -> int:
        """Return the number of layers."""
        return len(self.stack.layers)

    def alpha(self, layer: int) -> float:
        """Return the layer's roughness; 0 is a smooth mirror."""
        return float(self.stack.layers[layer].alpha)

    def reflectance(self, layer: int, cosine: Float64) -> Float64:
        """Return R (n, W) of facets met at `cosine` (n,), the mean of both polarisations."""
        # Paths that have not turned yet share one direction.
        once, back = np.unique(np.clip(cosine, 0.0, 1.0), return_inverse=True)
        return np.asarray(self._layers[layer].reflectance(once, self.wavelength_nm)[back])

    def facet_passage(self, layer: int, cosine: Float64) -> Float64:
        """Return the mean (n, W) of 1 − R over the facets that light at `cosine` (n,) sees: T/G₁, Eq. 28."""
        if self.alpha(layer) == 0.0:
            return 1.0 - self.reflectance(layer, cosine)
        table = self._passages[layer]
        place = np.arccos(np.clip(cosine, 0.0, 1.0)) * ((len(table) - 1) / (0.5 * np.pi))
        low = np.clip(place.astype(np.intp), 1, len(table) - 3)
        t = (place - low)[:, None]
        # Lagrange's cubic through the nodes −1, 0, 1 and 2.
        inner = (t + 1.0) * (t - 2.0) / 2.0
        outer = t * (t - 1.0) / 6.0
        return np.asarray(
            table[low] * (inner * (t - 1.0))
            - table[low + 1] * (inner * t)
            - table[low - 1] * (outer * (t - 2.0))
            + table[low + 2] * (outer * (t + 1.0))
        )

    def drawn_facet(self, layer: int, view: Float64, rng: np.random.Generator) -> tuple[Float64, Float64]:
        """Return the direction (n, 3) that a facet drawn for `view` mirrors to, and its R (n, W)."""
        alpha = np.full(len(view), self.alpha(layer))
        facet = draw_facet(view, alpha, alpha, rng.random((len(view), 2)))
        return mirrored(view, facet), self.reflectance(layer, np.sum(view * facet, axis=1))

    def at(self, wavelength: int) -> StackFacets:
        """Return the stack at one of its wavelengths, with this one's tables once they are needed."""
        one = self.wavelength_nm[wavelength : wavelength + 1]
        return StackFacets(self.stack, one, lambda: [table[:, wavelength, None] for table in self._passages])

    @cached_property
    def _layers(self) -> Sequence[LayerSpectra]:
        host = float(self.stack.host_ior)
        return [LayerSpectra(layer, host) for layer in self.stack.layers]

    @cached_property
    def _passages(self) -> Sequence[Float64]:
        if self.tables is not None:
            return self.tables()
        return [self._passage_table(layer) for layer in range(self.count)]

    def _passage_table(self, layer: int) -> Float64:
        alpha = self.alpha(layer)
        if alpha == 0.0:
            return np.zeros((0, len(self.wavelength_nm)))
        nodes = int(np.clip(_NODES_AN_ALPHA / alpha, _NODES_MIN, _NODES_MAX))
        cosine = np.maximum(np.cos(np.linspace(0.0, 0.5 * np.pi, nodes)), _COS_MIN)
        passed = self._layers[layer].transmissivity(cosine, self.wavelength_nm)
        return np.asarray(passed / g1_smith(cosine, alpha)[:, None])


def passing_chance(passage: Float64, g1: Float64) -> Float64:
    """Return p_trans = T / (1 − A/2) = 2 T/(1 + G₁), T = passage·G₁; Fourneau et al. 2024, Eq. 30 and 31.

    What masking takes, A = 1 − G₁, is shared between what is reflected and what passes.

    passage : T/G₁, averaged over the wavelengths that a path carries; g1 : the share of facets that are seen.
    """
    return np.asarray(2.0 * passage * g1 / (1.0 + g1))
