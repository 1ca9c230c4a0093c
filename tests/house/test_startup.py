"""The program is there at once: what it does not need yet, it does not load."""

from __future__ import annotations

import subprocess
import sys

import pytest

SLOW_TO_LOAD = {"scipy", "colour", "matplotlib", "moderngl", "pygltflib", "trimesh", "numpy", "PIL"}


def modules_loaded_by(*arguments: str) -> set[str]:
    """Return the top-level names of the modules that ``python -m gltf_iri ARGUMENTS`` imports."""
    command = [sys.executable, "-X", "importtime", "-m", "gltf_iri", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = [line.split("|") for line in done.stderr.splitlines() if line.startswith("import time:")]
    return {row[2].strip().split(".")[0] for row in rows}


@pytest.mark.parametrize("arguments", [["--help"], ["--version"]], ids=" ".join)
def test_help_loads_nothing_slow(arguments: list[str]) -> None:
    loaded = modules_loaded_by(*arguments)
    assert "click" in loaded  # the listing was read
    assert loaded & SLOW_TO_LOAD == set()
