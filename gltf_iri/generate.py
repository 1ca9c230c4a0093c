"""Writes every file that is made from Python tables: `python -m gltf_iri.generate [--check]`.

With `--check` nothing is written; stale files are named and the exit code is 1.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from gltf_iri.colour.tables import D65_FILE, OBSERVER_FILE, d65_csv, observer_csv
from gltf_iri.material.interface import interface_glsl
from gltf_iri.material.property_table import properties_markdown
from gltf_iri.rendering.constants import (
    bragg_constants_glsl,
    constants_glsl,
    film_constants_glsl,
    layer_constants_glsl,
)
from gltf_iri.validation.codes_table import codes_markdown
from gltf_iri.validation.table_source import tables_json

__all__ = ["GENERATED", "main", "stale_files", "write_files"]

# Path in the checkout → the function that makes its text.
GENERATED: Mapping[str, Callable[[], str]] = MappingProxyType(
    {
        "shaders/generated/bragg_constants.glsl": bragg_constants_glsl,
        "shaders/generated/constants.glsl": constants_glsl,
        "shaders/generated/film_constants.glsl": film_constants_glsl,
        "shaders/generated/layer_constants.glsl": layer_constants_glsl,
        "shaders/generated/material.glsl": interface_glsl,
        f"gltf_iri/colour/data/{D65_FILE}": d65_csv,
        f"gltf_iri/colour/data/{OBSERVER_FILE}": observer_csv,
        "gltf_iri/validation/tables.json": tables_json,
        "spec/properties.md": properties_markdown,
        "spec/validator-codes.md": codes_markdown,
    }
)


def stale_files(root: Path) -> list[str]:
    """Return the paths below the checkout `root` that are missing or do not say what the tables say."""
    return [path for path, make in GENERATED.items() if _read(root / path) != make()]


def write_files(root: Path) -> list[str]:
    """Write what is stale below `root` and return its paths."""
    stale = stale_files(root)
    for path in stale:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(GENERATED[path](), encoding="utf-8")
    return stale


def main(arguments: Sequence[str] | None = None) -> int:
    """Write or check the files of the checkout that this package runs from; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m gltf_iri.generate", description=__doc__)
    parser.add_argument("--check", action="store_true", help="name stale files instead of writing them")
    is_check = parser.parse_args(arguments).check
    root = Path(__file__).resolve().parents[1]
    if not (root / "pyproject.toml").is_file():
        sys.stderr.write(
            f"{root} is no checkout of gltf-iri; generated files are written in a checkout only.\n"
        )
        return 2
    paths = stale_files(root) if is_check else write_files(root)
    for path in paths:
        sys.stdout.write(f"{'stale' if is_check else 'written'}: {path}\n")
    return 1 if is_check and paths else 0


def _read(path: Path) -> str | None:
    return path.read_text(encoding="utf-8") if path.is_file() else None


if __name__ == "__main__":
    sys.exit(main())
