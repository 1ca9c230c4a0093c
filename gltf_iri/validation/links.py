"""The links: every index refers to something, and what nothing refers to is told at the end."""

from __future__ import annotations

from typing import Any

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.tables import Field

__all__ = ["check_links"]


def check_links(asset: Asset) -> None:
    """Tell of indices that refer to nothing and take them out of their entries; mark what is referred to."""
    for entry, field in asset.references:
        targets = _targets(asset, entry, field)
        value = entry[field.key]
        if isinstance(value, int):
            if not _is_resolved(asset, entry, targets, value, field.key):
                del entry[field.key]
        elif isinstance(value, dict):
            _check_map(asset, entry, targets, value, field.key)
        else:
            for position, item in enumerate(value):
                if isinstance(item, dict):
                    _check_map(asset, entry, targets, item, field.key, position)
                elif item is not None and not _is_resolved(asset, entry, targets, item, field.key, position):
                    value[position] = None


def _targets(asset: Asset, entry: Entry, field: Field) -> list[Entry | None]:
    if field.refers_to == "animation.samplers":
        animation = entry.parent
        found: list[Entry | None] = animation.get("samplers", []) if animation is not None else []
        return found
    return asset.array(field.refers_to)


def _check_map(
    asset: Asset, entry: Entry, targets: list[Entry | None], indices: dict[str, Any], *keys: str | int
) -> None:
    for name, index in list(indices.items()):
        if not _is_resolved(asset, entry, targets, index, *keys, name):
            del indices[name]


def _is_resolved(
    asset: Asset, entry: Entry, targets: list[Entry | None], index: int, *keys: str | int
) -> bool:
    target = targets[index] if index < len(targets) else None
    if target is None:
        asset.collector.add(issue("UNRESOLVED_REFERENCE", entry.at(*keys), index=index))
        return False
    target.is_used = True
    return True
