"""A glTF material whole: the core's metallic-roughness model and the extensions that change it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.fields import choice, extension, flag, nested, number, text, texture_info, vector
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume

__all__ = ["DEFAULT_MATERIAL", "SPECULAR_GLOSSINESS", "Material", "MetallicRoughness"]

# Stands where an index is wanted for the material of primitives that name none.
DEFAULT_MATERIAL: Final = -1

# Not read, but excluded by extensions that are.
SPECULAR_GLOSSINESS: Final = "KHR_materials_pbrSpecularGlossiness"


@dataclass(frozen=True, slots=True)
class MetallicRoughness:
    """pbrMetallicRoughness, glTF 2.0 §3.9.2."""

    base_color_factor: tuple[float, float, float, float] = vector(
        "baseColorFactor", (1.0, 1.0, 1.0, 1.0), "Base colour.", low=0.0, high=1.0, colour_space="linear"
    )
    base_color_texture: TextureInfo | None = texture_info(
        "baseColorTexture", TextureInfo, "Multiplies the base colour.", channels="rgba", colour_space="srgb"
    )
    metallic_factor: float = number("metallicFactor", 1.0, "0 dielectric, 1 metal.", low=0.0, high=1.0)
    roughness_factor: float = number("roughnessFactor", 1.0, "Perceptual roughness.", low=0.0, high=1.0)
    metallic_roughness_texture: TextureInfo | None = texture_info(
        "metallicRoughnessTexture",
        TextureInfo,
        "Multiplies roughness (G) and metalness (B).",
        channels="gb",
        colour_space="linear",
    )


@dataclass(frozen=True, slots=True)
class Material:
    """One entry of glTF's ``materials``; the defaults are glTF's default material."""

    POINTER: ClassVar[str] = "/materials"

    name: str = text("name", "", "Name for people.")
    pbr: MetallicRoughness = nested("pbrMetallicRoughness", MetallicRoughness, "Metallic-roughness model.")
    normal_texture: NormalTextureInfo | None = texture_info(
        "normalTexture", NormalTextureInfo, "Tangent-space normals.", channels="rgb", colour_space="linear"
    )
    occlusion_texture: OcclusionTextureInfo | None = texture_info(
        "occlusionTexture", OcclusionTextureInfo, "Ambient occlusion.", channels="r", colour_space="linear"
    )
    emissive_texture: TextureInfo | None = texture_info(
        "emissiveTexture", TextureInfo, "Multiplies the emission.", channels="rgb", colour_space="srgb"
    )
    emissive_factor: tuple[float, float, float] = vector(
        "emissiveFactor", (0.0, 0.0, 0.0), "Emitted light.", low=0.0, high=1.0, colour_space="linear"
    )
    alpha_mode: str = choice("alphaMode", "OPAQUE", ("OPAQUE", "MASK", "BLEND"), "Meaning of alpha.")
    alpha_cutoff: float = number("alphaCutoff", 0.5, "Threshold of MASK.", low=0.0)
    double_sided: bool = flag("doubleSided", False, "Back faces are drawn and lit.")

    ior: Ior | None = extension(Ior, "Refractive index of the base.")
    specular: Specular | None = extension(Specular, "Weight and tint of the dielectric reflection.")
    iridescence: Iridescence | None = extension(Iridescence, "A thin film.")
    bragg: Bragg | None = extension(Bragg, "Layers of Bragg mirrors.")
    emissive_strength: EmissiveStrength | None = extension(EmissiveStrength, "Emission beyond 1.")
    unlit: Unlit | None = extension(Unlit, "No lighting.")
    transmission: Transmission | None = extension(Transmission, "Light passes through.")
    volume: Volume | None = extension(Volume, "What is inside.")
    dispersion: Dispersion | None = extension(Dispersion, "Colours that are bent differently.")
    clearcoat: Clearcoat | None = extension(Clearcoat, "A varnish.")
    sheen: Sheen | None = extension(Sheen, "Fibres of a cloth.")
    anisotropy: Anisotropy | None = extension(Anisotropy, "Highlights drawn out in one direction.")

    unread_extensions: tuple[str, ...] = ()  # present in the file, unknown to this program
