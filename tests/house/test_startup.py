"""The program is there at once: what it does not need yet, it does not load."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SLOW_TO_LOAD = {"scipy", "colour", "matplotlib", "moderngl", "pygltflib", "trimesh", "numpy", "PIL"}
# A file is judged while another validator's runtime still starts: there even these are slow.
SLOW_FOR_ONE_FILE = SLOW_TO_LOAD | {
    *("click", "dataclasses", "inspect", "ast", "importlib.metadata", "email", "jsonschema", "yaml"),
    *("subprocess", "threading", "tempfile", "concurrent", "multiprocessing", "distributed", "ssl", "http"),
    *("logging", "decimal", "datetime", "platform"),
}


def modules_loaded_by(*arguments: str) -> set[str]:
    """Return the names of the modules, and their packages, that ``python -m gltf_iri ARGUMENTS`` imports."""
    command = [sys.executable, "-X", "importtime", "-m", "gltf_iri", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = [line.split("|") for line in done.stderr.splitlines() if line.startswith("import time:")]
    names = {row[2].strip() for row in rows}
    return names | {name.split(".")[0] for name in names}


@pytest.mark.parametrize("arguments", [["--help"], ["--version"]], ids=" ".join)
def test_help_loads_nothing_slow(arguments: list[str]) -> None:
    loaded = modules_loaded_by(*arguments)
    assert "click" in loaded  # the listing was read
    assert loaded & SLOW_TO_LOAD == set()


@pytest.mark.parametrize("form", ["text", "json"])
def test_validate_loads_nothing_slow(tmp_path: Path, form: str) -> None:
    path = tmp_path / "a.gltf"
    path.write_text(
        '{"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"data:application/octet-stream;base64,AA=="}]}'
    )
    loaded = modules_loaded_by("validate", "--format", form, str(path))
    assert "gltf_iri.validation.validate" in loaded
    assert loaded & SLOW_FOR_ONE_FILE == set()
