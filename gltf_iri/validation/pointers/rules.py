"""KHR_animation_pointer: what the Khronos validator leaves out, as it says itself.

That what a pointer leads to is there and can change, that no two channels of an animation change it, and that
the values have its type and number. What the values are is looked at once they are read (`value_rules`).
"""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import COMPONENT_NAMES
from gltf_iri.asset.words import shown
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import add_codes, issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.pointers.codes import POINTER_CODES
from gltf_iri.validation.pointers.target import Target, Unresolved, resolve
from gltf_iri.validation.rules.animation_parts import sampler_of
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import value_of

__all__ = ["RULES", "animated_properties", "pointed_channels", "shown_tokens"]

_NAME = "KHR_animation_pointer"
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_UNSIGNED_BYTE = 5121

_LONGEST_POINTER = 200

# Values of one keyframe: the spline's have a tangent before and one after.
_PER_KEYFRAME = {"CUBICSPLINE": 3}


def pointed_channels(
    animation: Entry, asset: Asset
) -> Iterator[tuple[int, Entry, Entry, Target | Unresolved]]:
    """Yield position, channel, extension object and target of each channel of `animation` with a pointer."""
    for position, channel in enumerate(animation.get("channels", ())):
        pointer = _pointer_of(channel) if channel is not None else None
        if pointer is not None:
            yield position, channel, pointer, resolve(asset.root, pointer["pointer"])


def animated_properties(asset: Asset) -> frozenset[tuple[str, ...]]:
    """Return the tokens of all pointers of all animations; those that lead nowhere do no harm."""
    return frozenset(
        target.tokens
        for animation in asset.array("animations")
        if animation is not None
        for _, _, _, target in pointed_channels(animation, asset)
        if isinstance(target, Target)
    )


def shown_tokens(tokens: tuple[str, ...]) -> str:
    """Return the pointer of `tokens` for people; those into extensions differ at their ends."""
    return shown("/" + "/".join(tokens), _LONGEST_POINTER)


def _channels(animation: Entry, asset: Asset) -> Iterator[Issue]:
    seen = _Seen()
    for position, channel in enumerate(animation.get("channels", ())):
        place = channel.get("target") if channel is not None else None
        if place is None:
            continue
        pointer = _pointer_of(channel)
        if pointer is not None:
            yield from _pointed(position, channel, pointer, seen, asset)
        elif "node" in place and "path" in place:
            tokens = ("nodes", str(place["node"]), place["path"])
            yield from seen.check(tokens, position, place.pointer, is_pointer=False)
        elif place.raw.get("path") == "pointer" and not _has_pointer(place):
            yield issue("IRI_POINTER_MISSING", place.at("path"))


def _pointed(position: int, channel: Entry, pointer: Entry, seen: _Seen, asset: Asset) -> Iterator[Issue]:
    place, target = pointer.at("pointer"), resolve(asset.root, pointer["pointer"])
    if isinstance(target, Unresolved):
        yield issue(
            target.code, place, target=shown(pointer["pointer"], _LONGEST_POINTER), reason=target.reason
        )
        return
    yield from seen.check(target.tokens, position, place, is_pointer=True)
    of_node = len(target.tokens) == 3 and target.tokens[0] == "nodes"
    if of_node and target.tokens[2] != "weights" and "matrix" in target.holder:
        yield issue("IRI_POINTER_NODE_MATRIX", place, property=target.tokens[2])
    yield from _values(channel, target, asset)


def _pointer_of(channel: Entry) -> Entry | None:
    target = channel.get("target")
    pointer: Entry | None = None if target is None else target.extensions.get(_NAME)
    return pointer if pointer is not None and "pointer" in pointer else None


def _has_pointer(target: Entry) -> bool:
    extensions = target.raw.get("extensions")
    return isinstance(extensions, dict) and _NAME in extensions


class _Seen:
    """The properties that channels of one animation change, each with the first channel that does."""

    def __init__(self) -> None:
        # Channel, and whether it has a pointer; the second is of arrays of which a single value changes.
        self._whole: dict[tuple[str, ...], tuple[int, bool]] = {}
        self._parts: dict[tuple[str, ...], tuple[int, bool]] = {}

    def check(
        self, tokens: tuple[str, ...], position: int, place: str, *, is_pointer: bool
    ) -> Iterator[Issue]:
        """Tell of a property that is changed already: itself, the array that it is in, or a part of it."""
        here = (position, is_pointer)
        before = self._whole.get(tokens) or self._parts.get(tokens)
        if tokens[-2:-1] == ("weights",):
            before = before or self._whole.get(tokens[:-1])
            self._parts.setdefault(tokens[:-1], here)
        self._whole.setdefault(tokens, here)
        # Two channels without pointers are glTF's own matter.
        if before is not None and (is_pointer or before[1]):
            yield issue("IRI_POINTER_REPEATED", place, target=shown_tokens(tokens), first=before[0])


def _values(channel: Entry, target: Target, asset: Asset) -> Iterator[Issue]:
    """Tell of values whose type, number or interpolation does not go with the property."""
    sampler = sampler_of(channel)
    output = asset.get("accessors", sampler.get("output")) if sampler is not None else None
    if sampler is None or output is None or target.field is None:
        return
    told = shown_tokens(target.tokens)
    place = sampler.at("output")
    wanted = _TYPES[target.size]
    component = output.get("componentType")
    if output.get("type", wanted) != wanted:
        yield issue("IRI_POINTER_OUTPUT_TYPE", place, target=told, found=output["type"], wanted=wanted)
        return
    interpolation = value_of(sampler, "interpolation")
    if target.field.kind == "FLAG":
        if component not in (None, _UNSIGNED_BYTE):
            found = COMPONENT_NAMES[component]
            yield issue("IRI_POINTER_OUTPUT_TYPE", place, target=told, found=found, wanted="UNSIGNED_BYTE")
        if interpolation != "STEP":
            where = sampler.at("interpolation") if "interpolation" in sampler else sampler.pointer
            yield issue("IRI_POINTER_INTERPOLATION", where, found=interpolation)
    times = asset.get("accessors", sampler.get("input"))
    if times is None or "count" not in times or "count" not in output:
        return
    count = times["count"] * _PER_KEYFRAME.get(interpolation, 1) * (target.length or 1)
    if output["count"] != count:
        yield issue("IRI_POINTER_OUTPUT_COUNT", place, target=told, found=output["count"], wanted=count)


add_codes(POINTER_CODES)
RULES: Rules = {"animation": (_channels,)}
