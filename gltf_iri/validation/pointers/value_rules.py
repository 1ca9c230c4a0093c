"""KHR_animation_pointer: the values of an animation lie where the property that they are for may lie.

Values between keyframes are not looked at: linear ones stay within, and how far a spline overshoots is the
author's choice of tangents.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.pointers.rules import pointed_channels, shown_tokens
from gltf_iri.validation.pointers.target import Target
from gltf_iri.validation.pointers.values import values_key, values_of
from gltf_iri.validation.rules.animation_parts import sampler_of
from gltf_iri.validation.schema.values import interval

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules
    from gltf_iri.validation.tables import Field

__all__ = ["DATA_RULES", "RULES"]

# Single precision rounds 1 to within 6e-8, and what exporters resample by a few of these.
_ROUNDING = 1e-6


# How many numbers are outside, and the first of them with the position of its value.
_Outside = tuple[int, int, float]


def _values(root: Entry, asset: Asset) -> Iterator[Issue]:
    # Many channels may share the values of one accessor: they are looked at once for each range.
    known: dict[object, _Outside] = {}
    for animation in asset.array("animations"):
        for _, channel, _, target in pointed_channels(animation, asset) if animation is not None else ():
            sampler = sampler_of(channel)
            field = target.field if isinstance(target, Target) else None
            if sampler is None or not isinstance(target, Target) or field is None or not field.has_range:
                continue
            key = (*values_key(sampler, target), field)
            if key not in known:
                known[key] = _outside(sampler, target, field, asset)
            count, index, value = known[key]
            if count:
                yield issue(
                    "IRI_POINTER_VALUE",
                    sampler.at("output"),
                    count=count,
                    target=shown_tokens(target.tokens),
                    range=interval(field),
                    index=index,
                    value=f"{value:g}",
                )


def _outside(sampler: Entry, target: Target, field: Field, asset: Asset) -> _Outside:
    count, first, position = 0, (0, 0.0), 0
    for columns in values_of(sampler, target, asset):
        if not all(_is_all_inside(field, column) for column in columns):
            for index, values in enumerate(zip(*columns, strict=True), position):
                for value in values:
                    if not _is_inside(field, value):
                        first = first if count else (index, value)
                        count += 1
        position += len(columns[0])
    return count, *first


def _is_all_inside(field: Field, column: list[float]) -> bool:
    """Tell at once what is true of nearly every column; False where each value must be looked at."""
    # Between a value that is allowed alone and the range there are others that are not.
    return not column or (
        field.also_allowed is None and _is_inside(field, min(column)) and _is_inside(field, max(column))
    )


def _is_inside(field: Field, value: float) -> bool:
    if value == field.also_allowed:
        return True
    if field.low is not None:
        if field.low_is_excluded and value <= field.low:
            return False
        if value < field.low - _ROUNDING * max(1.0, abs(field.low)):
            return False
    return field.high is None or value <= field.high + _ROUNDING * max(1.0, abs(field.high))


RULES: Rules = {}
DATA_RULES: Rules = {"glTF": (_values,)}
