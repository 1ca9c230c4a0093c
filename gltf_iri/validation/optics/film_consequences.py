"""What each remark about a film means for its colours: one more sentence, measured.

ΔE is CIEDE2000 under D65, the largest from straight on to 78° of what the film and its bases can be by the
file's numbers. Film and base are exact interfaces; "to the letter" is the text's own formula.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from gltf_iri.errors import UsageError
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.validation.optics.banding import largest_step
from gltf_iri.validation.optics.film_colours import (
    COSINES,
    MIDDLE,
    MIDDLE_DECODED,
    bases_of,
    film_colours,
    largest_difference,
    thicknesses,
)
from gltf_iri.validation.rules.data_textures import LEVELS

if TYPE_CHECKING:
    from gltf_iri.validation.iridescence.film import Base, Film
    from gltf_iri.validation.issue import Issue

__all__ = ["with_consequence"]

# Babylon.js' index of a clearcoat.
_COAT_IOR = 1.5


def with_consequence(remark: Issue, film: Film) -> Issue:
    """Return the remark with its measured consequence, or as it is where nothing can be measured."""
    measured = _MEASURED.get(remark.code)
    if measured is None:
        return remark
    subject, verb, measure = measured
    try:
        worst = max(measure(film, base, remark) for base in bases_of(film))
    except UsageError:  # the file asks for what no film can be
        return remark
    return remark._replace(message=f"{remark.message} {_told(subject, verb, worst)}")


def _told(subject: str, verb: str, delta_e: float) -> str:
    if math.isnan(delta_e):
        return f"{subject} cannot be compared: some are no numbers."
    if delta_e < 0.01:
        return f"{subject} {verb} by less than ΔE 0.01."
    digits = 0 if delta_e >= 10.0 else 1 if delta_e >= 0.1 else 2
    return f"{subject} {verb} by up to ΔE {delta_e:.{digits}f}."


def _from_bare(film: Film, base: Base, remark: Issue) -> float:
    """Return what the film does at full strength."""
    return _blended(film, base, 1.0, 0.0)


def _as_drawn(film: Film, base: Base, remark: Issue) -> float:
    """Return what the film does at its own strength."""
    return _blended(film, base, film.factor, 0.0)


def _blended(film: Film, base: Base, one: float, other: float) -> float:
    """Return how far the film at one strength is from itself at another."""
    bare, full = film_colours(base, 0.0, film.ior), film_colours(base, thicknesses(film), film.ior)
    return largest_difference(bare + one * (full - bare), bare + other * (full - bare))


def _to_the_letter(film: Film, base: Base, remark: Issue) -> float:
    """Return how far the text's formula is from the truth."""
    nm = thicknesses(film)
    letter = film_colours(base, nm, film.ior, method="letter")
    return largest_difference(letter, film_colours(base, nm, film.ior))


def _phantom(film: Film, base: Base, remark: Issue) -> float:
    """Return what the text's formula makes of a film that does nothing."""
    letter = film_colours(base, thicknesses(film), film.ior, method="letter")
    bare = f_schlick(np.asarray(base.f0), COSINES[:, None])[:, None, :]
    return largest_difference(letter, bare)


def _phantom_on_dielectric(film: Film, base: Base, remark: Issue) -> float:
    return _phantom(film, base, remark) if base.has_index(film.ior) else 0.0


def _between_readers(film: Film, base: Base, remark: Issue) -> float:
    """Return how far readers that follow the text are from those that cut F0 to 0.9999."""
    if not base.is_known:
        return 0.0
    nm = thicknesses(film)
    letter = film_colours(base, nm, film.ior, method="letter")
    return largest_difference(letter, film_colours(base, nm, film.ior, method="cut"))


def _from_mean(film: Film, base: Base, remark: Issue) -> float:
    """Return what is left of the fringes."""
    nm = thicknesses(film)
    return largest_difference(
        film_colours(base, nm, film.ior), film_colours(base, nm, film.ior, method="mean")
    )


def _from_reverse(film: Film, base: Base, remark: Issue) -> float:
    """Return how far the film is from one whose ends are swapped."""
    colours = film_colours(base, thicknesses(film), film.ior)
    return largest_difference(colours, colours[:, ::-1])


def _between_texels(film: Film, base: Base, remark: Issue) -> float:
    """Return how far apart two places of the texture can be."""
    if _is_strength(film, remark):
        return _from_bare(film, base, remark)
    colours = film_colours(base, thicknesses(film), film.ior)
    return largest_difference(colours[:, :, None], colours[:, None, :])


def _decoded(film: Film, base: Base, remark: Issue) -> float:
    """Return what it does to decode the middle value as a colour."""
    if _is_strength(film, remark):
        return _blended(film, base, MIDDLE * film.factor, MIDDLE_DECODED * film.factor)
    ends = np.array([[1.0 - t, t] for t in (MIDDLE, MIDDLE_DECODED)])
    colours = film_colours(base, ends @ np.array([film.minimum_nm, film.maximum_nm]), film.ior)
    return largest_difference(colours[:, 0], colours[:, 1])


def _at_minimum(film: Film, base: Base, remark: Issue) -> float:
    """Return what the film does at the end of its range that G = 0 stands for."""
    colours = film_colours(base, [film.minimum_nm, 0.0], film.ior)
    return largest_difference(colours[:, 0], colours[:, 1])


def _without_green(film: Film, base: Base, remark: Issue) -> float:
    """Return what it does to read G as 0."""
    nm = thicknesses(film)
    return largest_difference(film_colours(base, nm, film.ior), film_colours(base, film.minimum_nm, film.ior))


def _from_black(film: Film, base: Base, remark: Issue) -> float:
    colours = film_colours(base, thicknesses(film), film.ior)
    return largest_difference(colours, np.zeros_like(colours))


def _under_coat(film: Film, base: Base, remark: Issue) -> float:
    """Return how far the film is from one whose outside is the coat, met at the angle inside the coat."""
    nm = thicknesses(film)
    inside = np.sqrt(1.0 - (1.0 - COSINES**2) / _COAT_IOR**2)
    coated = film_colours(base, nm, film.ior, cosines=inside, outside_ior=_COAT_IOR)
    return largest_difference(film_colours(base, nm, film.ior), coated)


def _by_one_value(film: Film, base: Base, remark: Issue) -> float:
    return largest_step(film, LEVELS)


def _is_strength(film: Film, remark: Issue) -> bool:
    """Return whether the remark is about iridescenceTexture."""
    strength, pointer = film.strength, remark.pointer or ""
    return strength is not None and f"{pointer}/".startswith(f"{strength.pointer}/")


Measure = Callable[["Film", "Base", "Issue"], float]

_DIFFER = "differ"
_READERS = "To the letter of the text, and with F0 cut to 0.9999, colours"
_PHANTOM = "To the letter of the text, colours with and without this film"

# Code to the subject and the verb of a sentence about the largest ΔE, and how it is measured on one base.
_MEASURED: dict[str, tuple[str, str, Measure]] = {
    "IRI_IRIDESCENCE_EXCLUDED": ("With and without the film colours", _DIFFER, _as_drawn),
    "IRI_IRIDESCENCE_FACTOR_ZERO": ("At factor 1 colours would", _DIFFER, _from_bare),
    "IRI_IRIDESCENCE_IDLE": ("At factor 1 colours would", _DIFFER, _from_bare),
    "IRI_IRIDESCENCE_FILM_IS_AIR": (_PHANTOM, _DIFFER, _phantom),
    "IRI_IRIDESCENCE_FILM_IS_BASE": (_PHANTOM, _DIFFER, _phantom),
    "IRI_IRIDESCENCE_FILM_IS_DIELECTRIC": (_PHANTOM, _DIFFER, _phantom_on_dielectric),
    "IRI_IRIDESCENCE_IOR_ABSURD": ("To the letter of the text, colours", "are off", _to_the_letter),
    "IRI_IRIDESCENCE_THICKNESS_ZERO": (_PHANTOM, _DIFFER, _phantom),
    "IRI_IRIDESCENCE_THICKNESS_TINY": ("With and without the film colours", _DIFFER, _from_bare),
    "IRI_IRIDESCENCE_THICKNESS_ABSURD": ("From their mean over all phases colours", _DIFFER, _from_mean),
    "IRI_IRIDESCENCE_THICKNESS_INCOHERENT": ("From their mean over all phases colours", _DIFFER, _from_mean),
    "IRI_IRIDESCENCE_MINIMUM_ABOVE_MAXIMUM": ("With the two in order colours", _DIFFER, _from_reverse),
    "IRI_IRIDESCENCE_BASE_REFLECTS_ALL": (_READERS, _DIFFER, _between_readers),
    "IRI_IRIDESCENCE_BASE_F0_UNDEFINED": (_READERS, _DIFFER, _between_readers),
    "IRI_IRIDESCENCE_INDEX_ORDER": ("Where that gives black, colours", "are off", _from_black),
    "IRI_IRIDESCENCE_UNDER_CLEARCOAT": ("With either outside colours", _DIFFER, _under_coat),
    "IRI_IRIDESCENCE_TEXCOORD_OVERRIDDEN": ("Across the texture colours", _DIFFER, _between_texels),
    "IRI_IRIDESCENCE_COLOUR_SPACE": ("Decoded wrongly, colours at the middle value", "are off", _decoded),
    "IRI_IRIDESCENCE_THICKNESS_LOSSY": (
        "Where a texel is off by 1 of 255, colours",
        "are off",
        _by_one_value,
    ),
    "IRI_IRIDESCENCE_THICKNESS_GREY": ("Where G is lost, colours", "are off", _without_green),
    "IRI_IRIDESCENCE_ONE_CHANNEL": ("With and without the thinnest film colours", _DIFFER, _at_minimum),
}
