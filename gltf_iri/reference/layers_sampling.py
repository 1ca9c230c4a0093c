"""Importance sampling of the single-reflection model: a layer or the base is chosen, then a direction.

Layer l is chosen with p_l = (1 − p_trans,l) Π_{k<l} p_trans,k, Fourneau et al. 2024, Eq. 35, p_trans from
Eq. 31 as a mean over wavelengths; the base with what is left. A layer, or a metal, mirrors at a facet drawn
as the light sees it; a diffuse base sends light by the cosine outside. Directions are along axes of which +Z
is the stack's normal, outside the coating.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.layer_stack import cosine_in_host
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.optics.visible_normals import draw_facet, mirror_density, mirrored
from gltf_iri.reference.layers_facets import StackFacets, passing_chance

__all__ = ["LayerSampler"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LayerSampler:
    """Directions for one stack; `facets` holds it at the wavelengths that probabilities are means over.

    What has no BRDF is not chosen: smooth layers, a black base. Where nothing is left, no direction is kept.
    """

    facets: StackFacets

    def lobes(self, light: Float64) -> tuple[Float64, list[float | None]]:
        """Return probabilities (n, lobes) for unit directions `light` (n, 3), and each lobe's α.

        Lobes are the layers, the base's metal and its diffuse share, whose α is None.
        """
        stack = self.facets.stack
        cosine = cosine_in_host(stack.host_ior, light[:, 2])
        reaching, shares, alphas = np.ones(len(light)), [], list[float | None]()
        for layer in range(self.facets.count):
            alpha = self.facets.alpha(layer)
            g1 = g1_smith(cosine, alpha)
            passing = passing_chance(self.facets.facet_passage(layer, cosine).mean(axis=1), g1)
            shares.append(reaching * np.maximum(1.0 - passing, 0.0) * (alpha > 0.0))
            alphas.append(alpha)
            reaching = reaching * passing
        diffuse, metal = float(stack.base.diffuse.mean()), float(stack.base.metal_share)
        below = diffuse + metal
        shares += [reaching * (part / below if below else 0.0) for part in (metal, diffuse)]
        alphas += [float(stack.base.metal_alpha), None]
        total = np.sum(shares, axis=0)
        chosen = np.divide(shares, total, out=np.zeros((len(shares), len(light))), where=total > 0.0)
        return chosen.T, alphas

    def sample(self, light: Float64, rng: np.random.Generator) -> tuple[Float64, NDArray[np.bool_]]:
        """Return unit directions (n, 3) for the light from `light` (n, 3), z > 0, and which of them are kept.

        Those not kept were mirrored below the horizon, or cannot leave the coating; they stand for 0.
        """
        probability, alphas = self.lobes(light)
        chosen = np.sum(rng.random((len(light), 1)) >= np.cumsum(probability, axis=1), axis=1)
        place = rng.random((len(light), 2))
        host = float(self.facets.stack.host_ior)
        inside, view = self._inside(light), np.zeros_like(light)
        kept = np.zeros(len(light), bool)
        for number, alpha in enumerate(alphas):
            rows = np.flatnonzero((chosen == number) & (probability[:, number] > 0.0))
            if alpha is None:
                radius, turn = np.sqrt(place[rows, 0]), 2.0 * np.pi * place[rows, 1]
                level = radius * np.cos(turn), radius * np.sin(turn)
                view[rows] = np.column_stack([*level, np.sqrt(1.0 - place[rows, 0])])
                kept[rows] = True
            elif len(rows):
                width = np.full(len(rows), alpha)
                sent = mirrored(inside[rows], draw_facet(inside[rows], width, width, place[rows]))
                squared = 1.0 - host * host * (1.0 - sent[:, 2]) * (1.0 + sent[:, 2])
                kept[rows] = (sent[:, 2] > 0.0) & (squared > 0.0)
                view[rows] = np.column_stack([host * sent[:, :2], np.sqrt(np.maximum(squared, 0.0))])
        view[~kept] = [0.0, 0.0, 1.0]
        return view, kept

    def density(self, light: Float64, view: Float64) -> Float64:
        """Return how densely `sample` draws `view` (n, 3) for `light` (n, 3), per steradian outside.

        Bending into the host makes cosθ_o/(n_h² cosθ'_o) sr of one outside. 0 below the horizon; the integral
        over all directions is the share of samples that are kept.
        """
        probability, alphas = self.lobes(light)
        is_above = view[:, 2] > 0.0
        above = np.where(is_above[:, None], view, [0.0, 0.0, 1.0])
        host = float(self.facets.stack.host_ior)
        inside, seen = self._inside(light), self._inside(above)
        bending = above[:, 2] / (host * host * seen[:, 2])
        total = np.zeros(len(view))
        for number, alpha in enumerate(alphas):
            if alpha is None:
                total += probability[:, number] * above[:, 2] / np.pi
            elif np.any(probability[:, number] > 0.0):
                width = np.full(len(view), alpha)
                total += probability[:, number] * mirror_density(inside, seen, width, width) * bending
        return np.where(is_above, total, 0.0)

    def _inside(self, direction: Float64) -> Float64:
        """Return the direction in the host."""
        host = float(self.facets.stack.host_ior)
        return np.column_stack([direction[:, :2] / host, cosine_in_host(host, direction[:, 2])])
