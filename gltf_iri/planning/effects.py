"""The effects that a material or a scene can call for, in the order the shader meets them.

An effect's name is what `plan --json` prints; its define is what the shader permutation sees. There are no
other spellings, so a misspelt feature cannot be silently left out.
"""

from __future__ import annotations

from enum import Enum
from typing import Final

__all__ = ["MATERIAL_EFFECTS", "SURROUNDINGS", "Effect"]


class Effect(Enum):
    """One thing that costs time and changes the picture."""

    # What the geometry and the scene bring.
    VERTEX_COLOR = "vertex-color"
    TANGENTS = "tangents"
    PUNCTUAL_LIGHTS = "punctual-lights"
    IMAGE_LIGHT = "image-light"

    # Core material.
    UNLIT = "unlit"
    BASE_COLOR_TEXTURE = "base-color-texture"
    ALPHA_MASK = "alpha-mask"
    ALPHA_BLEND = "alpha-blend"
    DOUBLE_SIDED = "double-sided"
    DIELECTRIC = "dielectric"
    METAL = "metal"
    METALLIC_ROUGHNESS_TEXTURE = "metallic-roughness-texture"
    NORMAL_TEXTURE = "normal-texture"
    OCCLUSION_TEXTURE = "occlusion-texture"
    EMISSION = "emission"
    EMISSIVE_TEXTURE = "emissive-texture"

    # Extensions.
    SPECULAR = "specular"
    SPECULAR_TEXTURE = "specular-texture"
    SPECULAR_COLOR_TEXTURE = "specular-color-texture"
    IRIDESCENCE = "iridescence"
    IRIDESCENCE_TEXTURE = "iridescence-texture"
    IRIDESCENCE_THICKNESS_TEXTURE = "iridescence-thickness-texture"
    IRIDESCENCE_THICKNESS_SPREAD = "iridescence-thickness-spread"
    BRAGG = "bragg"
    BRAGG_TEXTURE = "bragg-texture"
    BRAGG_PERIOD_TEXTURE = "bragg-period-texture"
    ANISOTROPY = "anisotropy"
    ANISOTROPY_TEXTURE = "anisotropy-texture"
    TRANSMISSION = "transmission"
    TRANSMISSION_TEXTURE = "transmission-texture"
    VOLUME = "volume"
    VOLUME_THICKNESS_TEXTURE = "volume-thickness-texture"
    DISPERSION = "dispersion"
    SHEEN = "sheen"
    SHEEN_COLOR_TEXTURE = "sheen-color-texture"
    SHEEN_ROUGHNESS_TEXTURE = "sheen-roughness-texture"
    CLEARCOAT = "clearcoat"
    CLEARCOAT_TEXTURE = "clearcoat-texture"
    CLEARCOAT_ROUGHNESS_TEXTURE = "clearcoat-roughness-texture"
    CLEARCOAT_NORMAL_TEXTURE = "clearcoat-normal-texture"

    @property
    def define(self) -> str:
        """The preprocessor symbol that switches the effect on in GLSL."""
        return "HAS_" + self.name


# Decided by the geometry and the lights; all others belong to the material.
SURROUNDINGS: Final = (Effect.VERTEX_COLOR, Effect.TANGENTS, Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT)
MATERIAL_EFFECTS: Final = tuple(effect for effect in Effect if effect not in SURROUNDINGS)
