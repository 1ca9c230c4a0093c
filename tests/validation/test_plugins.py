"""Rules from outside: a package that declares them is followed, and a broken one costs nothing but itself."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "spec/validator-rules.md").read_text(encoding="utf-8")
ENTRY_POINTS = "[gltf_iri.rules]\nacme = acme_rules\n"

ASSET = {
    "asset": {"version": "2.0"},
    "extensionsUsed": ["ACME_wear"],
    "materials": [{"extensions": {"ACME_wear": {"wear": 1}}}, {"extensions": {"ACME_wear": {"wear": 2}}}],
    "meshes": [
        {"primitives": [{"attributes": {}}]},
        {"name": "lamp", "primitives": [{"attributes": {}}]},
    ],
}


def example(language: str) -> str:
    found = re.search(rf"```{language}\n(.*?)```", GUIDE, re.DOTALL)
    assert found is not None
    return found[1]


@pytest.fixture
def told(tmp_path):
    """Return a function that installs a package and returns the remarks on ASSET, sorted."""

    def run(source: str, entry_points: str = ENTRY_POINTS) -> list[tuple[str, str]]:
        site = tmp_path / "site"
        metadata = site / "acme_rules-1.0.dist-info"
        metadata.mkdir(parents=True)
        (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-rules\nVersion: 1.0\n")
        (metadata / "entry_points.txt").write_text(entry_points)
        (site / "acme_rules.py").write_text(source)
        (tmp_path / "a.gltf").write_text(json.dumps(ASSET))
        code = (
            "import gltf_iri, sys\n"
            "for i in gltf_iri.validate(sys.argv[1]).issues: print(i.code, i.pointer)\n"
            "print('importlib.metadata' in sys.modules)"
        )
        done = subprocess.run(
            [sys.executable, "-c", code, tmp_path / "a.gltf"],
            env={**os.environ, "PYTHONPATH": os.pathsep.join([str(site), str(ROOT)])},
            capture_output=True,
            text=True,
            check=True,
        )
        lines = [tuple(line.split(" ", 1)) for line in done.stdout.splitlines()]
        assert lines.pop() == (str(entry_points == ENTRY_POINTS),)  # read only where somebody declares rules
        return sorted(lines)

    return run


def ours(lines: list[tuple[str, str]]) -> list[tuple[str, str]]:
    return [line for line in lines if line[0].startswith(("ACME", "IRI_", "UNSUPPORTED", "VALUE"))]


def test_the_guides_example_works(told):
    assert "acme_rules" in example("toml")
    assert ours(told(example("python"))) == [
        ("ACME_NO_NAME", "/meshes/0"),
        ("ACME_WORN_OUT", "/materials/0/extensions/ACME_wear/wear"),
        ("VALUE_NOT_IN_RANGE", "/materials/1/extensions/ACME_wear/wear"),
    ]


def test_a_package_without_the_group_is_never_imported(told):
    lines = told("raise SystemExit('imported')", "[console_scripts]\nacme = acme_rules\n")
    assert ours(lines) == [("UNSUPPORTED_EXTENSION", "/extensionsUsed/0")]


@pytest.mark.parametrize(
    "source",
    [
        "import no_such_module",
        "syntax error",
        "codes = {'ACME_A': (7, 'text')}",
        "codes = {'ACME_A': 1}",
        "codes = {'IRI_RULE_FAILED': (0, 'text')}",
        "rules = {'no_such_table': (print,)}",
        "tables = {'extensions': {'KHR_materials_unlit': {'objects': {}}}}",
        "tables = {'objects': {'ACME_wear': [{'key': 'wear', 'kind': 'NUMBER', 'lower': 0}]}}",
        "rules = 5",
    ],
)
def test_a_broken_package_is_told_and_all_else_goes_on(told, source):
    assert ours(told(source)) == [("IRI_PLUGIN_FAILED", ""), ("UNSUPPORTED_EXTENSION", "/extensionsUsed/0")]


def test_a_rule_that_raises_is_told_where_it_did(told):
    source = (
        "def broken(entry, asset):\n    yield entry['nothing']\nrules = {'mesh': (broken, lambda e, a: 1)}"
    )
    assert ours(told(source)) == [
        *[("IRI_RULE_FAILED", f"/meshes/{index}") for index in (0, 0, 1, 1)],
        ("UNSUPPORTED_EXTENSION", "/extensionsUsed/0"),
    ]
