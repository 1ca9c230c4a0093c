"""A proposal may be made to harm: it is told of in findings, without a traceback and without end."""

from __future__ import annotations

import json
import os
import random
from pathlib import Path

import pytest
from proposal_shimmer import LAYER, MATERIAL, README, findings, write

from gltf_iri.cli.main import run
from gltf_iri.proposal.bounds import MAX_FINDINGS

DEPTH = 100_000


def codes(folder: Path) -> set[str]:
    return {finding.code for finding in findings(folder)}


@pytest.mark.parametrize(
    "content",
    [
        b'{"a":' * DEPTH + b"1" + b"}" * DEPTH,
        b"[" * DEPTH,
        b'{"allOf":[' * 30 + b"{}" + b"]}" * 30,
        b'{"minimum": NaN}',
        b'{"minimum": 1e999}',
        b'{"title": "a", "title": "b"}',
        b"\xef\xbb\xbf{}",
        b"\xff\xfe{\0}\0",
        b"",
        b"null",
        b'{"title": "\\ud800"}',
        b'{"enum": [' + b"1," * 2000 + b"1]}",
        b'{"description": "' + b"a" * 2**17 + b'"}',
    ],
    ids=lambda content: repr(content[:12]),
)
def test_a_file_that_no_reader_should_trust_is_broken_json(tmp_path, content):
    root = write(tmp_path)
    (root / LAYER).write_bytes(content)
    assert codes(root) == {"json-broken"}


def test_a_huge_file_is_not_read(tmp_path):
    root = write(tmp_path)
    for name in (LAYER, README):
        with (root / name).open("r+b") as file:
            file.truncate(2**40)
    assert codes(root) == {"json-broken", "readme-unreadable"}


@pytest.mark.parametrize("name", [LAYER, README])
def test_links_out_of_the_folder_and_loops_are_not_followed(tmp_path, name):
    root = write(tmp_path)
    (root / name).unlink()
    (root / name).symlink_to("/etc/passwd")
    (root / "schema" / "loop").symlink_to(root)
    assert codes(root) == {"json-broken" if name == LAYER else "readme-unreadable"}
    (root / name).unlink()
    (root / name).symlink_to(root / name)
    assert codes(root) == {"json-broken" if name == LAYER else "readme-unreadable"}


def test_a_folder_of_schemas_that_is_a_loop_holds_none(tmp_path):
    root = tmp_path / "EXT_materials_loop"
    root.mkdir()
    (root / "schema").symlink_to("schema")
    assert codes(root) == {"schema-missing"}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_named_pipe_is_not_waited_for(tmp_path):
    root = write(tmp_path)
    for name in (LAYER, README):
        (root / name).unlink()
        os.mkfifo(root / name)
    assert codes(root) == {"json-broken", "readme-unreadable"}


def test_a_readme_that_is_a_folder_cannot_be_read(tmp_path):
    root = write(tmp_path)
    (root / README).unlink()
    (root / README).mkdir()
    assert codes(root) == {"readme-unreadable"}


def test_regular_expressions_that_never_end_are_not_tried(tmp_path):
    root = write(tmp_path)
    tree = json.loads((root / LAYER).read_text())
    trap = {"type": "string", "description": "A.", "pattern": "^(a+)+$", "default": "a" * 64 + "!"}
    tree["properties"]["trap"] = trap
    (root / LAYER).write_text(json.dumps(tree))
    assert codes(root) == {"table-missing-property"}


def test_objects_that_double_at_each_level_are_given_up(tmp_path):
    """Each level of the value is judged twice, so that forty levels would take 2**40 looks."""
    root = write(tmp_path)
    tree = json.loads((root / LAYER).read_text())
    twice = {"allOf": [{"properties": {"a": {"$ref": "#/definitions/t"}}}] * 2}
    value: dict = {}
    for _ in range(30):
        value = {"a": value}
    tree["definitions"] = {"t": twice, "u": {"allOf": [{"$ref": "#/definitions/t"}], "default": value}}
    (root / LAYER).write_text(json.dumps(tree))
    assert codes(root) == {"check-too-costly"}


@pytest.mark.parametrize(
    "line",
    [
        "|" * 200_000,
        "`" * 200_001,
        "[](" * 60_000,
        "![" * 100_000,
        '<a href="' * 20_000,
        "#" * 200_000,
        "# " * 100_000,
        "* " * 100_000,
        "A_" * 100_000,
        "default " + " " * 200_000,
        "```json\n" + "[" * 10_000,
        "```json\n" + '"' * 10_000,
        "<!-- " * 50_000,
    ],
    ids=lambda line: line[:8],
)
def test_a_readme_of_one_endless_line_is_read_in_time(tmp_path, line):
    root = write(tmp_path)
    table = (
        "\n\n| | Type | Description | Required |\n|-|-|-|-|\n| cells | x | x | default"
        + " " * 100_000
        + "|\n"
    )
    (root / README).write_text((root / README).read_text() + table + line)
    assert len(findings(root)) <= MAX_FINDINGS + 20


@pytest.mark.parametrize(
    "section",
    [
        "## Interactions: " + "EXT_materials_glimmer " * 20_000 + "\n\n" + "That is not so.\n\n" * 10_000,
        "## Interactions with EXT_materials_glimmer\n\nThere are not any.\n\n" * 6_000,
    ],
    ids=["one name many times", "many headings"],
)
def test_what_is_said_of_an_excluded_extension_is_read_once(tmp_path, section):
    """Searched anew for each name, and to the file's end for each heading, either would take minutes."""
    root = write(tmp_path)
    (root / README).write_text((root / README).read_text() + "\n" + section)
    assert "exclusion-contradicted" not in codes(root)


def test_a_heading_that_excludes_contradicts_nothing(tmp_path):
    root = write(tmp_path)
    (root / README).write_text((root / README).read_text() + "\n## Not with EXT_materials_glimmer\n")
    assert "exclusion-contradicted" not in codes(root)


def test_names_of_files_cannot_steer_the_terminal(tmp_path, capsys):
    root = write(tmp_path)
    (root / "schema" / "\x1b[2J\n.schema.json").write_text("{", encoding="utf-8")
    assert run(["schema", str(root)]) == 1
    assert "\x1b" not in capsys.readouterr().out


# What may stand anywhere in a file that somebody wrote by hand, or to harm.
WRONG = (None, True, -1, 1e300, "", "#", [], [1], {}, {"$ref": "#"}, {"$ref": []}, [[]])


@pytest.mark.parametrize("seed", range(40))
def test_whatever_stands_anywhere_becomes_findings(tmp_path, seed):
    root = write(tmp_path)
    draw = random.Random(seed)
    for name in (MATERIAL, LAYER):
        tree = json.loads((root / name).read_text())
        holder = tree
        while True:
            key = draw.choice(list(holder) if isinstance(holder, dict) else range(len(holder)))
            child = holder[key]
            if not isinstance(child, dict | list) or not child or draw.random() < 0.2:
                break
            holder = child
        holder[key] = draw.choice(WRONG)
        (root / name).write_text(json.dumps(tree))
    text = list((root / README).read_text())
    for _ in range(5):
        at = draw.randrange(len(text))
        text[at : at + draw.randrange(80)] = draw.choice(
            ["", "|", "```", "`", "](", "{", "\n", "<!--", "..."]
        )
    (root / README).write_text("".join(text))
    assert all(finding.message and finding.severity for finding in findings(root))
