"""The links: every index refers to something, which thereby is used."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.tables import TABLES
from gltf_iri.validation.values import is_unlisted

if TYPE_CHECKING:
    from typing import Any

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.tables import Field

__all__ = ["check_links", "is_whole"]

# Keyframes without channels play nothing, and sparse values without indices or without elements to replace
# replace nothing: what they refer to is not used by them.
_ALL_OR_NOTHING = frozenset({"accessor", "accessor.sparse", "animation"})


def check_links(asset: Asset) -> None:
    """Tell of indices that refer to nothing and take them out of their entries; mark what is referred to."""
    for entry, field in asset.references:
        key = field.key
        if _has_no_list(asset, entry):
            del entry[key]
            continue
        link = _Link(asset, entry, field)
        value = entry[key]
        if isinstance(value, int):
            if not link.is_resolved(value, key):
                del entry[key]
        elif isinstance(value, dict):
            link.resolve_map(value, key)
        else:
            for position, item in enumerate(value):
                if isinstance(item, dict):
                    link.resolve_map(item, key, position)
                elif item is not None and not link.is_resolved(item, key, position):
                    value[position] = None


def _has_no_list(asset: Asset, entry: Entry) -> bool:
    """Whether there is no list at all to look into, which is told once for its holder."""
    extension = TABLES[entry.table].listed_by
    return bool(extension) and extension not in asset.root.extensions


def is_whole(entry: Entry) -> bool:
    """Tell whether all properties are there that the object must have."""
    table = TABLES[entry.table]
    return all(key in entry or is_unlisted(table.fields[key], entry.raw.get(key)) for key in table.required)


def _is_dead(entry: Entry) -> bool:
    """Tell whether the object is a part of one that means nothing, because other parts are missing."""
    holder = entry.parent
    while holder is not None:
        if holder.table in _ALL_OR_NOTHING and not is_whole(holder):
            return True
        holder = holder.parent
    return False


class _Link:
    """What the indices of one property refer to."""

    __slots__ = ("_asset", "_counts_as_use", "_entry", "_is_dead", "_targets")

    def __init__(self, asset: Asset, entry: Entry, field: Field) -> None:
        self._asset = asset
        self._entry = entry
        self._is_dead = _is_dead(entry)
        self._counts_as_use = field.counts_as_use and not self._is_dead
        self._targets: list[Entry | None]
        if field.refers_to == "animation.samplers":
            self._targets = entry.parent.get("samplers", []) if entry.parent is not None else []
        else:
            self._targets = asset.array(field.refers_to)

    def is_resolved(self, index: int, *keys: str | int) -> bool:
        target = self._targets[index] if index < len(self._targets) else None
        if target is None:
            if not self._is_dead:
                self._asset.collector.add(issue("UNRESOLVED_REFERENCE", self._entry.at(*keys), index=index))
            return False
        if self._counts_as_use:
            target.is_used = True
        return True

    def resolve_map(self, indices: dict[str, Any], *keys: str | int) -> None:
        for name, index in list(indices.items()):
            if not self.is_resolved(index, *keys, name):
                del indices[name]
