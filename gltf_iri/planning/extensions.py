"""Which effects of the surface's extensions are called for: specular, anisotropy, sheen, clearcoat."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.material import Material
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.planning.core import dielectric_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict

__all__ = ["extension_verdicts"]


def extension_verdicts(material: Material) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on specular, anisotropy, sheen, clearcoat, and on their textures."""
    yield from _specular(material)
    yield from _anisotropy(material)
    yield from _sheen(material)
    yield from _clearcoat(material)


def _specular(material: Material) -> Iterator[tuple[Effect, Verdict]]:
    specular = material.specular
    if specular is None:
        for effect in (Effect.SPECULAR, Effect.SPECULAR_TEXTURE, Effect.SPECULAR_COLOR_TEXTURE):
            yield effect, absent(Specular.EXTENSION)
        return
    no_dielectric = dielectric_verdict(material)
    idle = f"only dielectrics read it, and {no_dielectric.reason}" if no_dielectric else None
    neutral = specular == Specular()
    yield (
        Effect.SPECULAR,
        Skip(idle) if idle else Skip("weight 1 and a white tint change nothing") if neutral else None,
    )
    if specular.factor == 0.0:
        idle = idle or "the specular factor is 0"
    yield Effect.SPECULAR_TEXTURE, texture_verdict(specular.texture, "specular texture", idle)
    if not any(specular.color_factor):
        idle = idle or "the specular color factor is 0"
    yield (
        Effect.SPECULAR_COLOR_TEXTURE,
        texture_verdict(specular.color_texture, "specular color texture", idle),
    )


def _anisotropy(material: Material) -> Iterator[tuple[Effect, Verdict]]:
    anisotropy = material.anisotropy
    if anisotropy is None:
        for effect in (Effect.ANISOTROPY, Effect.ANISOTROPY_TEXTURE):
            yield effect, absent(Anisotropy.EXTENSION)
        return
    idle = "the anisotropy strength is 0" if anisotropy.strength == 0.0 else None
    yield Effect.ANISOTROPY, Skip(idle) if idle else None
    yield Effect.ANISOTROPY_TEXTURE, texture_verdict(anisotropy.texture, "anisotropy texture", idle)


def _sheen(material: Material) -> Iterator[tuple[Effect, Verdict]]:
    sheen = material.sheen
    if sheen is None:
        for effect in (Effect.SHEEN, Effect.SHEEN_COLOR_TEXTURE, Effect.SHEEN_ROUGHNESS_TEXTURE):
            yield effect, absent(Sheen.EXTENSION)
        return
    idle = None if any(sheen.color_factor) else "the sheen color factor is 0"
    yield Effect.SHEEN, Skip(idle) if idle else None
    yield Effect.SHEEN_COLOR_TEXTURE, texture_verdict(sheen.color_texture, "sheen color texture", idle)
    if sheen.roughness_factor == 0.0:
        idle = idle or "the sheen roughness factor is 0"
    yield (
        Effect.SHEEN_ROUGHNESS_TEXTURE,
        texture_verdict(sheen.roughness_texture, "sheen roughness texture", idle),
    )


def _clearcoat(material: Material) -> Iterator[tuple[Effect, Verdict]]:
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
    yield Effect.CLEARCOAT_TEXTURE, texture_verdict(coat.texture, "clearcoat texture", none)
    idle = none or ("the clearcoat roughness factor is 0" if coat.roughness_factor == 0.0 else None)
    yield (
        Effect.CLEARCOAT_ROUGHNESS_TEXTURE,
        texture_verdict(coat.roughness_texture, "clearcoat roughness texture", idle),
    )
    idle = none or ("its scale is 0" if coat.normal_texture and coat.normal_texture.scale == 0.0 else None)
    yield (
        Effect.CLEARCOAT_NORMAL_TEXTURE,
        texture_verdict(coat.normal_texture, "clearcoat normal texture", idle),
    )
