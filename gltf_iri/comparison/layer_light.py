"""What prefiltered image light, and light from behind, become on Bragg layers.

Twins: shaders/lighting/bragg_image.glsl, and bragg_through.glsl of what lies below them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_lookup import ImageColours
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.layers_on import LayersMethod
from gltf_iri.reference.surface import Surface

__all__ = ["SeenLayers", "image_on_layers", "seen_layers"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SeenLayers:
    """The colours of the layers at n pixels, at the viewer's own cosine in the host.

    colours : (n, k, 3) of each layer, light and viewer both there; over a base also of what passes them all
        both ways, and where that lets light through of what crosses them all once.
    image : what they make of image light. entering : (n, 3), the last of `colours`; None where nothing comes
        from behind.
    """

    colours: Float64
    image: ImageColours
    entering: Float64 | None


def seen_layers(surface: Surface, plan: MaterialPlan, method: LayersMethod) -> SeenLayers | None:
    """Return the layers of `plan` as `surface` shows them; None where it has none."""
    layers = plan.layers
    if layers is None:
        return None
    at_pixels = method(surface.bragg_period_texel)
    cosine = cosine_in_host(layers.host_ior, surface.n_dot_v)
    own = [at_pixels.reflected(number, cosine, cosine, cosine) for number in range(len(layers.layers))]
    entering = None
    if layers.under == "base":
        own.append(at_pixels.passed(cosine, cosine))
        if plan.calls_for(Effect.TRANSMISSION):
            entering = at_pixels.entering(cosine)
            own.append(entering)
    image = at_pixels.image(cosine, surface.perceptual_roughness)
    return SeenLayers(np.stack(own, axis=1), image, entering)


def image_on_layers(surface: Surface, light: ImageLight, plan: MaterialPlan, seen: SeenLayers) -> Float64:
    """Return what n pixels of layers of factor 1 send of the image light and from behind, (n, 3).

    Each layer sends prefiltered radiance of its own lobe. What the base scatters and a metal mirrors passes
    them all on both ways, what the base lets through on one: it has no interface of its own here.
    """
    layers, colours = plan.layers, seen.image
    sent = np.zeros_like(surface.base_color)
    if layers is None:
        return sent
    for colour, radiance in zip(colours.layers, light.layer_radiance, strict=False):
        sent += colour * radiance
    if layers.under == "base":
        m, passes = surface.metallic[:, None], surface.transmission[:, None]
        bent = (layers.host_ior / layers.layers[-1].n1) ** 2
        below = (1.0 - passes) * bent * colours.diffuse * light.irradiance
        if seen.entering is not None:
            below += passes * seen.entering * light.transmitted_radiance
        metal = surface.base_color * colours.slope + colours.offset
        sent += m * metal * light.layer_metal_radiance + (1.0 - m) * surface.base_color * below
    if layers.host_ior == 1.0:
        return sent
    passed = coating_transmittance(layers.host_ior, surface.n_dot_v)[:, None]
    return np.asarray(passed * sent + (1.0 - passed) * light.layer_coating_radiance)
