"""What a folder may hold, what its names say, and what is not checked is said."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from proposal_shimmer import LAYER, MATERIAL, NAME, README, findings, in_json, in_text, write

from gltf_iri.proposal.check import check_proposal

DRAFT_4 = "http://json-schema.org/draft-04/schema"
DRAFT_2020 = "https://json-schema.org/draft/2020-12/schema"


def codes(folder: Path) -> list[str]:
    return [finding.code for finding in findings(folder)]


def alone(folder: Path, name: str, scope: str, properties: dict, **more: object) -> Path:
    """Write an extension of a single schema without README, lying flat in its folder."""
    root = folder / name
    root.mkdir()
    schema = {
        "$schema": DRAFT_4,
        "title": f"{name} extension",
        "type": "object",
        "description": "All.",
        "allOf": [{"$ref": "glTFProperty.schema.json"}],
        "properties": {**properties, "extensions": {}, "extras": {}},
        **more,
    }
    file = f"{scope}.{name}.schema.json" if scope else f"{name}.schema.json"
    (root / file).write_text(json.dumps(schema), encoding="utf-8")
    return root


SIZE = {"type": "number", "description": "Its size.", "minimum": 0}


def test_schemas_may_lie_beside_the_readme(tmp_path):
    root = write(tmp_path)
    for path in (root / "schema").iterdir():
        path.rename(root / path.name)
    (root / "schema").rmdir()
    assert codes(root) == ["link-broken"]  # the README still speaks of schema/


def test_without_a_readme_its_checks_are_skipped_and_that_is_said(tmp_path):
    root = write(tmp_path)
    (root / README).unlink()
    report = check_proposal(root)
    assert report.findings == ()
    assert set(report.skipped.values()) == {"there is no README.md"}
    assert {"property tables", "examples", "exclusions", "pointers", "links"} <= set(report.skipped)
    assert not set(report.skipped) & set(report.checked)


def test_checks_that_unsound_schemas_prevent_are_skipped_and_that_is_said(tmp_path):
    root = write(tmp_path)
    in_json(MATERIAL, lambda tree: tree.pop("$schema"))(root)
    report = check_proposal(root)
    assert report.skipped["defaults"] == "the schemas are not sound: draft-missing"
    assert "links" in report.checked


def test_an_empty_folder_has_no_schema(tmp_path):
    (tmp_path / NAME).mkdir()
    assert codes(tmp_path / NAME) == ["schema-missing"]


def test_more_schemas_than_any_extension_has_are_not_read(tmp_path):
    root = write(tmp_path)
    for number in range(100):
        (root / "schema" / f"zz{number}.schema.json").write_text("{}", encoding="utf-8")
    assert "folder-too-large" in codes(root)


@pytest.mark.parametrize(
    ("name", "scope", "expected"),
    [
        ("EXT_materials_gloss", "material", []),
        ("shimmer", "material", ["name-form"]),
        ("ext_materials_gloss", "material", ["name-form"]),
        ("EXT_materials_superGloss", "material", ["name-case"]),
        ("EXT_gloss", "material", ["name-parts"]),
        ("EXT_materials_gloss", "surface", ["file-scope"]),
        ("EXT_materials_gloss", "", ["file-scope-missing"]),
        ("EXT_materials_gloss", "glTF", ["scope-differs"]),
        ("EXT_lights_gloss", "glTF", []),
    ],
)
def test_names_tell_what_is_extended(tmp_path, name, scope, expected):
    assert codes(alone(tmp_path, name, scope, {"size": SIZE})) == expected


@pytest.mark.parametrize(
    ("properties", "more", "expected"),
    [
        ({"Size": SIZE}, {}, ["property-case"]),
        ({"big_size": SIZE}, {}, ["property-case"]),
        ({"size": {"description": "Of any type."}}, {}, ["type-missing"]),
        ({"size": {**SIZE, "default": 1}}, {"required": ["size"]}, ["default-of-required", "empty-invalid"]),
        ({"sizeFactor": SIZE}, {}, ["default-missing"]),
        ({"sizeFactor": {**SIZE, "default": 2}}, {}, ["default-may-act"]),
        ({"sizeFactor": {**SIZE, "default": 0}, "oneFactor": {**SIZE, "default": 1}}, {}, []),
        (
            {"part": {"type": "object", "description": "A part.", "properties": {"size": SIZE}}},
            {},
            ["base-missing-inside", "members-missing"],
        ),
        (
            {"size": {**SIZE, "default": 0.5, "maximum": 1, "exclusiveMinimum": True}},
            {"$schema": DRAFT_4},
            [],
        ),
    ],
)
def test_properties_keep_to_the_style(tmp_path, properties, more, expected):
    assert codes(alone(tmp_path, "EXT_materials_gloss", "material", properties, **more)) == expected


@pytest.mark.parametrize(
    ("feature", "default", "expected"), [("specular", 1, []), ("mist", 1, ["default-acts"])]
)
def test_a_factor_of_one_is_harmless_where_it_scales_what_is_there_anyway(
    tmp_path, feature, default, expected
):
    factor = {f"{feature}Factor": {**SIZE, "default": default}}
    assert codes(alone(tmp_path, f"EXT_materials_{feature}", "material", factor)) == expected


def test_a_default_is_judged_in_its_own_schemas_draft(tmp_path):
    """In draft-04 `exclusiveMinimum` is a switch beside `minimum`, in 2020-12 a number by itself."""
    strict = {"type": "number", "description": "A size.", "default": 0.5}
    old = {**strict, "minimum": 0.25, "exclusiveMinimum": True}
    new = {**strict, "exclusiveMinimum": 0.75}
    assert codes(alone(tmp_path, "EXT_node_old", "node", {"size": old})) == []
    told = codes(alone(tmp_path, "EXT_node_new", "node", {"size": new}, **{"$schema": DRAFT_2020}))
    assert told == ["default-invalid"]


def test_a_schema_is_known_by_its_files_name(tmp_path):
    schema = {"$schema": DRAFT_2020, "$id": "gloss"}
    assert codes(alone(tmp_path, "EXT_node_gloss", "node", {"size": SIZE}, **schema)) == ["id-differs"]


def test_an_object_that_contains_itself_is_followed_once(tmp_path):
    part = {"type": "array", "description": "Parts.", "items": {"$ref": "#"}}
    assert codes(alone(tmp_path, "EXT_node_tree", "node", {"parts": part})) == []


def test_members_without_braces_are_an_example_all_the_same(tmp_path):
    root = write(tmp_path)
    in_text(README, '```json\n{\n  "asset": { "version": "2.0" },', "```json\n")(root)
    in_text(README, "  ]\n}\n```", "  ]\n```")(root)
    assert codes(root) == ["example-fragment"]
    in_text(README, '"shimmerFactor": 0.5', '"shimmerFactor": 2')(root)
    assert codes(root) == ["example-fragment", "example-invalid"]


def test_an_example_may_not_be_endless(tmp_path):
    root = write(tmp_path)
    in_text(README, "```json\n{", "```json\n{" + " " * 20_000)(root)
    assert codes(root) == ["example-too-large"]


def test_layers_hold_the_type_that_their_schema_states(tmp_path):
    root = write(tmp_path)
    in_json(LAYER, lambda tree: tree["properties"]["cells"].update(type="number"))(root)
    assert codes(root) == ["table-type", "pointer-missing"]


def test_an_object_may_have_a_table_instead_of_a_row(tmp_path):
    root = write(tmp_path)
    part = {"type": "object", "description": "A part.", "properties": {"deep": SIZE}}
    in_json(LAYER, lambda tree: tree["properties"].update(part=part))(root)
    style = {"base-missing-inside", "members-missing", "pointer-missing"}
    assert set(codes(root)) - style == {"table-missing-property", "table-missing"}
    table = "| Property | Type | Description |\n|-|-|-|\n| `deep` | `number` | Deep. |\n\n## Interaction"
    in_text(README, "## Interaction", table)(root)
    assert set(codes(root)) == style


def test_sections_may_be_called_as_in_the_template(tmp_path):
    root = write(tmp_path)
    in_text(README, "## Schema", "## glTF Schema Updates\n\n### JSON Schema")(root)
    assert codes(root) == []


@pytest.mark.parametrize(
    "cell", ["No, default:`250.0`", "No, default: 250", "No (default: `250`)", "No. Default is `2.5e2`"]
)
def test_a_default_may_be_written_in_many_ways(tmp_path, cell):
    root = write(tmp_path)
    in_text(README, "No, default: `250`", cell)(root)
    assert codes(root) == []


def test_a_default_of_an_array_needs_no_code_marks(tmp_path):
    root = write(tmp_path)
    in_text(README, "No, default: `[1,1,1]`", "No, default: [1.0, 1.0, 1.0]")(root)
    assert codes(root) == []


def test_defaults_may_have_a_column_of_their_own(tmp_path):
    root = write(tmp_path)
    in_text(
        README, "| Property | Type | Description | Required |", "| Name | Type | Default | Description |"
    )(root)
    in_text(README, "| `number` | In nm. | No, default: `250` |", "| `number` | `250` | In nm. |")(root)
    in_text(README, "| `integer` | How many. | :white_check_mark: Yes |", "| `integer` | | How many. |")(root)
    assert codes(root) == []
    in_text(README, "`250`", "`25`")(root)
    assert codes(root) == ["table-default"]
