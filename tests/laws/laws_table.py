"""Which method keeps which law, and why the others do not: one line a method.

`python tests/laws/laws_table.py` prints the tables that stand between <!-- laws --> and <!-- /laws --> in
spec/optics-notes.md; a test holds both equal. A law that is listed here is tested to be broken, every other
one to be kept.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping

from laws_cells import CELL_LAWS
from laws_film import FILM_LAWS
from laws_law import Law
from laws_mirror import MIRROR_LAWS
from laws_spectral import SPECTRAL_LAWS

__all__ = ["BROKEN", "MADE_OF", "TABLES", "markdown"]

Reasons = Mapping[str, str]  # law → why it is broken

_SCHLICK = "Schlick's term takes the outside's cosine, from a denser outside too"
_ONE_WAVELENGTH = "one wavelength a channel: fringes never fade"
_TWO_BEAMS = "two beams without inter-reflections are not a passive surface"
_NO_BASE = "its base plays no part: the film's inner side reflects all that enters"
_THREE_ORDERS = "three orders leave the rest out, which bright interfaces show"
_NO_PHASE = "it knows no phase, and no film is so thin or so plain that it had none"
_TOO_FEW = "wavelengths some nanometres apart alias fine fringes"
_TWO_LOBES = "R + T is nearly 1 before 2√(RT) is added: both lobes together pass 1"

_FILMS: dict[str, Reasons] = {
    "khr": {
        "film = outside": "grazing light is reflected where no interface is, and R123's floor adds fringes",
        "film = base": "the floor 1e-5 of R123 draws fringes where the second interface is none",
        "no thickness": "two orders of fringes, tinted by the sensitivities' white, are not the bare base",
        "backwards": _SCHLICK,
        "perfect mirror": "F0 = 1 makes the base's index negative, and 0.9999 bounds R123",
        "no more than white": "two orders of a series overshoot, and the text has no upper clamp",
    },
    "khr-guarded": {
        "backwards": _SCHLICK,
        "perfect mirror": "F0 is cut to 0.9999",
    },
    "granier-heidrich": {
        "film = outside": _NO_BASE,
        "film = base": _NO_BASE,
        "no thickness": _NO_BASE,
        "backwards": _NO_BASE,
        "perfect mirror": _TWO_LOBES,
        "fine fringes": _ONE_WAVELENGTH,
        "no more than white": _TWO_LOBES,
    },
    "naive-rgb": {"fine fringes": _ONE_WAVELENGTH},
    "smits-meyer": {
        "no thickness": _TWO_BEAMS,
        "backwards": _TWO_BEAMS,
        "perfect mirror": _TWO_BEAMS,
        "no more than white": _TWO_BEAMS,
    },
    "bb17": {
        "no thickness": _THREE_ORDERS,
        "no more than white": _THREE_ORDERS,
    },
    "fourier": {},
    "spectral-grid": {"fine fringes": _TOO_FEW},
    "incoherent": {"no thickness": _NO_PHASE},
    "spectral": {},
}

_FIXED_GRID = "sums over few wavelengths are not the integral that the slab is compared by"
_ENVELOPE = "it colours the envelope of many cells, not the fringes of these"
_NEARLY = "an approximation of the integral, here within 1e-3 of it"

_MIRRORS: dict[str, Reasons] = {
    "yeh-spectral": {},
    "yeh-grid": {"one cell": _FIXED_GRID},
    "landmarks": {"one cell": _ENVELOPE},
    "landmarks-sub": {"one cell": _ENVELOPE},
    "bloch": {"one cell": _NEARLY, "no more than white": _NEARLY},
}

_FUNCTIONS: dict[str, Reasons] = {
    "optics/film": {},
    "optics/airy": {},
    "optics/stack": {},
    "optics/bragg": {},
    "naive-rgb": {},
    "granier-heidrich": {
        "absentee": _NO_BASE,
        "quarter wave": _NO_BASE,
        "backwards": _NO_BASE,
        "0 ≤ R ≤ 1": _TWO_LOBES,
    },
}

_CELLS: dict[str, Reasons] = {"optics/bragg": {}, "optics/stack": {}}

BROKEN: dict[str, Mapping[str, Reasons]] = {
    "film": _FILMS,
    "mirror": _MIRRORS,
    "wavelength": _FUNCTIONS,
    "cells": _CELLS,
}

TABLES: dict[str, Mapping[str, Law]] = {
    "film": FILM_LAWS,
    "mirror": MIRROR_LAWS,
    "wavelength": SPECTRAL_LAWS,
    "cells": CELL_LAWS,
}

_TERM_BY_TERM = "its series is integrated over wavelengths term by term"

# The one-wavelength subject that stands for a method, or why it has none.
MADE_OF: dict[str, str] = {
    "khr": _TERM_BY_TERM,
    "khr-guarded": _TERM_BY_TERM,
    "granier-heidrich": "granier-heidrich",
    "naive-rgb": "naive-rgb",
    "bb17": _TERM_BY_TERM,
    "fourier": _TERM_BY_TERM,
    "incoherent": "it knows no wavelength",
    "smits-meyer": "its fringe is integrated over wavelengths as one cosine",
    "spectral-grid": "optics/film",
    "spectral": "optics/film",
    "yeh-grid": "optics/bragg",
    "yeh-spectral": "optics/bragg",
    "landmarks": "its boxes are integrals between wavelengths",
    "landmarks-sub": "its boxes are integrals between wavelengths",
    "bloch": "it sees the reflectance through windows, never at one wavelength",
}

_TITLES = {
    "film": "Films, as colours",
    "mirror": "Mirrors, as colours",
    "wavelength": "Films, at one wavelength",
    "cells": "Mirrors, at one wavelength",
}


def markdown() -> str:
    """Return the section of spec/optics-notes.md."""
    return "\n\n".join(["\n".join(_table(which)) for which in TABLES] + ["\n".join(_without_wavelength())])


def _table(which: str) -> Iterator[str]:
    laws, subjects = TABLES[which], BROKEN[which]
    yield f"### {_TITLES[which]}"
    yield ""
    yield f"| | {' | '.join(laws)} |"
    yield "|---" * (len(laws) + 1) + "|"
    for subject, reasons in subjects.items():
        yield f"| `{subject}` | {' | '.join('broken' if law in reasons else 'kept' for law in laws)} |"
    yield ""
    yield from (f"- *{name}*: {law.says}" for name, law in laws.items())
    if any(subjects.values()):
        yield ""
        yield "Broken, and why:"
        yield ""
    for subject, reasons in subjects.items():
        for reason in dict.fromkeys(reasons.values()):
            named = ", ".join(law for law, why in reasons.items() if why == reason)
            yield f"- `{subject}` ({named}): {reason}."


def _without_wavelength() -> Iterator[str]:
    yield "Laws at one wavelength are asked of functions; no integral over many keeps them. Each method's:"
    yield ""
    for method, subject in MADE_OF.items():
        is_asked = subject in BROKEN["wavelength"] or subject in BROKEN["cells"]
        yield f"- `{method}`: {'' if is_asked else 'none, '}{f'`{subject}`' if is_asked else subject}."


if __name__ == "__main__":
    sys.stdout.write(markdown() + "\n")
