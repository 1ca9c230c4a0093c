"""What prefiltered image light becomes on a surface: the split sum, layer by layer, below a coat."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.optics.layering import Layer
from gltf_iri.reference.surface import Surface

__all__ = ["image_light"]

Float64 = NDArray[np.float64]
Layers = Callable[[Float64, Float64], tuple[Layer, Float64]]


def image_light(surface: Surface, light: ImageLight, layers: Layers) -> Float64:
    """Return what n pixels send of the image light, (n, 3), before emission and clearcoat.

    Split sum (Karis 2013, "Real Shading in Unreal Engine 4"): what a lobe reflects of a white sky, times the
    light that reaches it. The base transmits what it does not reflect, colour by colour.

    Parameters
    ----------
    layers : maps the split sum's A and B, (n, 1), to the dielectric's layer and the metal's reflectance.
    """
    dielectric, metal = layers(light.dfg_a[:, None], light.dfg_b[:, None])
    passes = surface.transmission[:, None]
    scattered = dielectric.base_weight[:, None] * light.irradiance
    transmitted = np.clip(1.0 - dielectric.specular, 0.0, 1.0) * light.transmitted_radiance
    base = surface.base_color * ((1.0 - passes) * scattered + passes * transmitted)
    share = surface.metallic[:, None]
    sent = (1.0 - share) * (base + dielectric.specular * light.reflected_radiance)
    sent = sent + share * metal * light.reflected_radiance
    return _under_sheen(surface, light, sent)


def _under_sheen(surface: Surface, light: ImageLight, sent: Float64) -> Float64:
    """Lay fibres over what is `sent`: they take the share of it that they reflect (KHR_materials_sheen)."""
    albedo = light.sheen_albedo[:, None]
    kept = 1.0 - surface.sheen_color.max(axis=-1, keepdims=True) * albedo
    return np.asarray(surface.sheen_color * albedo * light.sheen_radiance + kept * sent)
