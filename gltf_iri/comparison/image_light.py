"""What prefiltered image light becomes on a surface: the split sum, layer by layer."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.layer_light import SeenLayers, image_on_layers
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.optics.layering import CLEARCOAT_F0, transmitted_share
from gltf_iri.optics.sheen import sheen_weight
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.lobes import layered_reflectances
from gltf_iri.reference.surface import Surface

__all__ = ["image_light", "under_clearcoat"]

Float64 = NDArray[np.float64]


def image_light(
    surface: Surface,
    light: ImageLight,
    plan: MaterialPlan,
    filmed: tuple[Float64, Float64],
    seen: SeenLayers | None = None,
) -> Float64:
    """Return what n pixels send of the image light, (n, 3), without emission and clearcoat.

    Split sum (Karis 2013, "Real Shading in Unreal Engine 4"): what a lobe reflects of a white sky, times the
    light that reaches it; plain = F0·A + B, film = F·(A + B), with F at N·V or the mean over the facets. The
    base transmits what the interface does not reflect, colour by colour.

    Parameters
    ----------
    filmed : the film's reflectances F over the dielectric and over the metal, (n, 3) each.
    seen : the Bragg layers at each pixel's own cosine; None where there are none.
    """
    a, b = light.dfg_a[:, None], light.dfg_b[:, None]
    layers = layered_reflectances(
        surface,
        plan,
        (surface.dielectric_f0 * a + b, surface.base_color * a + b),
        ((a + b) * filmed[0], (a + b) * filmed[1]),
    )
    passes, m = surface.transmission[:, None], surface.metallic[:, None]
    scattered = layers.dielectric.base_weight[:, None] * light.irradiance
    transmitted = transmitted_share(layers.dielectric.specular) * light.transmitted_radiance
    base = surface.base_color * ((1.0 - passes) * scattered + passes * transmitted)
    reflected = (1.0 - m) * layers.dielectric.specular + m * layers.metal
    sent = (1.0 - m) * base + reflected * light.reflected_radiance
    if seen is not None:
        share = surface.bragg_factor[:, None]
        sent = (1.0 - share) * sent + share * image_on_layers(surface, light, plan, seen)
    return _under_sheen(surface, light, sent)


def _under_sheen(surface: Surface, light: ImageLight, sent: Float64) -> Float64:
    """Lay fibres over what is `sent`: they take the share of it that they reflect (KHR_materials_sheen)."""
    fibres = surface.sheen_color * light.sheen_albedo[:, None] * light.sheen_radiance
    return np.asarray(fibres + sheen_weight(surface.sheen_color, light.sheen_albedo)[:, None] * sent)


def under_clearcoat(surface: Surface, light: ImageLight, sent: Float64) -> Float64:
    """Lay the coat over what is `sent`, (n, 3), emission included (KHR_materials_clearcoat).

    It reflects R = clearcoat · (0.04·A + B) of its own light, and takes as much from what is below.
    """
    coat = surface.clearcoat * (CLEARCOAT_F0 * light.clearcoat_a + light.clearcoat_b)
    return np.asarray(sent + coat[:, None] * (light.clearcoat_radiance - sent))
