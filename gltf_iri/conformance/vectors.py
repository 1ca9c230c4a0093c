"""The two files of vectors: their heads, and their rows, one a line."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from gltf_iri.backends import Backend, has_numba
from gltf_iri.conformance.bragg_cases import BRAGG_CASES, bragg_case_inputs
from gltf_iri.conformance.bragg_draw import random_bragg_inputs
from gltf_iri.conformance.bragg_input import read_bragg_input
from gltf_iri.conformance.bragg_truth import VALUES_MAX, WAVELENGTHS_NM, bragg_outputs
from gltf_iri.conformance.khr_rows import draw_khr
from gltf_iri.conformance.rows import Draw, Drawn, draw_row
from gltf_iri.conformance.words import BRAGG_WORDS, COLOURS, KHR_WORDS, Words

__all__ = ["FORMAT_VERSION", "ROWS", "VECTORS", "draw_bragg", "drawn_line", "file_text"]

FORMAT_VERSION: Final = 1
ROWS: Final = 1000

# What is worth more time in an edge case than in one random row of many.
_CASE_VALUES_MAX: Final = 6.0 * VALUES_MAX


def draw_bragg(
    number: int, g: np.random.Generator
) -> tuple[str | None, Mapping[str, Any], Mapping[str, Any]]:
    """Return the case in words, inputs and outputs of row `number` of EXT_materials_bragg.

    Raises NotSettledError where the truth does not converge.
    """
    # Either gives the same to 1e-13, which no rounding sees.
    backend: Backend = "numba" if has_numba() else "numpy"
    if number < len(BRAGG_CASES):
        inputs = bragg_case_inputs(number, g)
        outputs = bragg_outputs(read_bragg_input(inputs), backend, _CASE_VALUES_MAX)
        return BRAGG_CASES[number][0], inputs, outputs
    inputs = random_bragg_inputs(number, g)
    return None, inputs, bragg_outputs(read_bragg_input(inputs), backend)


# File name → how its rows are drawn, and what its head says.
VECTORS: Final[Mapping[str, tuple[Draw, Words]]] = MappingProxyType(
    {
        "ext_materials_bragg.json": (draw_bragg, BRAGG_WORDS),
        "khr_materials_iridescence.json": (draw_khr, KHR_WORDS),
    }
)


def drawn_line(name: str, number: int) -> Drawn:
    """Return row `number` of the file `name`; each is drawn alone, by whichever process."""
    draw: Callable[..., Any] = VECTORS[name][0]
    return draw_row(draw, number)


def file_text(name: str, lines: Iterable[str]) -> str:
    """Return the file: one object, whose "rows" stand one a line."""
    words = VECTORS[name][1]
    head = {
        "what": words.what,
        "format_version": FORMAT_VERSION,
        "generator": "python -m gltf_iri.conformance",
        "white": "D65",
        "observer": "CIE 1931 2°, 1 nm, linear between; D65 of 5 nm, linear between, held from 780 nm on",
        "range_nm": [360, 830],
        "colours": words.colours,
        "wavelengths_nm": list(WAVELENGTHS_NM),
        "decimals": 9,
        "conventions": dict(words.conventions),
        "tolerances": {name: _tolerance(name, *of) for name, of in words.tolerances.items()},
    }
    text = json.dumps(head, ensure_ascii=False, indent=1)
    return f'{text[:-2]},\n "rows": [\n' + ",\n".join(lines) + "\n]}\n"


def _tolerance(name: str, absolute: float, relative: float, reason: str) -> dict[str, Any]:
    return {"absolute": absolute, "relative": relative, "reason": reason, "colour": name in COLOURS}
