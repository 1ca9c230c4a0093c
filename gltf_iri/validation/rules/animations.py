"""Animations: formats and counts of keyframes, and what may be moved (§3.11)."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import INPUT_FORMATS, OUTPUT_FORMATS
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.accessor_bounds import has_bounds
from gltf_iri.validation.rules.animation_parts import parts
from gltf_iri.validation.rules.attributes import targets_of
from gltf_iri.validation.rules.primitives import accessor_format
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

_TRANSFORMS = frozenset({"translation", "rotation", "scale"})

# Of a cubic spline: the least number of keyframes, and how many elements belong to each.
_LEAST_KEYFRAMES = 2
_ELEMENTS = 3


def _animations(animation: Entry, asset: Asset) -> Iterator[Issue]:
    channels, samplers = parts(animation)
    for sampler in samplers:
        yield from _sampler(sampler, asset)
    for channel in channels:
        target = channel.get("target")
        if target is None:
            continue
        node, path = asset.get("nodes", target.get("node")), target.get("path")
        if node is not None:
            yield from _target(target, node, path, asset)
        if path in OUTPUT_FORMATS and "sampler" in channel:
            yield from _output(channel, samplers[channel["sampler"]], node, path, asset)
    yield from _duplicates(channels)


def _sampler(sampler: Entry, asset: Asset) -> Iterator[Issue]:
    for key in ("input", "output"):
        accessor = asset.get("accessors", sampler.get(key))
        view = asset.get("bufferViews", accessor.get("bufferView")) if accessor is not None else None
        if view is not None and "byteStride" in view:
            yield issue("ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", sampler.at(key))
    times = asset.get("accessors", sampler.get("input"))
    if times is None:
        return
    pointer, given = sampler.at("input"), accessor_format(times)
    if given not in INPUT_FORMATS:
        code, allowed = "ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", ", ".join(INPUT_FORMATS)
        yield issue(code, pointer, format=given, allowed=allowed)
    if not has_bounds(times):
        yield issue("ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", pointer)
    interpolation, count = sampler.get("interpolation"), times.get("count", 0)
    if interpolation == "CUBICSPLINE" and count < _LEAST_KEYFRAMES:
        code = "ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS"
        yield issue(code, pointer, interpolation=interpolation, minimum=_LEAST_KEYFRAMES, count=count)


def _target(target: Entry, node: Entry, path: str | None, asset: Asset) -> Iterator[Issue]:
    if path in _TRANSFORMS:
        if "matrix" in node:
            yield issue("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", target.pointer)
        if "skin" in node:
            yield issue("ANIMATION_CHANNEL_TARGET_NODE_SKIN", target.at("path"))
    elif path == "weights" and not targets_of(node, asset):
        yield issue("ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", target.pointer)


def _output(channel: Entry, sampler: Entry, node: Entry | None, path: str, asset: Asset) -> Iterator[Issue]:
    pointer, values = channel.at("sampler"), asset.get("accessors", sampler.get("output"))
    if values is None:
        return
    given = accessor_format(values)
    if given not in OUTPUT_FORMATS[path]:
        code, allowed = "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", ", ".join(OUTPUT_FORMATS[path])
        yield issue(code, pointer, path=path, format=given, allowed=allowed)
    times, interpolation = asset.get("accessors", sampler.get("input")), sampler.raw.get("interpolation", "")
    if times is None or "count" not in times or "count" not in values or not isinstance(interpolation, str):
        return
    wanted = times["count"]
    if interpolation == "CUBICSPLINE":
        wanted *= _ELEMENTS
    if path == "weights":
        wanted *= len(targets_of(node, asset)) if node is not None else 0
    if wanted and values["count"] != wanted:
        code = "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT"
        yield issue(code, pointer, wanted=wanted, count=values["count"])


def _duplicates(channels: list[Entry]) -> Iterator[Issue]:
    """Tell of every channel after which another one moves the same property."""
    later: dict[tuple[object, object], int] = {}
    for position in reversed(range(len(channels))):
        channel = channels[position]
        target = channel.get("target")
        # The node need not exist, nor the path be one: that both stand twice is wrong all the same.
        node, path = (target.raw.get(key) for key in ("node", "path")) if target is not None else (None, None)
        if target is None or not _is_index(node):
            continue
        moved = (node, path if isinstance(path, str) else None)
        if moved in later and _is_index(channel.raw.get("sampler")):
            yield issue("ANIMATION_DUPLICATE_TARGETS", target.pointer, channel=later[moved])
        later[moved] = position


def _is_index(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value >= 0 and value % 1 == 0


RULES: Rules = {"animation": (_animations,)}
