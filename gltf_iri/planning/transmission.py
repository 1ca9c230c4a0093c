"""Which effects of light that passes through a material are called for: transmission, volume, dispersion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.core import dielectric_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict

__all__ = ["transmission_verdicts"]


def transmission_verdicts(
    material: Material, folded: Mapping[Effect, str]
) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on transmission, volume and dispersion, and on their textures."""
    transmission = _transmission(material, folded)
    yield Effect.TRANSMISSION, transmission
    effect = Effect.TRANSMISSION_TEXTURE
    info = material.transmission.texture if material.transmission else None
    idle = transmission.reason if transmission else None
    yield effect, texture_verdict(info, "transmission texture", idle, folded.get(effect))
    volume = _volume(material, transmission)
    yield Effect.VOLUME, volume
    effect = Effect.VOLUME_THICKNESS_TEXTURE
    info = material.volume.thickness_texture if material.volume else None
    idle = volume.reason if volume else None
    yield effect, texture_verdict(info, "thickness texture", idle, folded.get(effect))
    yield Effect.DISPERSION, _dispersion(material, volume)


def _transmission(material: Material, folded: Mapping[Effect, str]) -> Skip | None:
    if material.transmission is None:
        return absent(Transmission.EXTENSION)
    if material.transmission.factor == 0.0:
        return Skip("the transmission factor is 0")
    no_dielectric = dielectric_verdict(material, folded)
    if no_dielectric:
        return Skip(f"only dielectrics transmit, and {no_dielectric.reason}")
    if (material.ior or Ior()).ior == 0.0:
        return Skip("an index of 0 stands for a mirror, which lets nothing through")
    return None


def _volume(material: Material, transmission: Skip | None) -> Skip | None:
    if material.volume is None:
        return absent(Volume.EXTENSION)
    if material.volume.thickness_factor_m == 0.0:
        return Skip("the thickness is 0: a thin wall has no inside")
    if transmission is not None:
        return Skip(f"no light enters: {transmission.reason}")
    return None


def _dispersion(material: Material, volume: Skip | None) -> Verdict:
    if material.dispersion is None:
        return absent(Dispersion.EXTENSION)
    if material.dispersion.dispersion == 0.0:
        return Skip("the dispersion is 0")
    if volume is not None:
        return Skip(f"no light is bent: {volume.reason}")
    return None
