"""Keyframes: times that increase from 0 on, and rotations of length 1."""

from __future__ import annotations

from math import hypot
from operator import lt
from typing import TYPE_CHECKING

from gltf_iri.asset.formats import INPUT_FORMATS
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, elements_of
from gltf_iri.validation.data.normalised import columns_of
from gltf_iri.validation.rules.animation_parts import parts, sampler_of
from gltf_iri.validation.rules.primitives import accessor_format

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["rotations_are_of_length_1", "times_increase"]

# How far a quaternion's length may be from 1, as the Khronos validator (2.0.0-dev.3.10) has it for every
# format: 1.0076899 passes, 1.0076901 does not. It lets four bytes be off by half a step each (1/254).
_LARGEST_LENGTH_ERROR = 0.00769


def times_increase(sampler: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of times before 0, and of those that are not after the one before."""
    accessor = asset.get("accessors", sampler.get("input"))
    animation = sampler.parent
    if accessor is None or accessor_format(accessor) not in INPUT_FORMATS:
        return
    if animation is None or not all(parts(animation)):
        return
    elements = elements_of(accessor, asset)
    if elements is None or ("times", accessor) in asset.resources.found:
        return
    pointer, previous, is_clean = sampler.at("input"), 0.0, True
    for first in blocks(elements, asset, accessor.pointer):
        times = elements.columns(first)[0]
        starts_well = times[0] > previous if first else times[0] >= 0.0
        if starts_well and all(map(lt, times, times[1:])):
            previous = times[-1]
            continue
        is_clean = False
        for index, time in enumerate(times, first):
            if time < 0.0:
                yield issue("ACCESSOR_ANIMATION_INPUT_NEGATIVE", pointer, index=index, value=time)
                continue  # and the next is compared with the one before it
            if index and time <= previous:
                code = "ACCESSOR_ANIMATION_INPUT_NON_INCREASING"
                yield issue(code, pointer, index=index, value=time, previous=previous)
            previous = time
    if is_clean:
        asset.resources.found["times", accessor] = True


def rotations_are_of_length_1(channel: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of rotations that are no unit quaternions; of a spline's elements, those that are values."""
    target, sampler = channel.get("target"), sampler_of(channel)
    if target is None or target.get("path") != "rotation" or sampler is None:
        return
    accessor = asset.get("accessors", sampler.get("output"))
    elements = elements_of(accessor, asset)
    if accessor is None or elements is None or elements.width != 4:
        return
    # A spline's keyframe is an in-tangent, a value, and an out-tangent (glTF 2.0, appendix C).
    start, step = (1, 3) if sampler.get("interpolation") == "CUBICSPLINE" else (0, 1)
    name = (f"rotations {step}", accessor)
    if name in asset.resources.found:
        return
    is_clean = True
    for first in blocks(elements, asset, accessor.pointer):
        lengths = list(map(hypot, *(column[start::step] for column in columns_of(elements, first))))
        if all(abs(length - 1.0) <= _LARGEST_LENGTH_ERROR for length in lengths):
            continue
        for position, length in enumerate(lengths):
            if abs(length - 1.0) > _LARGEST_LENGTH_ERROR:
                is_clean = False
                index = 4 * (first + start + position * step)
                code = "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION"
                yield issue(code, channel.at("sampler"), first=index, last=index + 3, length=length)
    if is_clean:
        asset.resources.found[name] = True
