"""Which effects of the surface's extensions are called for: specular, anisotropy, sheen, clearcoat."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.material import Material
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.planning.core import dielectric_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict

__all__ = ["extension_verdicts"]


def extension_verdicts(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on specular, anisotropy, sheen, clearcoat, and on their textures."""
    for judge in (_specular, _anisotropy, _sheen, _clearcoat):
        yield from judge(material, folded)


def _specular(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    specular = material.specular
    if specular is None:
        for effect in (Effect.SPECULAR, Effect.SPECULAR_TEXTURE, Effect.SPECULAR_COLOR_TEXTURE):
            yield effect, absent(Specular.EXTENSION)
        return
    no_dielectric = dielectric_verdict(material, folded)
    idle = f"only dielectrics read it, and {no_dielectric.reason}" if no_dielectric else None
    neutral = specular == Specular()
    yield (
        Effect.SPECULAR,
        Skip(idle) if idle else Skip("weight 1 and a white tint change nothing") if neutral else None,
    )
    if specular.factor == 0.0:
        idle = idle or "the specular factor is 0"
    effect = Effect.SPECULAR_TEXTURE
    yield effect, texture_verdict(specular.texture, "specular texture", idle, folded.get(effect))
    if not any(specular.color_factor):
        idle = idle or "the specular color factor is 0"
    effect = Effect.SPECULAR_COLOR_TEXTURE
    yield effect, texture_verdict(specular.color_texture, "specular color texture", idle, folded.get(effect))


def _anisotropy(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    anisotropy = material.anisotropy
    if anisotropy is None:
        for effect in (Effect.ANISOTROPY, Effect.ANISOTROPY_TEXTURE):
            yield effect, absent(Anisotropy.EXTENSION)
        return
    idle = "the anisotropy strength is 0" if anisotropy.strength == 0.0 else None
    yield Effect.ANISOTROPY, Skip(idle) if idle else None
    effect = Effect.ANISOTROPY_TEXTURE
    yield effect, texture_verdict(anisotropy.texture, "anisotropy texture", idle, folded.get(effect))


def _sheen(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    sheen = material.sheen
    if sheen is None:
        for effect in (Effect.SHEEN, Effect.SHEEN_COLOR_TEXTURE, Effect.SHEEN_ROUGHNESS_TEXTURE):
            yield effect, absent(Sheen.EXTENSION)
        return
    idle = None if any(sheen.color_factor) else "the sheen color factor is 0"
    yield Effect.SHEEN, Skip(idle) if idle else None
    effect = Effect.SHEEN_COLOR_TEXTURE
    yield effect, texture_verdict(sheen.color_texture, "sheen color texture", idle, folded.get(effect))
    if sheen.roughness_factor == 0.0:
        idle = idle or "the sheen roughness factor is 0"
    effect = Effect.SHEEN_ROUGHNESS_TEXTURE
    roughness = sheen.roughness_texture
    yield effect, texture_verdict(roughness, "sheen roughness texture", idle, folded.get(effect))


def _clearcoat(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    coat = material.clearcoat
    if coat is None:
        for effect in (
            Effect.CLEARCOAT,
            Effect.CLEARCOAT_TEXTURE,
            Effect.CLEARCOAT_ROUGHNESS_TEXTURE,
            Effect.CLEARCOAT_NORMAL_TEXTURE,
        ):
            yield effect, absent(Clearcoat.EXTENSION)
        return
    none = "the clearcoat factor is 0" if coat.factor == 0.0 else None
    yield Effect.CLEARCOAT, Skip(none) if none else None
    effect = Effect.CLEARCOAT_TEXTURE
    yield effect, texture_verdict(coat.texture, "clearcoat texture", none, folded.get(effect))
    idle = none or ("the clearcoat roughness factor is 0" if coat.roughness_factor == 0.0 else None)
    effect = Effect.CLEARCOAT_ROUGHNESS_TEXTURE
    roughness = coat.roughness_texture
    yield effect, texture_verdict(roughness, "clearcoat roughness texture", idle, folded.get(effect))
    idle = none or ("its scale is 0" if coat.normal_texture and coat.normal_texture.scale == 0.0 else None)
    normals = texture_verdict(coat.normal_texture, "clearcoat normal texture", idle, None)
    yield Effect.CLEARCOAT_NORMAL_TEXTURE, normals
