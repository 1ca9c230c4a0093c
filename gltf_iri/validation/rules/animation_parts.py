"""Channels and samplers of an animation, and which belong together."""

from __future__ import annotations

from gltf_iri.validation.entry import Entry

__all__ = ["parts", "sampler_of"]


def parts(animation: Entry) -> tuple[list[Entry], list[Entry]]:
    """Return channels and samplers; neither where one list is broken, for then the indices mean nothing."""
    channels, samplers = animation.get("channels"), animation.get("samplers")
    return (channels, samplers) if channels and samplers else ([], [])


def sampler_of(channel: Entry) -> Entry | None:
    """Return the sampler that a channel takes its values from, None where it is broken."""
    samplers = channel.parent.get("samplers", ()) if channel.parent is not None else ()
    sampler: Entry | None = samplers[channel["sampler"]] if "sampler" in channel and samplers else None
    return sampler
