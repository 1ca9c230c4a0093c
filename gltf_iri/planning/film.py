"""Whether a film is called for, and which of its textures.

A film without thickness or contrast changes nothing and is left out, except for the method `khr`: at an
interface without contrast the text still reflects at grazing angles, and its lower limit for the product of
the reflectances still draws fringes. To follow the text to the letter, `khr` draws such a film.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import Method
from gltf_iri.planning.reach import Reach, Span
from gltf_iri.planning.spread import spread_verdict
from gltf_iri.planning.verdict import Skip, Verdict, absent, texture_verdict
from gltf_iri.planning.way import Way

__all__ = ["DRAWS_PHANTOM_FRINGES", "film_verdicts", "idle_film", "verdicts_without_film"]

# Methods under which a film without contrast or thickness is still to be seen.
DRAWS_PHANTOM_FRINGES: Final = frozenset({"khr"})

_EFFECTS: Final = (
    Effect.IRIDESCENCE,
    Effect.IRIDESCENCE_TEXTURE,
    Effect.IRIDESCENCE_THICKNESS_TEXTURE,
    Effect.IRIDESCENCE_THICKNESS_SPREAD,
)

# KHR_materials_iridescence lets the film lie under air, also under a clearcoat.
_OUTSIDE_IOR: Final = 1.0


def film_verdicts(
    material: Material, method: Method, reach: Reach | None, way: Way | None, folded: Mapping[Effect, str]
) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on the film, on its two textures and on the spread of its thickness.

    reach : what the film meets; None where the textures may hold anything.
    way : how the film is computed; None for the method itself.
    folded : reasons for what `simplified` has taken out of `material`.
    """
    iridescence = material.iridescence
    if iridescence is None:
        for effect in _EFFECTS:
            yield effect, absent(Iridescence.EXTENSION)
        return
    film = _film(material, iridescence, method, reach)
    if film is not None:
        yield from verdicts_without_film(iridescence, film, folded)
        return
    yield Effect.IRIDESCENCE, None
    textures = _textures(iridescence, None, _idle_thickness(iridescence), folded)
    yield from textures.items()
    thickness = textures[Effect.IRIDESCENCE_THICKNESS_TEXTURE]
    yield Effect.IRIDESCENCE_THICKNESS_SPREAD, spread_verdict(thickness, method, reach, way)


def verdicts_without_film(
    iridescence: Iridescence, film: Skip, folded: Mapping[Effect, str]
) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts where the film is left out for the reason `film`."""
    yield Effect.IRIDESCENCE, film
    reason = f"there is no film: {film.reason}"
    textures = _textures(iridescence, reason, reason, folded)
    yield from textures.items()
    yield Effect.IRIDESCENCE_THICKNESS_SPREAD, textures[Effect.IRIDESCENCE_THICKNESS_TEXTURE]


def idle_film(material: Material, reach: Reach | None) -> str | None:
    """Return why physics sees no film although its factor is above 0, or None where it does."""
    film = material.iridescence
    if film is None:
        return None
    if film.film_ior == _OUTSIDE_IOR:
        return "the film's index is the outside's, 1"
    if _greatest_thickness_nm(film, reach) == 0.0:
        return "the film's thickness is 0"
    if _is_of_the_base(film, material, reach):
        return f"the film's index is the base's, {film.film_ior:g}"
    return None


def _textures(
    iridescence: Iridescence, idle: str | None, idle_thickness: str | None, folded: Mapping[Effect, str]
) -> dict[Effect, Verdict]:
    strength, thickness = Effect.IRIDESCENCE_TEXTURE, Effect.IRIDESCENCE_THICKNESS_TEXTURE
    everywhere = "iridescence texture: the factor holds everywhere"
    of_strength = texture_verdict(iridescence.texture, everywhere, idle, folded.get(strength))
    everywhere = f"thickness texture: the maximum, {iridescence.thickness_max_nm:g} nm, holds everywhere"
    of_thickness = texture_verdict(
        iridescence.thickness_texture, everywhere, idle_thickness, folded.get(thickness)
    )
    return {strength: of_strength, thickness: of_thickness}


def _idle_thickness(iridescence: Iridescence) -> str | None:
    if iridescence.thickness_min_nm != iridescence.thickness_max_nm:
        return None
    return f"minimum and maximum are both {iridescence.thickness_max_nm:g} nm, so it changes nothing"


def _film(material: Material, iridescence: Iridescence, method: Method, reach: Reach | None) -> Skip | None:
    if iridescence.factor == 0.0:
        texture = ", and its texture can only multiply it" if iridescence.texture else ""
        return Skip(f"the factor is 0{texture}")
    idle = idle_film(material, reach)
    if idle is not None and method.name not in DRAWS_PHANTOM_FRINGES:
        return Skip(idle)
    return None


def _greatest_thickness_nm(film: Iridescence, reach: Reach | None) -> float:
    if reach is not None:
        return reach.thickness_nm.high
    if film.thickness_texture is not None:
        return max(film.thickness_max_nm, film.thickness_min_nm)
    return film.thickness_max_nm


def _is_of_the_base(film: Iridescence, material: Material, reach: Reach | None) -> bool:
    """True where every base that the film lies on reflects as a half-space of the film would."""
    base = Ior(film.film_ior).f0
    if reach is None:
        is_plain = material.specular in (None, Specular())
        return material.pbr.metallic_factor == 0.0 and is_plain and (material.ior or Ior()).f0 == base
    met: list[Span] = []
    if reach.metallic.low < 1.0:
        met += reach.dielectric_f0
    if reach.metallic.high > 0.0:
        met += reach.base_color
    return all(span == Span.at(base) for span in met)
