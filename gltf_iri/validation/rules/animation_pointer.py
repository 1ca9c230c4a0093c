"""KHR_animation_pointer: the channel's target says that a pointer stands in the node's place."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.words import shown
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.animation_parts import parts
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def target_leaves_all_to_the_pointer(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Beside a pointer the target names no node, and its path is "pointer"."""
    yield issue("INCOMPLETE_EXTENSION_SUPPORT", entry.pointer)
    target = entry.parent
    if target is None:
        return
    animation = target.parent.parent if target.parent is not None else None
    # Without samplers there are no channels to speak of.
    if "node" in target and animation is not None and all(parts(animation)):
        yield issue("KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE", entry.pointer)
    path = target.raw.get("path")
    if path != "pointer":
        code = "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH"
        yield issue(code, entry.pointer, path="missing" if path is None else shown(path))


RULES: Rules = {"KHR_animation_pointer": (target_leaves_all_to_the_pointer,)}
