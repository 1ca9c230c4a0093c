"""Which effects of the core material model are called for (glTF 2.0 §3.9)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.material import Material
from gltf_iri.material.unlit import Unlit
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict

__all__ = ["core_verdicts", "dielectric_verdict", "metal_verdict"]


def core_verdicts(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdict on each effect of the core material.

    folded : reasons for what `simplified` has taken out of it.
    """
    pbr = material.pbr
    yield Effect.UNLIT, None if material.unlit is not None else absent(Unlit.EXTENSION)
    effect = Effect.BASE_COLOR_TEXTURE
    idle = _idle_base_color(material)
    yield effect, texture_verdict(pbr.base_color_texture, "base color texture", idle, folded.get(effect))
    yield Effect.ALPHA_MASK, _alpha_mask(material)
    yield Effect.ALPHA_BLEND, None if material.alpha_mode == "BLEND" else _other_alpha_mode(material)
    single_sided = Skip("doubleSided is false", is_absent=True)
    yield Effect.DOUBLE_SIDED, None if material.double_sided else single_sided
    yield Effect.DIELECTRIC, dielectric_verdict(material, folded)
    yield Effect.METAL, metal_verdict(material, folded)
    effect = Effect.METALLIC_ROUGHNESS_TEXTURE
    is_idle = pbr.metallic_factor == 0.0 and pbr.roughness_factor == 0.0
    idle = "the metallic and the roughness factor are 0" if is_idle else None
    metallic_roughness = pbr.metallic_roughness_texture
    yield effect, texture_verdict(metallic_roughness, "metallic-roughness texture", idle, folded.get(effect))
    idle = "its scale is 0" if material.normal_texture and material.normal_texture.scale == 0.0 else None
    yield Effect.NORMAL_TEXTURE, texture_verdict(material.normal_texture, "normal texture", idle, None)
    effect = Effect.OCCLUSION_TEXTURE
    occlusion = material.occlusion_texture
    idle = "its strength is 0" if occlusion and occlusion.strength == 0.0 else None
    yield effect, texture_verdict(occlusion, "occlusion texture", idle, folded.get(effect))
    emission = _emission(material)
    yield Effect.EMISSION, emission
    effect = Effect.EMISSIVE_TEXTURE
    idle = emission.reason if emission else None
    yield effect, texture_verdict(material.emissive_texture, "emissive texture", idle, folded.get(effect))


def dielectric_verdict(material: Material, folded: Mapping[Effect, str]) -> Skip | None:
    """Judge the dielectric lobe: only a metallic factor of 1 that no texel lowers rules it out."""
    if Effect.DIELECTRIC in folded:
        return Skip(folded[Effect.DIELECTRIC])
    if material.pbr.metallic_factor == 1.0 and material.pbr.metallic_roughness_texture is None:
        return Skip("the metallic factor is 1 and no texture lowers it")
    return None


def metal_verdict(material: Material, folded: Mapping[Effect, str]) -> Skip | None:
    """Judge the metal lobe."""
    if material.pbr.metallic_factor == 0.0:
        return Skip(folded.get(Effect.METAL, "the metallic factor is 0"))
    return None


def _idle_base_color(material: Material) -> str | None:
    *colour, alpha = material.pbr.base_color_factor
    if any(colour) or (material.alpha_mode != "OPAQUE" and alpha):
        return None
    return "the base color factor is 0"


def _other_alpha_mode(material: Material) -> Skip:
    return Skip(f"the alpha mode is {material.alpha_mode}", is_absent=True)


def _alpha_mask(material: Material) -> Skip | None:
    if material.alpha_mode != "MASK":
        return _other_alpha_mode(material)
    if material.alpha_cutoff == 0.0:
        return Skip("the cutoff is 0, which no alpha falls below")
    return None


def _emission(material: Material) -> Skip | None:
    if not any(material.emissive_factor):
        mentioned = material.emissive_texture is not None or material.emissive_strength is not None
        return Skip("the emissive factor is 0", is_absent=not mentioned)
    if (material.emissive_strength or EmissiveStrength()).strength == 0.0:
        return Skip("the emissive strength is 0")
    return None
