"""Each fault is told by the one finding that names it, and by no other."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from proposal_shimmer import LAYER, MATERIAL, NAME, README, Edit, findings, in_json, in_text, write

from gltf_iri.proposal.finding import CODES

TEXTURE = ("properties", "shimmerTexture")
FACTOR = ("properties", "shimmerFactor")
POINTER = f"/materials/{{}}/extensions/{NAME}"


def set_at(*path_and_value: object):
    *path, last, value = path_and_value

    def change(tree):
        for step in path:
            tree = tree[step]
        tree[last] = value

    return change


def delete(*path: str):
    def change(tree):
        for step in path[:-1]:
            tree = tree[step]
        del tree[path[-1]]

    return change


def renamed(old: str, new: str) -> Edit:
    def edit(root: Path) -> None:
        (root / old).rename(root / new)

    return edit


def written(file: str, content: str | bytes) -> Edit:
    def edit(root: Path) -> None:
        (root / file).write_bytes(content if isinstance(content, bytes) else content.encode())

    return edit


def both(*edits: Edit) -> Edit:
    def edit(root: Path) -> None:
        for one in edits:
            one(root)

    return edit


def without_lines(file: str, *words: str) -> Edit:
    def edit(root: Path) -> None:
        lines = (root / file).read_text(encoding="utf-8").splitlines()
        kept = [line for line in lines if not any(word in line for word in words)]
        assert len(kept) < len(lines)
        (root / file).write_text("\n".join(kept), encoding="utf-8")

    return edit


DRAFT_4 = "http://json-schema.org/draft-04/schema"
DRAFT_7 = "http://json-schema.org/draft-07/schema"
CORE = "camera.schema.json"
CELLS = {"type": "integer", "description": "How many.", "minimum": 1}
EMPTY = {"type": "integer", "description": "None.", "minimum": 2, "maximum": 1}
GLOW = in_text(README, "| `cells` |", "| `glow` | `integer` | None. | No |\n| `cells` |")
CYCLE = {"allOf": [{"$ref": "#/definitions/a"}]}
# Each of twenty definitions refers to the next one twice.
LAUGHS = {
    f"d{i}": {"anyOf": [{"$ref": f"#/definitions/d{i + 1}"}, {"$ref": f"#/definitions/d{i + 1}"}]}
    for i in range(20)
} | {"d20": {}}
SCHEMA_LINK = f"schema/material.{NAME}.schema.json"

BROKEN: list[tuple[str, Edit]] = [
    # reading
    ("json-broken", in_text(MATERIAL, '"type": "object",', '"type": "object",,')),
    ("json-broken", written(LAYER, "[]")),
    ("readme-unreadable", written(README, b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")),
    ("readme-unreadable", written(README, "# x\0")),
    # drafts and keywords
    ("draft-missing", in_json(MATERIAL, delete("$schema"))),
    ("draft-unknown", in_json(MATERIAL, set_at("$schema", "http://json-schema.org/draft-99/schema"))),
    ("draft-unusual", in_json(LAYER, set_at("$schema", "http://json-schema.org/draft-07/schema"))),
    ("draft-of-materials", in_json(LAYER, set_at("$schema", "https://json-schema.org/draft/2020-12/schema"))),
    ("schema-illegal", in_json(MATERIAL, set_at(*FACTOR, "exclusiveMinimum", 0))),
    ("schema-illegal", in_json(MATERIAL, set_at(*FACTOR, "type", "float"))),
    ("keyword-of-another-draft", in_json(MATERIAL, set_at(*FACTOR, "const", 0))),
    ("keyword-unknown", in_json(MATERIAL, set_at(*FACTOR, "maximun", 2))),
    (
        "keyword-without-effect",
        in_json(MATERIAL, set_at(*FACTOR, "anyOf", [{"const": 0}, {"type": "number"}])),
    ),
    # references
    ("ref-unresolved", in_json(MATERIAL, set_at("allOf", 0, "$ref", "gltfProperty.schema.json"))),
    ("ref-unresolved", in_json(MATERIAL, set_at("properties", "layers", "items", {"$ref": "#/nowhere"}))),
    ("ref-unresolved", in_json(MATERIAL, set_at("properties", "layers", "items", {"$ref": 1}))),
    ("ref-outside", in_json(MATERIAL, set_at("allOf", 0, "$ref", "../../../../etc/passwd"))),
    ("ref-outside", in_json(MATERIAL, set_at("allOf", 0, "$ref", "https://example.org/a.schema.json"))),
    ("ref-outside", in_json(MATERIAL, set_at("allOf", 0, "$ref", "file:///etc/passwd"))),
    ("ref-cycle", in_json(MATERIAL, lambda t: t.update(definitions={"a": CYCLE}, anyOf=[CYCLE]))),
    ("ref-expansion", in_json(MATERIAL, set_at("definitions", LAUGHS))),
    ("ref-siblings", in_json(MATERIAL, set_at("properties", "layers", "items", "minProperties", 1))),
    ("ref-not-known", in_json(MATERIAL, set_at("properties", "shimmerFactor", "allOf", [{"$ref": CORE}]))),
    # names
    ("file-name", both(renamed(MATERIAL, "schema/a.schema.json"), in_text(README, SCHEMA_LINK, "schema"))),
    ("file-name", renamed(LAYER, "schema/layer.json")),
    ("schema-unused", written("schema/more.schema.json", json.dumps({"$schema": DRAFT_4, "title": "More"}))),
    ("title-missing", in_json(LAYER, delete("title"))),
    ("title-differs", in_json(MATERIAL, set_at("title", "EXT_materials_glimmer glTF Material Extension"))),
    # style
    ("type-object", in_json(LAYER, delete("type"))),
    ("base-missing", in_json(LAYER, delete("allOf"))),
    ("members-missing", in_json(MATERIAL, delete("properties", "extras"))),
    ("description-missing", in_json(MATERIAL, delete(*FACTOR, "description"))),
    ("description-missing-object", in_json(LAYER, delete("description"))),
    ("closed-object", in_json(LAYER, set_at("additionalProperties", False))),
    ("range-missing", in_json(LAYER, delete("properties", "thickness", "minimum"))),
    ("range-empty", both(in_json(LAYER, set_at("properties", "glow", EMPTY)), GLOW)),
    # defaults
    (
        "default-invalid",
        both(in_text(LAYER, "250.0", "-1"), in_text(README, "default: `250`", "default: `-1`")),
    ),
    (
        "default-acts",
        both(in_json(MATERIAL, set_at(*FACTOR, "default", 1.0)), in_text(README, "`0.0`", "`1.0`")),
    ),
    (
        "default-of-required",
        both(
            in_json(LAYER, set_at("properties", "cells", {**CELLS, "default": 1})),
            in_text(README, "Yes", "Yes, default: `1`"),
        ),
    ),
    ("default-of-texture", in_json(MATERIAL, set_at(*TEXTURE, "default", {"index": 0}))),
    ("empty-invalid", in_json(MATERIAL, set_at("minProperties", 1))),
    # textures
    ("texture-channel", in_text(MATERIAL, "the R channel, ", "")),
    ("texture-colour-space", in_text(MATERIAL, ", linear, ", ", ")),
    ("texture-absent-value", in_text(MATERIAL, ", 1.0 if it is not given", "")),
    # the README's sections and links
    ("heading-differs", in_text(README, "# EXT\\_materials\\_shimmer", "# EXT_materials_glimmer")),
    ("section-missing", in_text(README, "## Status", "## State")),
    ("section-missing-minor", in_text(README, "## Contributors", "## Who")),
    (
        "section-order",
        both(
            in_text(README, "## Overview", "## X"),
            in_text(README, "## Contrib", "## Overview\n\n## Contrib"),
        ),
    ),
    ("link-broken", in_text(README, "./figures/shimmer.png", "./figures/glimmer.png")),
    ("link-broken", in_text(README, f"]({SCHEMA_LINK})", "](schema/other.schema.json)")),
    ("link-anchor", in_text(README, "](#layers)", "](#cells)")),
    ("link-unverified", in_text(README, "](#layers)", "](../../../../../../../../../../etc/passwd)")),
    # the README's tables
    ("table-missing-property", without_lines(README, "**shimmerTexture**")),
    (
        "table-unknown-property",
        in_text(README, "| **layers**", "| **shine** | `x` | X. | No |\n| **layers**"),
    ),
    ("table-type", in_text(README, "**shimmerFactor** | `number`", "**shimmerFactor** | `integer`")),
    ("table-type", in_text(README, "`number[3]`", "`number[4]`")),
    ("table-type", in_text(README, "`layer[1-*]`", "`layer`")),
    ("table-required", in_text(README, ":white_check_mark: Yes", "No")),
    ("table-required", in_text(README, "as a texture. | No", "as a texture. | Yes")),
    ("table-default", in_text(README, "No, default: `250`", "No, default: `200`")),
    ("table-default", in_text(README, "`[1,1,1]`", "`[1,1]`")),
    ("table-default-missing", in_text(README, "No, default: `250`", "No")),
    ("table-default-unread", in_text(README, "No, default: `250`", "No, default: `PI`")),
    ("table-missing", without_lines(README, "| `thickness` |", "| `cells` |")),
    # the README's examples
    ("example-broken", in_text(README, '"shimmerFactor": 0.5,', '"shimmerFactor": 0.5')),
    ("example-broken", in_text(README, '"shimmerFactor": 0.5', '"shimmerFactor": NaN')),
    ("example-broken", in_text(README, '"shimmerFactor": 0.5', '"extras": 1, "extras": 2')),
    ("example-abbreviated", in_text(README, '"shimmerFactor": 0.5,', '"shimmerFactor": 0.5, // half\n ...,')),
    ("example-invalid", in_text(README, '"shimmerFactor": 0.5', '"shimmerFactor": 2')),
    ("example-invalid", in_text(README, '"index": 0, ', "")),
    ("example-invalid", in_text(README, ', "cells": 4', "")),
    ("example-unknown-property", in_text(README, '"shimmerFactor": 0.5', '"shimmer": 0.5')),
    ("example-unknown-property", in_text(README, '"thickness": 300.0', '"thick": 300.0')),
    ("example-undeclared", in_text(README, f'"extensionsUsed": ["{NAME}"]', '"extensionsUsed": []')),
    (
        "example-required",
        in_text(README, '"extensionsUsed"', f'"extensionsRequired": ["{NAME}"],\n"extensionsUsed"'),
    ),
    ("example-language", in_text(README, "```json", "```javascript")),
    # other extensions, and pointers
    ("exclusion-contradicted", in_text(README, "glimmer` is excluded", "glimmer` is, too")),
    (
        "exclusion-contradicted",
        in_text(README, '"extensions": {', '"extensions": {"EXT_materials_glimmer": {},'),
    ),
    ("exclusion-one-sided", written(f"../EXT_materials_glimmer/{README}", "# EXT_materials_glimmer\n")),
    ("exclusion-unverified", in_text(README, "glimmer`.", "glimmer` or `EXT_materials_glow`.")),
    ("exclusion-to-propose", in_text(README, "glimmer`.", "glimmer` or `KHR_materials_unlit`.")),
    ("exclusion-unanswered", without_lines(README, "must not be used on")),
    ("pointer-missing", without_lines(README, f"`{POINTER}/layers/{{}}/thickness`")),
    ("pointer-missing", without_lines(README, "KHR_texture_transform/rotation")),
    ("pointer-type", in_text(README, "shimmerColorFactor` | `float3`", "shimmerColorFactor` | `float4`")),
    (
        "pointer-unknown",
        in_text(README, "|---------|------|\n", f"|---------|------|\n| `{POINTER}/x` | `float` |\n"),
    ),
    ("pointer-table-missing", in_text(README, "| Pointer |", "| Place |")),
]


@pytest.mark.parametrize(("code", "edit"), BROKEN, ids=[f"{i}-{code}" for i, (code, _) in enumerate(BROKEN)])
def test_a_fault_is_told_by_the_finding_that_names_it_alone(tmp_path: Path, code: str, edit: Edit) -> None:
    root = write(tmp_path)
    edit(root)
    assert [finding.code for finding in findings(root)] == [code]


def test_the_proposal_without_a_fault_has_no_finding(tmp_path: Path) -> None:
    assert findings(write(tmp_path)) == []


# Told by tests of their own: of folders, of whole registries, of hostile files.
ELSEWHERE = {
    *("schema-missing", "folder-too-large", "check-too-costly", "name-form", "name-case", "name-parts"),
    *("file-scope", "file-scope-missing", "scope-differs", "property-case", "type-missing"),
    *("base-missing-inside", "id-differs", "default-missing", "default-may-act"),
    *("example-fragment", "example-too-large"),
}


def test_every_code_has_a_proposal_that_it_is_told_of() -> None:
    assert {code for code, _ in BROKEN} | ELSEWHERE == set(CODES)
