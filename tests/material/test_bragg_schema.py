"""The schema of EXT_materials_bragg and the rows that the code reads files by say the same."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.bragg_limits import BRAGG_CELLS_MAX, BRAGG_LAYERS_MAX
from gltf_iri.material.fields import Kind, Property, properties

SCHEMAS = Path(__file__).resolve().parents[2] / "spec" / "EXT_materials_bragg" / "schema"
MATERIAL = "material.EXT_materials_bragg.schema.json"
LAYER = "material.EXT_materials_bragg.layer.schema.json"
ROWS = {
    MATERIAL: [row for _, row in properties(Bragg)],
    LAYER: [row for _, row in properties(MirrorLayer)],
}
TYPES = {Kind.NUMBER: "number", Kind.WHOLE_NUMBER: "integer", Kind.NESTED_LIST: "array", Kind.TEXTURE: None}


def schema(name: str) -> dict[str, Any]:
    parsed = json.loads((SCHEMAS / name).read_text(encoding="utf-8"))
    assert isinstance(parsed, dict)
    return parsed


def test_no_other_schema_lies_in_the_folder() -> None:
    assert {path.name for path in SCHEMAS.iterdir()} == set(ROWS)


@pytest.mark.parametrize("name", ROWS)
def test_schema_and_code_have_the_same_properties_in_the_same_order(name: str) -> None:
    stated = [key for key in schema(name)["properties"] if key not in ("extensions", "extras")]
    assert stated == [row.key for row in ROWS[name]]


@pytest.mark.parametrize(
    ("name", "row"), [pytest.param(name, row, id=row.key) for name, rows in ROWS.items() for row in rows]
)
def test_schema_and_code_agree_on_type_default_and_range(name: str, row: Property) -> None:
    stated = schema(name)["properties"][row.key]
    assert stated.get("type") == TYPES[row.kind]
    assert stated.get("minimum") == row.low
    assert stated.get("maximum") == row.high
    assert not row.low_is_excluded
    assert "exclusiveMinimum" not in stated
    assert stated.get("default") == (None if row.kind is Kind.NESTED_LIST else row.default)
    assert "required" not in schema(name)


@pytest.mark.parametrize("row", ROWS[MATERIAL], ids=lambda row: row.key)
def test_textures_state_channel_and_colour_space_as_the_code_reads_them(row: Property) -> None:
    stated = schema(MATERIAL)["properties"][row.key]
    is_texture = {"$ref": "textureInfo.schema.json"} in stated.get("allOf", [])
    assert is_texture == (row.kind is Kind.TEXTURE)
    if is_texture:
        told = stated["gltf_detailedDescription"]
        assert f"sampled from the {row.channels.upper()} channel" in told
        assert f"These values are {row.colour_space}." in told
        assert "a value of `1.0` **MUST** be assumed" in told


def test_what_every_implementation_accepts_is_what_the_code_draws() -> None:
    stated = schema(MATERIAL)["properties"]["layers"]
    assert stated["items"] == {"$ref": LAYER}
    assert stated["minItems"] == 1
    assert (
        f"{('none', 'one', 'two', 'three', 'four')[BRAGG_LAYERS_MAX]} layers"
        in stated["gltf_detailedDescription"]
    )
    cells = schema(LAYER)["properties"]["cells"]
    assert f"at least {BRAGG_CELLS_MAX} cells" in cells["gltf_detailedDescription"]
