"""EXT_materials_bragg under animations: at every time the values keep the rule for ior1."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

from gltf_iri.validation.bragg.stack import TRANSMISSION
from gltf_iri.validation.codes import issue
from gltf_iri.validation.pointers.rules import pointed_channels
from gltf_iri.validation.pointers.target import Target
from gltf_iri.validation.pointers.values import values_key, values_of
from gltf_iri.validation.rules.animation_parts import sampler_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.bragg.stack import Layer, Stack
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

    # Tokens of a property to its channel's pointer, sampler and target, of one animation.
    Moved = dict[tuple[str, ...], tuple[Entry, Entry, Target]]

__all__ = ["animated_indices"]

# JSON states 1.33 and a buffer 1.3300000429153442.
_ROUNDING = 1e-6

# What a bending last layer does not go with, below the material.
_BELOW = (
    ("pbrMetallicRoughness", "metallicFactor"),
    *(("extensions", name, key) for name, key in TRANSMISSION.items()),
)


def animated_indices(found: list[Stack], asset: Asset) -> Iterator[Issue]:
    """Yield the animations that make a first index differ from the host's where it must not."""
    listed = {
        stack.tokens()[:2]: stack for stack in found if any(layer.states_ior1 for layer in stack.layers)
    }
    reach = _Reach(asset)
    for animation in asset.array("animations") if listed else ():
        moved = _moved(animation, asset) if animation is not None else {}
        for material in dict.fromkeys(tokens[:2] for tokens in moved):
            if material in listed:
                yield from _of_stack(listed[material], moved, reach)


def _moved(animation: Entry, asset: Asset) -> Moved:
    found: Moved = {}
    for _, channel, pointer, target in pointed_channels(animation, asset):
        sampler = sampler_of(channel)
        if isinstance(target, Target) and target.tokens[0] == "materials" and sampler is not None:
            found.setdefault(target.tokens, (pointer, sampler, target))
    return found


class _Reach:
    """How far values go from a number; each accessor is read once, however many channels share it."""

    def __init__(self, asset: Asset) -> None:
        self._asset = asset
        self._ends: dict[object, tuple[float, float] | None] = {}

    def farthest(self, channel: tuple[Entry, Entry, Target], other: float) -> float:
        """Return the greatest distance from `other`; 0 where the values cannot be read."""
        _, sampler, target = channel
        key = values_key(sampler, target)
        if key not in self._ends:
            columns = chain.from_iterable(values_of(sampler, target, self._asset))
            ends = [(min(column), max(column)) for column in columns if column]
            lows, highs = zip(*ends, strict=True) if ends else ((), ())
            self._ends[key] = (min(lows), max(highs)) if ends else None
        known = self._ends[key]
        return 0.0 if known is None else max(abs(end - other) for end in known)


def _of_stack(stack: Stack, moved: Moved, reach: _Reach) -> Iterator[Issue]:
    for layer in stack.layers:
        if not layer.states_ior1 or layer.ior1 is None or stack.host_ior is None:
            continue
        if stack.why_unbent(layer):
            yield from _apart(layer, layer.ior1, stack, moved, reach)
        elif layer.ior1 != stack.host_ior:
            for below in _BELOW:
                channel = moved.get((*stack.tokens()[:2], *below))
                if channel is not None and reach.farthest(channel, 0.0) > 0.0:
                    yield _told(channel, layer, f"{below[-1]} does not stay 0")


def _apart(layer: Layer, ior1: float, stack: Stack, moved: Moved, reach: _Reach) -> Iterator[Issue]:
    """Tell where one of both indices moves and the other stays; where both do, their times may meet."""
    own = moved.get(stack.tokens("layers", str(layer.position), "ior1"))
    host = moved.get(stack.tokens("hostIor"))
    channel, other = (host, ior1) if own is None else (own, stack.host_ior)
    if channel is None or other is None or (own is not None and host is not None):
        return
    if reach.farthest(channel, other) > _ROUNDING * other:
        yield _told(channel, layer, "one of the two moves, and the other does not")


def _told(channel: tuple[Entry, Entry, Target], layer: Layer, reason: str) -> Issue:
    place = layer.entry.at("ior1")
    return issue("IRI_BRAGG_FIRST_INDEX_ANIMATED", channel[0].at("pointer"), ior1=place, reason=reason)
