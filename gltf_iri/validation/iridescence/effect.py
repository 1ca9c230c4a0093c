"""Films that do nothing, or cannot be seen: no strength, no contrast, no thickness, too much of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.iridescence.film import Film
    from gltf_iri.validation.issue import Issue

__all__ = ["COHERENCE_NM", "effect_of"]

# Straight on, ΔE to the mean over all phases stays below 1 from this path difference on: of 1,500 random
# films, index 1.05 to 4, base F0 0 to 0.98, grey and coloured, the last that passes 1 does so at 6.4 µm.
COHERENCE_NM = 6500.0

# Two or three atoms: no film of matter is thinner, and 0.4 for 0.4 µm is.
_TINY_NM = 1.0

# A millimetre.
_ABSURD_NM = 1e6

# Above all that is transparent to visible light.
_ABSURD_IOR = 4.0


def effect_of(film: Film) -> Iterator[Issue]:
    """Yield what keeps the film from being seen."""
    if not film.is_active:
        yield _without_factor(film)
        return
    if "iridescenceIor" not in film.moved:
        yield from _index(film)
    if film.has_steady_thickness:
        yield from _thickness(film)


def _without_factor(film: Film) -> Issue:
    given = "0" if "iridescenceFactor" in film.extension else "left out, which means 0"
    settings = [key for key in film.extension if key != "iridescenceFactor"]
    place = film.at("iridescenceFactor")
    if not settings:
        return issue("IRI_IRIDESCENCE_IDLE", place, given=given)
    return issue("IRI_IRIDESCENCE_FACTOR_ZERO", place, given=given, settings=", ".join(settings))


def _index(film: Film) -> Iterator[Issue]:
    place = film.at("iridescenceIor")
    matched = [base for base in film.bases if base.has_index(film.ior)]
    if film.is_under_air:
        yield issue("IRI_IRIDESCENCE_FILM_IS_AIR", place)
    elif matched and len(matched) == len(film.bases):
        lobes = " and ".join(base.lobe for base in matched)
        yield issue("IRI_IRIDESCENCE_FILM_IS_BASE", place, ior=film.ior, lobe=lobes)
    elif any(base.lobe == "a dielectric" for base in matched):
        yield issue("IRI_IRIDESCENCE_FILM_IS_DIELECTRIC", place, ior=film.ior)
    elif film.ior > _ABSURD_IOR:
        yield issue("IRI_IRIDESCENCE_IOR_ABSURD", place, ior=film.ior)


def _thickness(film: Film) -> Iterator[Issue]:
    is_least = film.minimum_nm > film.maximum_nm
    place = film.at(
        "iridescenceThicknessMinimum" if is_least and film.thickness else "iridescenceThicknessMaximum"
    )
    if film.greatest_nm == 0.0:
        yield issue("IRI_IRIDESCENCE_THICKNESS_ZERO", place)
    elif film.greatest_nm < _TINY_NM:
        yield issue("IRI_IRIDESCENCE_THICKNESS_TINY", place, nm=film.greatest_nm)
    elif film.greatest_nm > _ABSURD_NM:
        yield issue("IRI_IRIDESCENCE_THICKNESS_ABSURD", place, mm=film.greatest_nm / _ABSURD_NM)
    elif film.ior <= _ABSURD_IOR and 2.0 * film.ior * film.least_nm > COHERENCE_NM:
        yield issue("IRI_IRIDESCENCE_THICKNESS_INCOHERENT", place, nm=COHERENCE_NM / (2.0 * film.ior))
    if film.minimum_nm > film.maximum_nm and film.thickness is not None:
        told = {"minimum": film.minimum_nm, "maximum": film.maximum_nm}
        yield issue("IRI_IRIDESCENCE_MINIMUM_ABOVE_MAXIMUM", film.at("iridescenceThicknessMinimum"), **told)
