"""`gltf-iri schema` as scripts and people call it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from proposal_shimmer import MATERIAL, NAME, README, in_text, write

from gltf_iri.cli.main import run

ROOT = Path(__file__).parents[2]
HEAVY = {"colour", "scipy", "matplotlib", "moderngl", "pygltflib", "trimesh", "numpy", "PIL", "mpmath"}


def test_a_proposal_without_errors_ends_with_0(tmp_path, capsys):
    assert run(["schema", str(write(tmp_path)), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["extension"] == NAME
    assert printed["findings"] == []
    assert printed["skipped"] == []
    assert {"defaults", "property tables", "pointers"} <= set(printed["checked"])


def test_only_errors_end_with_1(tmp_path, capsys):
    root = write(tmp_path)
    in_text(MATERIAL, "the R channel, ", "")(root)
    assert run(["schema", str(root), "--json"]) == 0
    in_text(README, "default: `250`", "default: `200`")(root)
    assert run(["schema", str(root), "--json"]) == 1
    capsys.readouterr()


def test_a_finding_is_code_severity_message_and_place(tmp_path, capsys):
    root = write(tmp_path)
    in_text(README, "default: `250`", "default: `200`")(root)
    run(["schema", str(root), "--json"])
    printed = json.loads(capsys.readouterr().out)
    (finding,) = printed["findings"]
    line = (
        (root / README)
        .read_text()
        .splitlines()
        .index("| `thickness` | `number` | In nm. | No, default: `200` |")
    )
    assert finding == {
        "code": "table-default",
        "severity": "error",
        "message": "thickness is 200 by default here, 250.0 in the schema",
        "where": f"README.md:{line + 1}",
    }
    assert printed["counts"] == {"error": 1, "warning": 0, "information": 0}


def test_text_groups_findings_by_file(tmp_path, capsys):
    root = write(tmp_path)
    in_text(README, "default: `250`", "default: `200`")(root)
    in_text(MATERIAL, "the R channel, ", "")(root)
    assert run(["schema", str(root)]) == 1
    shown = capsys.readouterr().out.splitlines()
    assert shown.index(MATERIAL) < shown.index(README)
    assert shown[-1].endswith("error: 1, warning: 1, information: 0.")


@pytest.mark.parametrize("path", ["no/such/folder", __file__])
def test_what_is_no_folder_is_a_wrong_call(path, capsys):
    assert run(["schema", path]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_checking_loads_nothing_that_draws_or_computes(tmp_path):
    code = (
        "import sys; from gltf_iri.cli.main import run; "
        f"code = run(['schema', {str(write(tmp_path))!r}, '--json']); "
        "print(code, *sys.modules, file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    exit_code, *modules = done.stderr.split()
    assert exit_code == "0"
    assert "jsonschema" in modules  # the listing was read
    assert not HEAVY & set(modules)
