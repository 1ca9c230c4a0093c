"""Channels and samplers of an animation, where it has both."""

from __future__ import annotations

from gltf_iri.validation.entry import Entry

__all__ = ["parts"]


def parts(animation: Entry) -> tuple[list[Entry], list[Entry]]:
    """Return channels and samplers; neither where one list is broken, for then the indices mean nothing."""
    channels, samplers = animation.get("channels"), animation.get("samplers")
    return (channels, samplers) if channels and samplers else ([], [])
