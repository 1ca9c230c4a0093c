"""What prefiltered image light becomes on Bragg layers. Twin: shaders/lighting/bragg_image.glsl."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_lookup import ImageColours
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.optics.layer_stack import coating_transmittance
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.surface import Surface

__all__ = ["image_on_layers"]

Float64 = NDArray[np.float64]


def image_on_layers(surface: Surface, light: ImageLight, plan: LayersPlan, colours: ImageColours) -> Float64:
    """Return what n pixels of layers of factor 1 send of the image light, (n, 3).

    Each layer sends prefiltered radiance of its own lobe; what the base scatters and a metal mirrors passes
    them all.

    colours : what the layers make of image light, at the cosines of `n_dot_v` in the host.
    """
    sent = np.zeros_like(surface.base_color)
    for colour, radiance in zip(colours.layers, light.layer_radiance, strict=False):
        sent += colour * radiance
    if plan.under == "base":
        m, bent = surface.metallic[:, None], (plan.host_ior / plan.layers[-1].n1) ** 2
        metal = surface.base_color * colours.slope + colours.offset
        sent += m * metal * light.layer_metal_radiance
        sent += (1.0 - m) * surface.base_color * bent * colours.diffuse * light.irradiance
    if plan.host_ior == 1.0:
        return sent
    passed = coating_transmittance(plan.host_ior, surface.n_dot_v)[:, None]
    return np.asarray(passed * sent + (1.0 - passed) * light.layer_coating_radiance)
