"""Rows: drawn each from its own seed, rounded to nine decimals, and drawn again near a rounding tie."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from gltf_iri.conformance.spectral_sum import NotSettledError

__all__ = ["DECIMALS", "TIE", "Drawn", "draw_row", "rounded"]

DECIMALS: Final = 9

# No value lies nearer to half of the last decimal: far more than another machine's last bits move it.
TIE: Final = 1e-12

_ATTEMPTS_MAX: Final = 200

# draw(row number, generator) → (case in words or None, inputs, outputs)
Draw = Callable[[int, np.random.Generator], tuple[str | None, Mapping[str, Any], Mapping[str, Any]]]


@dataclass(frozen=True, slots=True)
class Drawn:
    """One row as its line of JSON, and what came before it: draws that did not settle, and rounding ties."""

    line: str
    unsettled: int
    tied: int


def draw_row(draw: Draw, number: int) -> Drawn:
    """Return row `number`, from the first seed [number, attempt] whose values settle and are no tie.

    Raises NotSettledError where 200 attempts give none.
    """
    unsettled = tied = 0
    for attempt in range(_ATTEMPTS_MAX):
        try:
            case, inputs, outputs = draw(number, np.random.default_rng([number, attempt]))
        except NotSettledError:
            unsettled += 1
            continue
        if _is_tied(outputs):
            tied += 1
            continue
        told = {} if case is None else {"case": case}
        row = {"row": number, **told, "input": inputs, "output": rounded(outputs)}
        line = json.dumps(row, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
        return Drawn(line, unsettled, tied)
    raise NotSettledError(f"Row {number} did not settle in {_ATTEMPTS_MAX} attempts.")


def rounded(value: Any) -> Any:
    """Return `value` with every number in it rounded to DECIMALS, and no negative zero."""
    if isinstance(value, Mapping):
        return {name: rounded(each) for name, each in value.items()}
    if isinstance(value, list):
        return [rounded(each) for each in value]
    return round(value, DECIMALS) + 0.0 if isinstance(value, float) else value


def _is_tied(value: Any) -> bool:
    if isinstance(value, Mapping):
        return any(_is_tied(each) for each in value.values())
    if isinstance(value, list):
        return any(_is_tied(each) for each in value)
    if not isinstance(value, float):
        return False
    last = abs(value) * 10.0**DECIMALS
    return bool(abs(last - np.floor(last) - 0.5) <= TIE * 10.0**DECIMALS)
