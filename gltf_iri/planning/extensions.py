"""Which effects of the other material extensions are called for, and which of those are not drawn."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.core import dielectric_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.verdict import NotDrawn, Skip, Verdict, absent, texture_verdict

__all__ = ["extension_verdicts"]


def extension_verdicts(material: Material) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on specular and its textures, transmission, volume and clearcoat."""
    yield from _specular(material)
    transmission = _transmission(material)
    yield Effect.TRANSMISSION, transmission
    yield Effect.VOLUME, _volume(material, transmission)
    yield Effect.CLEARCOAT, _clearcoat(material)


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


def _transmission(material: Material) -> Verdict:
    if material.transmission is None:
        return absent(Transmission.EXTENSION)
    if material.transmission.factor == 0.0:
        return Skip("the transmission factor is 0")
    no_dielectric = dielectric_verdict(material)
    if no_dielectric:
        return Skip(f"only dielectrics transmit, and {no_dielectric.reason}")
    return NotDrawn("recognised, drawn as opaque")


def _volume(material: Material, transmission: Verdict) -> Verdict:
    if material.volume is None:
        return absent(Volume.EXTENSION)
    if material.volume.thickness_factor_m == 0.0:
        return Skip("the thickness is 0: a thin wall has no inside")
    if isinstance(transmission, Skip):
        return Skip(f"no light enters: {transmission.reason}")
    return NotDrawn("recognised, drawn as opaque: its inside is not to be seen")


def _clearcoat(material: Material) -> Verdict:
    if material.clearcoat is None:
        return absent(Clearcoat.EXTENSION)
    if material.clearcoat.factor == 0.0:
        return Skip("the clearcoat factor is 0")
    return NotDrawn("recognised, drawn without the coat")
