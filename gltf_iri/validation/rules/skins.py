"""Skins: their joints hang together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES", "joints_of"]


def joints_hang_together(root: Entry, asset: Asset) -> Iterator[Issue]:
    """All joints of a skin have an ancestor in common, and its skeleton is one."""
    for skin in asset.array("skins"):
        if skin is None:
            continue
        joints, trees = joints_of(skin), asset.trees
        if "joints" in skin and len({trees.tops[joint] for joint in joints}) != 1:
            yield issue("SKIN_NO_COMMON_ROOT", skin.at("joints"))
        if "skeleton" in skin:
            skeleton = skin["skeleton"]
            if not joints or not all(trees.is_above(skeleton, joint) for joint in joints):
                yield issue("SKIN_SKELETON_INVALID", skin.at("skeleton"))


def joints_of(skin: Entry) -> list[int]:
    """Return those joints that are nodes of the file."""
    return [joint for joint in skin.get("joints", ()) if joint is not None]


RULES: Rules = {"glTF": (joints_hang_together,)}
