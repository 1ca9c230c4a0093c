"""Whether a film is called for, and which of its textures.

A film without thickness or contrast changes nothing and is left out, except for the method `khr`: at an
interface without contrast the text still reflects at grazing angles, and its lower limit for the product of
the reflectances still draws fringes. To follow the text to the letter, `khr` draws such a film.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.planning.core import metal_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import Method
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict

__all__ = ["DRAWS_PHANTOM_FRINGES", "film_verdicts", "idle_film"]

# Methods under which a film without contrast or thickness is still to be seen.
DRAWS_PHANTOM_FRINGES: Final = frozenset({"khr"})

# KHR_materials_iridescence lets the film lie under air, also under a clearcoat.
_OUTSIDE_IOR: Final = 1.0


def film_verdicts(material: Material, method: Method) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on the film and on its two textures."""
    iridescence = material.iridescence
    if iridescence is None:
        for effect in (Effect.IRIDESCENCE, Effect.IRIDESCENCE_TEXTURE, Effect.IRIDESCENCE_THICKNESS_TEXTURE):
            yield effect, absent(Iridescence.EXTENSION)
        return
    film = _film(material, iridescence, method)
    yield Effect.IRIDESCENCE, film
    no_film = f"there is no film: {film.reason}" if film else None
    yield (
        Effect.IRIDESCENCE_TEXTURE,
        texture_verdict(iridescence.texture, "iridescence texture: the factor holds everywhere", no_film),
    )
    idle = no_film
    if iridescence.thickness_min_nm == iridescence.thickness_max_nm and not film:
        idle = f"minimum and maximum are both {iridescence.thickness_max_nm:g} nm, so it changes nothing"
    everywhere = f"thickness texture: the maximum, {iridescence.thickness_max_nm:g} nm, holds everywhere"
    yield (
        Effect.IRIDESCENCE_THICKNESS_TEXTURE,
        texture_verdict(iridescence.thickness_texture, everywhere, idle),
    )


def idle_film(material: Material) -> str | None:
    """Return why physics sees no film although its factor is above 0, or None where it does."""
    film = material.iridescence
    if film is None:
        return None
    if film.film_ior == _OUTSIDE_IOR:
        return "the film's index is the outside's, 1"
    thickest_nm = film.thickness_max_nm
    if film.thickness_texture is not None:
        thickest_nm = max(thickest_nm, film.thickness_min_nm)
    if thickest_nm == 0.0:
        return "the film's thickness is 0"
    if film.film_ior == (material.ior or Ior()).ior and _is_plain_dielectric(material):
        return f"the film's index is the base's, {film.film_ior:g}"
    return None


def _film(material: Material, iridescence: Iridescence, method: Method) -> Skip | None:
    if iridescence.factor == 0.0:
        texture = ", and its texture can only multiply it" if iridescence.texture else ""
        return Skip(f"the factor is 0{texture}")
    idle = idle_film(material)
    if idle is not None and method.name not in DRAWS_PHANTOM_FRINGES:
        return Skip(idle)
    return None


def _is_plain_dielectric(material: Material) -> bool:
    """True where the whole surface is a dielectric whose reflectance is that of its index."""
    return metal_verdict(material) is not None and material.specular in (None, Specular())
