"""EXT_materials_bragg under animations: at every time the values keep the rule for ior1."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.bragg_stack import TRANSMISSION, stacks
from gltf_iri.validation.codes import issue
from gltf_iri.validation.pointer_target import Target
from gltf_iri.validation.pointer_values import values_of
from gltf_iri.validation.rules.pointers import pointed_channels, sampler_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.bragg_stack import Layer, Stack
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


def animated_indices(asset: Asset) -> Iterator[Issue]:
    """Yield the animations that make a first index differ from the host's where it must not."""
    listed = [stack for stack in stacks(asset) if any(layer.states_ior1 for layer in stack.layers)]
    for animation in asset.array("animations") if listed else ():
        moved = _moved(animation, asset) if animation is not None else {}
        for stack in listed if moved else ():
            yield from _of_stack(stack, moved, asset)


def _moved(animation: Entry, asset: Asset) -> Moved:
    found: Moved = {}
    for _, channel, pointer, target in pointed_channels(animation, asset):
        sampler = sampler_of(channel)
        if isinstance(target, Target) and target.tokens[0] == "materials" and sampler is not None:
            found.setdefault(target.tokens, (pointer, sampler, target))
    return found


def _of_stack(stack: Stack, moved: Moved, asset: Asset) -> Iterator[Issue]:
    for layer in stack.layers:
        if not layer.states_ior1 or layer.ior1 is None or stack.host_ior is None:
            continue
        if stack.why_unbent(layer):
            yield from _apart(layer, layer.ior1, stack, moved, asset)
        elif layer.ior1 != stack.host_ior:
            for below in _BELOW:
                channel = moved.get((*stack.tokens()[:2], *below))
                if channel is not None and _farthest(channel, 0.0, asset) > 0.0:
                    yield _told(channel, layer, f"{below[-1]} does not stay 0")


def _apart(layer: Layer, ior1: float, stack: Stack, moved: Moved, asset: Asset) -> Iterator[Issue]:
    """Tell where one of both indices moves and the other stays; where both do, their times may meet."""
    own = moved.get(stack.tokens("layers", str(layer.position), "ior1"))
    host = moved.get(stack.tokens("hostIor"))
    channel, other = (host, ior1) if own is None else (own, stack.host_ior)
    if channel is None or other is None or (own is not None and host is not None):
        return
    if _farthest(channel, other, asset) > _ROUNDING * other:
        yield _told(channel, layer, "one of the two moves, and the other does not")


def _farthest(channel: tuple[Entry, Entry, Target], other: float, asset: Asset) -> float:
    """Return how far the channel's values go from `other`; 0 where they cannot be read."""
    _, sampler, target = channel
    blocks = values_of(sampler, target, asset)
    return max((max(abs(min(b) - other), abs(max(b) - other)) for b in blocks if b), default=0.0)


def _told(channel: tuple[Entry, Entry, Target], layer: Layer, reason: str) -> Issue:
    place = layer.entry.at("ior1")
    return issue("IRI_BRAGG_FIRST_INDEX_ANIMATED", channel[0].at("pointer"), ior1=place, reason=reason)
