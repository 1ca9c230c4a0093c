from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.asset.tables import OBJECTS, Kind, Row, Shape


def schema(shared_dir: Path, name: str) -> dict[str, Any]:
    path = shared_dir / "khr-schemas" / "core" / f"{name}.schema.json"
    loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return loaded


def test_every_reference_and_table_exists() -> None:
    arrays = {row.key for row in OBJECTS["glTF"] if row.shape is Shape.ARRAY and row.kind is Kind.OBJECT}
    for name, rows in OBJECTS.items():
        for row in rows:
            if row.kind is Kind.INDEX:
                assert row.refers_to in arrays | {"animation.samplers"}, (name, row.key)
            if row.kind is Kind.OBJECT and row.key != "materials":
                assert row.table in OBJECTS, (name, row.key)
            if row.default is not None and row.shape is Shape.ONE and row.choices:
                assert row.default in row.choices


@pytest.mark.parametrize("name", list(OBJECTS))
def test_rows_agree_with_the_published_schema(name: str, shared_dir: Path) -> None:
    published = schema(shared_dir, name)
    rows = {row.key: row for row in OBJECTS[name]}
    properties = {
        key: value for key, value in published["properties"].items() if key not in ("extensions", "extras")
    }
    assert set(rows) == set(properties)
    assert {key for key, row in rows.items() if row.required} == set(published.get("required", []))
    for key, value in properties.items():
        row = rows[key]
        assert row.low == value.get("minimum", value.get("exclusiveMinimum", row_low_inside(row, value))), key
        assert row.low_is_excluded == ("exclusiveMinimum" in value), key
        if row.shape is Shape.ONE:
            assert row.high == value.get("maximum"), key
            assert row.multiple_of == value.get("multipleOf"), key
            assert row.default == value.get("default"), key
            assert set(row.choices) == {c["const"] for c in value.get("anyOf", []) if "const" in c}, key
        elif row.shape is Shape.ARRAY:
            assert row.min_items == value.get("minItems", 0), key
            assert row.max_items == value.get("maxItems"), key
            assert list(row.default or []) == value.get("default", []), key
            assert row.is_unique == value.get("uniqueItems", False), key
    needs = {key: row.needs for key, row in rows.items() if row.needs}
    assert needs == {key: value[0] for key, value in published.get("dependencies", {}).items()}


def row_low_inside(row: Row, value: dict[str, Any]) -> float | None:
    """Find the minimum that the schema states for an array's items or for any index."""
    items = value.get("items", {})
    return 0 if row.kind is Kind.INDEX else items.get("minimum") if isinstance(items, dict) else None
