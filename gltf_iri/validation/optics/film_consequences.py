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
from gltf_iri.validation.optics.banding import largest_step
from gltf_iri.validation.optics.film_colours import (
    COSINES,
    bases_of,
    film_colours,
    largest_difference,
    thicknesses,
)

if TYPE_CHECKING:
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.iridescence_film import Base, Film

__all__ = ["with_consequence"]

# A texel's middle value, and what is left of it where data is decoded as a colour (IEC 61966-2-1).
_MIDDLE = 0.5
_MIDDLE_DECODED = ((_MIDDLE + 0.055) / 1.055) ** 2.4

# Babylon.js' index of a clearcoat.
_COAT_IOR = 1.5

_LEVELS = 256


def with_consequence(remark: Issue, film: Film) -> Issue:
    """Return the remark with its measured consequence, or as it is where nothing can be measured."""
    measured = _MEASURED.get(remark.code)
    if measured is None:
        return remark
    sentence, measure = measured
    try:
        worst = max(measure(film, base, remark) for base in bases_of(film))
    except UsageError:  # the file asks for what no film can be
        return remark
    return remark._replace(message=f"{remark.message} {sentence.format(amount=_amount(worst))}")


def _amount(delta_e: float) -> str:
    if math.isnan(delta_e):
        return "differ: they are no numbers"
    if delta_e < 0.01:
        return "differ by less than ΔE 0.01"
    return f"differ by up to ΔE {delta_e:.{0 if delta_e >= 10.0 else 2 if delta_e < 0.1 else 1}f}"


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
    return largest_difference(
        film_colours(base, nm, film.ior, method="letter"), film_colours(base, nm, film.ior)
    )


def _of_dielectric(film: Film, base: Base, remark: Issue) -> float:
    return _to_the_letter(film, base, remark) if base.has_index(film.ior) else 0.0


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
        return _blended(film, base, _MIDDLE * film.factor, _MIDDLE_DECODED * film.factor)
    ends = np.array([[1.0 - t, t] for t in (_MIDDLE, _MIDDLE_DECODED)])
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
    return largest_step(film, _LEVELS)


def _is_strength(film: Film, remark: Issue) -> bool:
    """Return whether the remark is about iridescenceTexture."""
    strength, pointer = film.strength, remark.pointer or ""
    return strength is not None and f"{pointer}/".startswith(f"{strength.pointer}/")


Measure = Callable[["Film", "Base", "Issue"], float]

_TO_THE_LETTER = ("Drawn to the letter of the text, colours {amount} from the truth.", _to_the_letter)
_STRONG = ("At factor 1 colours would {amount}.", _from_bare)

# Code to a sentence about the largest ΔE, and how it is measured on one base.
_MEASURED: dict[str, tuple[str, Measure]] = {
    "IRI_IRIDESCENCE_EXCLUDED": ("With and without the film colours {amount}.", _as_drawn),
    "IRI_IRIDESCENCE_FACTOR_ZERO": _STRONG,
    "IRI_IRIDESCENCE_IDLE": _STRONG,
    "IRI_IRIDESCENCE_FILM_IS_AIR": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_FILM_IS_BASE": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_FILM_IS_DIELECTRIC": (_TO_THE_LETTER[0], _of_dielectric),
    "IRI_IRIDESCENCE_IOR_ABSURD": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_THICKNESS_ZERO": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_THICKNESS_TINY": ("With and without the film colours {amount}.", _from_bare),
    "IRI_IRIDESCENCE_THICKNESS_ABSURD": ("Colours {amount} from the mean of all phases.", _from_mean),
    "IRI_IRIDESCENCE_THICKNESS_INCOHERENT": ("Colours {amount} from the mean of all phases.", _from_mean),
    "IRI_IRIDESCENCE_MINIMUM_ABOVE_MAXIMUM": (
        "Where readers order the two, colours {amount}.",
        _from_reverse,
    ),
    "IRI_IRIDESCENCE_BASE_REFLECTS_ALL": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_BASE_F0_UNDEFINED": _TO_THE_LETTER,
    "IRI_IRIDESCENCE_INDEX_ORDER": (
        "Where that is no number and drawn black, colours {amount}.",
        _from_black,
    ),
    "IRI_IRIDESCENCE_UNDER_CLEARCOAT": ("With the coat for the outside colours {amount}.", _under_coat),
    "IRI_IRIDESCENCE_TEXCOORD_OVERRIDDEN": (
        "At other places of the texture colours {amount}.",
        _between_texels,
    ),
    "IRI_IRIDESCENCE_COLOUR_SPACE": ("At the middle value, decoded wrongly, colours {amount}.", _decoded),
    "IRI_IRIDESCENCE_THICKNESS_LOSSY": (
        "Where compression is off by 1 of 255, colours {amount}.",
        _by_one_value,
    ),
    "IRI_IRIDESCENCE_THICKNESS_GREY": ("Where G is lost, colours {amount}.", _without_green),
    "IRI_IRIDESCENCE_ONE_CHANNEL": (
        "At the strength 0 that the minimum gets, colours {amount}.",
        _at_minimum,
    ),
}
