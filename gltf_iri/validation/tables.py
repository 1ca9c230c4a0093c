"""The tables that the walk reads: every object's fields, and where each extension stands.

They are stated in `gltf_iri.asset`, `gltf_iri.material` and `gltf_iri.scene`; tables.json is written from
there (`table_source`).
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from gltf_iri.validation.entry import Entry

__all__ = [
    "EXTENSIONS",
    "TABLES",
    "TARGETS",
    "Extension",
    "Field",
    "Table",
    "add_tables",
    "sound_value_of",
    "value_of",
]


class Field:
    """One property: the row of `gltf_iri.asset.tables.Row` with the same names, ready to be read."""

    __slots__ = (
        *("also_allowed", "choices", "colour_space", "counts_as_use", "default", "has_range", "high"),
        *(
            "is_per_component",
            "is_unique",
            "key",
            "kind",
            "low",
            "low_is_excluded",
            "max_items",
            "min_items",
            "multiple_of",
            "needs",
            "pattern",
        ),
        *("refers_to", "required", "shape", "table"),
    )

    def __init__(
        self,
        key: str,
        kind: str,
        shape: str = "ONE",
        *,
        required: bool = False,
        default: Any = None,
        low: float | None = None,
        high: float | None = None,
        low_is_excluded: bool = False,
        also_allowed: float | None = None,
        multiple_of: int | None = None,
        choices: tuple[int | str, ...] = (),
        refers_to: str = "",
        table: str = "",
        min_items: int = 1,
        max_items: int | None = None,
        is_unique: bool = False,
        needs: str = "",
        pattern: str = "",
        colour_space: str = "",
        counts_as_use: bool = True,
        is_per_component: bool = False,
    ) -> None:
        self.key = key
        self.kind = kind
        self.shape = shape
        self.required = required
        self.default = default
        self.low = low
        self.high = high
        self.low_is_excluded = low_is_excluded
        self.also_allowed = also_allowed
        self.multiple_of = multiple_of
        self.choices = choices
        self.refers_to = refers_to
        self.table = table
        self.min_items = min_items
        self.max_items = max_items
        self.is_unique = is_unique
        self.needs = needs
        self.pattern = re.compile(pattern) if pattern else None
        self.colour_space = colour_space
        self.counts_as_use = counts_as_use
        self.is_per_component = is_per_component
        self.has_range = low is not None or high is not None


class Table:
    """One kind of object: its fields by key, and which must or must not stand together.

    parts : those properties of which the object has only the one that its "type" names.
    listed_by : the extension whose object at the root has the list that the object's indices mean, or "".
    """

    __slots__ = ("fields", "listed_by", "name", "needing", "one_of", "parts", "required")

    def __init__(
        self,
        name: str,
        fields: list[Field],
        *,
        one_of: tuple[str, ...] = (),
        parts: frozenset[str] = frozenset(),
    ) -> None:
        self.name = name
        self.fields = {field.key: field for field in fields}
        self.required = tuple(field.key for field in fields if field.required)
        self.needing = tuple((field.key, field.needs) for field in fields if field.needs)
        self.one_of = one_of
        self.parts = parts
        lists = [field.refers_to.rpartition(".")[0] for field in fields if field.refers_to]
        self.listed_by = next((name for name in lists if name not in {"", "animation"}), "")


class Extension:
    """Where an extension's objects stand: name of the carrier's table to the table of what it carries."""

    __slots__ = ("is_required", "name", "objects", "stands_alone", "widens")

    def __init__(
        self,
        name: str,
        objects: dict[str, str],
        *,
        is_required: bool = False,
        stands_alone: bool = False,
        widens: tuple[tuple[str, str, str], ...] = (),
    ) -> None:
        self.name = name
        self.objects = objects
        self.is_required = is_required
        self.stands_alone = stands_alone
        self.widens = widens


def add_tables(stated: dict[str, Any]) -> None:
    """Add objects and extensions in the form of tables.json; ValueError where one is known already."""
    known = (stated["objects"].keys() & TABLES) | (stated["extensions"].keys() & EXTENSIONS)
    if known:
        raise ValueError(f"{min(known)} is known already")
    parts, one_of = stated.get("parts", {}), stated.get("oneOf", {})
    for name, rows in stated["objects"].items():
        TABLES[name] = Table(
            name,
            [Field(**row) for row in rows],
            one_of=tuple(one_of.get(name, ())),
            parts=frozenset(parts.get(name, ())),
        )
        TARGETS.update(row["refers_to"] for row in rows if "refers_to" in row)
    for name, extension in stated["extensions"].items():
        EXTENSIONS[name] = Extension(
            name,
            extension["objects"],
            is_required=extension.get("isRequired", False),
            stands_alone=extension.get("standsAlone", False),
            widens=tuple(map(tuple, extension.get("widens", ()))),
        )


def value_of(entry: Entry, key: str) -> Any:
    """Return a property of `entry`, or where it is absent the default that glTF states, if it has one."""
    return entry[key] if key in entry else TABLES[entry.table].fields[key].default


def sound_value_of(entry: Entry, key: str) -> Any:
    """Return the same, but None where the file states a value that was told of as broken.

    A null is told of too, but counts as if the property were left out, as for the Khronos validator.
    """
    return None if entry.raw.get(key) is not None and key not in entry else value_of(entry, key)


TABLES: dict[str, Table] = {}
EXTENSIONS: dict[str, Extension] = {}
# The arrays that indices refer to.
TARGETS: set[str] = set()
add_tables(json.loads(Path(__file__).with_name("tables.json").read_text(encoding="utf-8")))
