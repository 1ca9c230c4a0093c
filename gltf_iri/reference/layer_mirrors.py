"""What of a path Bragg layers and the metal below them mirror, drawn lobe by lobe.

Lobes are the layers, outermost first, then the metal, then the host's smooth surface. Facets are drawn as the
path sees them in the host (Heitz 2018), so that a direction's f_r cosθ over its density is
T_c(i) T_c(o) G₁(i) times the colour that `evaluation/layers.py` gives: sums over lobes have f_r's own mean.
Directions are unit, (n, 3), outside of the host, along axes of which +Z is the surface's normal.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.layers import coating_reflectance
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import coating_transmittance
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.facets import draw_facet, mirrored
from gltf_iri.reference.host_directions import in_host, out_of_host
from gltf_iri.reference.layers_on import ColoursAtPoints, LayersMethod
from gltf_iri.reference.surface import Surface

__all__ = ["LayerMirrors"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]
Rows = NDArray[np.int64]

_TURNED: Final = np.array([-1.0, -1.0, 1.0])


@dataclass(frozen=True, slots=True)
class LayerMirrors:
    """The lobes of `plan`'s layers on `surface`, for paths that come from `view` (n, 3)."""

    surface: Surface
    plan: LayersPlan
    method: LayersMethod
    view: Float64

    @property
    def count(self) -> int:
        """How many lobes there are."""
        return len(self.plan.layers) + 2

    def brightness(self, colours: ColoursAtPoints) -> Float64:
        """Return about how bright (lobes, n) each is: what it sends straight into the mirror direction."""
        host, surface = self.plan.host_ior, self.surface
        cosine = in_host(self.view, host)[:, 2]
        crossed = coating_transmittance(host, self.view[:, 2]) ** 2
        sent = [
            crossed[:, None] * colours.reflected(number, cosine, cosine, cosine)
            for number in range(len(self.plan.layers))
        ]
        metal = np.zeros_like(surface.base_color)
        if np.any(surface.metallic > 0.0):
            metal = f_schlick(surface.base_color, cosine[:, None]) * colours.passed(cosine, cosine)
        sent.append((crossed * surface.metallic)[:, None] * metal)
        sent.append(np.repeat(coating_reflectance(host, self.view[:, 2])[:, None], 3, axis=1))
        # A channel of a colour beyond Rec.709 is below 0.
        return np.asarray(np.abs(np.stack(sent)).sum(axis=-1))

    def is_there(self) -> Mask:
        """Return which lobes (lobes, n) may send anything."""
        there = np.ones((self.count, len(self.view)), np.bool_)
        there[-2], there[-1] = self.surface.metallic > 0.0, self.plan.host_ior != 1.0
        return there

    def sent(self, number: int, rows: Rows, place: Float64) -> tuple[Float64, Float64]:
        """Return directions (k, 3) into which the lobe sends paths `rows`, and weights (k, 3).

        place : (k, 2) in the unit square. What would be mirrored down, or not get out of the host, weighs 0.
        """
        host, view = self.plan.host_ior, self.view[rows]
        if number == self.count - 1:
            mirrored_back = coating_reflectance(host, view[:, 2])
            return view * _TURNED, np.repeat(mirrored_back[:, None], 3, axis=1)
        here, seen = self.surface.take(rows), in_host(view, host)
        is_metal = number == len(self.plan.layers)
        alpha = (
            np.minimum(here.alpha_roughness, 1.0)
            if is_metal
            else np.full(len(rows), self.plan.layers[number].alpha)
        )
        facet = draw_facet(seen, alpha, alpha, place)
        inside = mirrored(seen, facet)
        direction, is_out = out_of_host(inside, host)
        direction[~is_out], inside[~is_out] = [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]
        cos_h = np.clip(np.sum(seen * facet, axis=1), 0.0, 1.0)
        cos_i, cos_o = np.minimum(inside[:, 2], 1.0), seen[:, 2]
        colours = self.method(here.bragg_period_texel)
        if is_metal:
            share = here.metallic[:, None] * f_schlick(here.base_color, cos_h[:, None])
            colour = share * colours.passed(cos_i, cos_o)
        else:
            colour = colours.reflected(number, cos_h, cos_i, cos_o)
        crossed = coating_transmittance(host, view[:, 2]) * coating_transmittance(host, direction[:, 2])
        return direction, np.asarray((is_out * crossed * g1_smith(cos_i, alpha))[:, None] * colour)
