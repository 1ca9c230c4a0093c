"""How a film's reflection is mixed into a metal and laid over a dielectric base.

The functions take reflectances, not BRDFs: multiply `specular` by the facets' D·V for a punctual light, or by
the mirrored radiance for image light, and `base_weight` by what the base sends back. For image light
`plain` = F0·A + B and `film` = F·(A + B), with A and B the two terms of the DFG table. Sources:
KHR_materials_iridescence, Implementation Notes; KHR_materials_specular, Implementation; glTF 2.0 Appendix
B.2. Twin: shaders/material/layering.glsl. Colours are (..., 3), everything else (...).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.fresnel import f_schlick

__all__ = [
    "CLEARCOAT_F0",
    "Layer",
    "conductor_fresnel",
    "fresnel_mix",
    "iridescent_conductor_layer",
    "iridescent_dielectric_layer",
    "iridescent_dielectric_layer_specular",
    "rgb_mix",
    "transmitted_share",
]

Float64 = NDArray[np.float64]

# Of a varnish of index 1.5 under air (KHR_materials_clearcoat).
CLEARCOAT_F0: Final = 0.04


@dataclass(frozen=True, slots=True)
class Layer:
    """A reflecting layer over a base.

    specular : (..., 3) reflectance of the layer.
    base_weight : (...) share of the light that reaches the base and comes back.
    """

    specular: Float64
    base_weight: Float64


def conductor_fresnel(f0: ArrayLike, v_dot_h: ArrayLike) -> Float64:
    """Reflectance (..., 3) of a bare metal: F0 + (1 − F0)(1 − |V·H|)⁵, glTF 2.0 Appendix B.3.4."""
    return f_schlick(np.asarray(f0, np.float64), np.abs(_per_channel(v_dot_h)))


def fresnel_mix(fresnel: ArrayLike) -> Layer:
    """A colourless layer of reflectance `fresnel` (...): base · (1 − F) + F, glTF 2.0 Appendix B.3.4."""
    grey = np.asarray(fresnel, np.float64)
    return Layer(grey[..., None] * np.ones(3), 1.0 - grey)


def rgb_mix(reflectance: ArrayLike) -> Layer:
    """A coloured layer: base · (1 − max(R, G, B)) + colour.

    The base is weighted by the brightest channel: 1 − colour would tint it with the opposite hue.
    """
    colour = np.asarray(reflectance, np.float64)
    return Layer(colour, 1.0 - np.max(colour, axis=-1))


def transmitted_share(reflectance: ArrayLike) -> Float64:
    """Share T (..., 3) of the light that passes a surface of reflectance R (..., 3): clamp(1 − R, 0, 1).

    What is reflected is not transmitted, colour by colour: R + T = 1 in every channel where R lies in [0, 1].
    The diffuse base keeps `rgb_mix`'s one weight for all. `khr` may give R beyond 1, where 1 − R would take
    light away from behind, and a true colour outside Rec.709 has a channel below 0, where it would add some.
    """
    return np.clip(1.0 - np.asarray(reflectance, np.float64), 0.0, 1.0)


def iridescent_conductor_layer(strength: ArrayLike, plain: ArrayLike, film: ArrayLike) -> Float64:
    """Reflectance (..., 3) of a metal under a film of the given strength: mix(plain, film, strength)."""
    return _mix(np.asarray(plain, np.float64), np.asarray(film, np.float64), _per_channel(strength))


def iridescent_dielectric_layer(strength: ArrayLike, plain: ArrayLike, film: ArrayLike) -> Layer:
    """A dielectric without KHR_materials_specular: bare and filmed surface are layered first, then mixed."""
    bare, filmed = rgb_mix(plain), rgb_mix(film)
    share = np.asarray(strength, np.float64)
    return Layer(
        _mix(bare.specular, filmed.specular, share[..., None]),
        _mix(bare.base_weight, filmed.base_weight, share),
    )


def iridescent_dielectric_layer_specular(
    strength: ArrayLike, specular_weight: ArrayLike, plain: ArrayLike, film: ArrayLike
) -> Layer:
    """A dielectric with KHR_materials_specular: the reflectances are mixed, then layered once.

    `specular_weight` multiplies the bare reflectance only; in the film's it is part of the base's F0.
    """
    weighted = _per_channel(specular_weight) * np.asarray(plain, np.float64)
    return rgb_mix(_mix(weighted, np.asarray(film, np.float64), _per_channel(strength)))


def _per_channel(scalar: ArrayLike) -> Float64:
    return np.asarray(np.asarray(scalar, np.float64)[..., None])


def _mix(a: Float64, b: Float64, share: Float64) -> Float64:
    return np.asarray(a * (1.0 - share) + b * share)
