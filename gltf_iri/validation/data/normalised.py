"""Normalised integers as the numbers they stand for (glTF 2.0, §3.11)."""

from __future__ import annotations

from itertools import repeat
from operator import truediv
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.formats import FLOAT, INTEGER_RANGES

if TYPE_CHECKING:
    from gltf_iri.validation.data.elements import Elements

__all__ = ["columns_of", "normalised"]


def normalised(column: list[Any], component: int) -> list[float]:
    """Return c / (2ᵇ − 1) of unsigned and max(c / (2ᵇ⁻¹ − 1), −1) of signed integers of b bits."""
    low, high = INTEGER_RANGES[component]
    if low < 0 and min(column) == low:
        column = [max(value, -high) for value in column]
    return list(map(truediv, column, repeat(float(high))))


def columns_of(elements: Elements, first: int) -> list[list[float]]:
    """Return the block's columns as the numbers that the accessor means."""
    columns = elements.columns(first)
    if not elements.is_normalized or elements.component == FLOAT:
        return columns
    return [normalised(column, elements.component) for column in columns]
