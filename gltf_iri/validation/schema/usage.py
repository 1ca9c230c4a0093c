"""What nothing refers to: after the links were followed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.schema.links import is_whole
from gltf_iri.validation.tables import TARGETS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry

__all__ = ["check_usage"]

# A user chooses among the scenes, whether or not one of them is the first to be shown.
_USED_BY_THEMSELVES = "scenes"
_OF_EACH_ANIMATION = "animation.samplers"


def check_usage(asset: Asset) -> None:
    """Tell of objects that indices could refer to, but that none does."""
    for name in sorted(TARGETS):
        if name == _OF_EACH_ANIMATION:
            for animation in asset.array("animations"):
                if animation is not None and is_whole(animation):
                    _tell_unused(asset, animation.get("samplers", ()))
        elif name != _USED_BY_THEMSELVES:
            _tell_unused(asset, asset.array(name))


def _tell_unused(asset: Asset, entries: Iterable[Entry | None]) -> None:
    for entry in entries:
        if entry is not None and not entry.is_used:
            asset.collector.add(issue("UNUSED_OBJECT", entry.pointer))
