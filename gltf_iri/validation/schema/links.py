"""The links: every index refers to something, which thereby is used."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.schema.values import is_unlisted
from gltf_iri.validation.tables import TABLES

if TYPE_CHECKING:
    from typing import Any

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.tables import Field

    Targets = list[Entry | None]

__all__ = ["check_links", "is_whole"]

# An accessor without a format reads nothing, keyframes without channels play nothing, and sparse values
# without indices replace nothing: what they refer to is not used by them.
_ALL_OR_NOTHING = frozenset({"accessor", "accessor.sparse", "animation"})
_PARTS = frozenset(
    {
        *("accessor", "accessor.sparse.indices", "accessor.sparse.values"),
        *("animation.channel", "animation.channel.target", "animation.sampler"),
    }
)


def check_links(asset: Asset) -> None:
    """Tell of indices that refer to nothing and take them out of their entries; mark what is referred to."""
    lists: dict[str, Targets] = {}
    for entry, field in asset.references:
        name = field.refers_to
        if name not in lists:
            lists[name] = asset.array(name)
        targets = lists[name]
        if name == "animation.samplers":
            targets = entry.parent.get("samplers", []) if entry.parent is not None else []
        listed_by = TABLES[entry.table].listed_by
        if listed_by and listed_by not in asset.root.extensions:
            # There is no list at all to look into, which is told once for the object.
            del entry[field.key]
            continue
        value = entry[field.key]
        # Nearly all references are one index that is right.
        if isinstance(value, int) and value < len(targets) and not _is_dead(entry):
            target = targets[value]
            if target is not None:
                target.is_used = target.is_used or field.counts_as_use
                continue
        _Link(asset, entry, field, targets).resolve(value)


def is_whole(entry: Entry) -> bool:
    """Tell whether all properties are there that the object must have."""
    table = TABLES[entry.table]
    return all(key in entry or is_unlisted(table.fields[key], entry.raw.get(key)) for key in table.required)


def _is_dead(entry: Entry) -> bool:
    """Tell whether the object, or one that holds it, means nothing because parts of it are missing."""
    holder: Entry | None = entry if entry.table in _PARTS else None
    while holder is not None:
        if holder.table in _ALL_OR_NOTHING and not is_whole(holder):
            return True
        holder = holder.parent
    return False


class _Link:
    """What the indices of one property refer to."""

    __slots__ = ("_asset", "_entry", "_is_dead", "_is_use", "_key", "_targets")

    def __init__(self, asset: Asset, entry: Entry, field: Field, targets: Targets) -> None:
        self._asset = asset
        self._entry = entry
        self._key = field.key
        self._targets = targets
        self._is_dead = _is_dead(entry)
        self._is_use = field.counts_as_use and not self._is_dead

    def resolve(self, value: Any) -> None:
        """Follow one index, a list of them, a map, or a list of maps."""
        key = self._key
        if isinstance(value, int):
            if not self._is_resolved(value, key):
                del self._entry[key]
        elif isinstance(value, dict):
            self._resolve_map(value, key)
        else:
            for position, item in enumerate(value):
                if isinstance(item, dict):
                    self._resolve_map(item, key, position)
                elif item is not None and not self._is_resolved(item, key, position):
                    value[position] = None

    def _is_resolved(self, index: int, *keys: str | int) -> bool:
        target = self._targets[index] if index < len(self._targets) else None
        if target is None:
            if not self._is_dead:
                self._asset.collector.add(issue("UNRESOLVED_REFERENCE", self._entry.at(*keys), index=index))
            return False
        if self._is_use:
            target.is_used = True
        return True

    def _resolve_map(self, indices: dict[str, Any], *keys: str | int) -> None:
        for name, index in list(indices.items()):
            if not self._is_resolved(index, *keys, name):
                del indices[name]
