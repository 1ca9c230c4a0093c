"""Channels and samplers of an animation, where both lists are whole."""

from __future__ import annotations

from gltf_iri.validation.entry import Entry

__all__ = ["parts"]


def parts(animation: Entry) -> tuple[list[Entry], list[Entry]]:
    """Return channels and samplers; neither where an item is broken, for then the indices mean nothing."""
    channels, samplers = animation.get("channels", [None]), animation.get("samplers", [None])
    return ([], []) if None in channels or None in samplers else (channels, samplers)
