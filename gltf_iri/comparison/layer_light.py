"""What prefiltered image light becomes on Bragg layers. Twin: shaders/lighting/bragg_image.glsl."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_lookup import ImageColours
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.surface import Surface

__all__ = ["image_on_layers"]

Float64 = NDArray[np.float64]

_GAUSS_POINTS = 64


def image_on_layers(surface: Surface, light: ImageLight, plan: LayersPlan, colours: ImageColours) -> Float64:
    """Return what n pixels of layers of factor 1 send of the image light, (n, 3).

    Each layer sends prefiltered radiance of its own lobe; what the base scatters and a metal mirrors passes
    them all. What is mirrored leaves the coating as it came, so that bending takes nothing from it; what is
    scattered fills the host.

    colours : what the layers make of image light, at the cosines of `n_dot_v` in the host.
    """
    sent = np.zeros_like(surface.base_color)
    for colour, radiance in zip(colours.layers, light.layer_radiance, strict=False):
        sent += colour * radiance
    scattered = np.zeros_like(sent)
    if plan.under == "base":
        m = surface.metallic[:, None]
        sent += m * colours.metal * _metal(surface, light, plan.host_ior) * light.layer_metal_radiance
        bent = (plan.host_ior / plan.layers[-1].n1) ** 2
        scattered = (1.0 - m) * surface.base_color * bent * colours.diffuse * light.irradiance
    if plan.host_ior == 1.0:
        return np.asarray(sent + scattered)
    passed = coating_transmittance(plan.host_ior, surface.n_dot_v)[:, None]
    entering = _entering(plan.host_ior) / plan.host_ior**2
    through = passed * (passed * sent + entering * scattered)
    return np.asarray(through + (1.0 - passed) * light.layer_coating_radiance)


def _metal(surface: Surface, light: ImageLight, host_ior: float) -> Float64:
    a, b = light.dfg_a, light.dfg_b
    if host_ior != 1.0:  # seen from within the host
        a, b = dfg_terms(cosine_in_host(host_ior, surface.n_dot_v), surface.perceptual_roughness)
    return np.asarray(surface.base_color * a[:, None] + b[:, None])


@cache
def _entering(host_ior: float) -> float:
    """Return 2∫ T c dc, what of a white sky enters the host."""
    nodes, weights = gauss_unit(_GAUSS_POINTS)
    return 2.0 * float(np.sum(weights * nodes * coating_transmittance(host_ior, nodes)))
