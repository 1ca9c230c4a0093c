"""KHR_animation_pointer: the values of an animation lie where the property that they are for may lie.

Values between keyframes are not looked at: linear ones stay within, and how far a spline overshoots is the
author's choice of tangents.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.pointer_target import Target
from gltf_iri.validation.pointer_values import values_of
from gltf_iri.validation.rules.pointers import pointed_channels, sampler_of, shown_tokens

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


def _values(animation: Entry, asset: Asset) -> Iterator[Issue]:
    for _, channel, _, target in pointed_channels(animation, asset):
        sampler = sampler_of(channel)
        if sampler is not None and isinstance(target, Target) and target.field is not None:
            yield from _outside(sampler, target, target.field, asset)


def _outside(sampler: Entry, target: Target, field: Field, asset: Asset) -> Iterator[Issue]:
    if not field.has_range:
        return
    count, first, position = 0, (0, 0.0), 0
    for block in values_of(sampler, target, asset):
        # Hardly any block has a fault, and these two run through it ten times as fast.
        if not (_is_inside(field, min(block)) and _is_inside(field, max(block))):
            for index, value in enumerate(block, position):
                if not _is_inside(field, value):
                    first = first if count else (index, value)
                    count += 1
        position += len(block)
    if count:
        yield issue(
            "IRI_POINTER_VALUE",
            sampler.at("output"),
            count=count,
            target=shown_tokens(target.tokens),
            range=_interval(field),
            index=first[0] // target.size,
            value=f"{first[1]:g}",
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


def _interval(field: Field) -> str:
    low = "(−∞" if field.low is None else f"{'(' if field.low_is_excluded else '['}{field.low:g}"
    return f"{low}, {'∞)' if field.high is None else f'{field.high:g}]'}"


RULES: Rules = {}
DATA_RULES: Rules = {"animation": (_values,)}
