"""All samples, and how they reach a folder."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path

from gltf_iri.errors import UsageError
from gltf_iri.samples.sample import Sample
from gltf_iri.whole_files import write_whole

__all__ = ["NAMES", "build_samples", "collection_files", "write_samples"]

NAMES = (
    "soap-bubble",
    "oil-on-metal",
    "anodised-ramp",
    "pearl",
    "beetle",
    "thickness-swatches",
    "angle-fan",
    "jewel-beetle",
    "morpho",
    "dichroic-mirror",
    "opal",
    "stacked-layers",
    "bragg-roughness",
    "bragg-cells",
    "bragg-everything",
)

# Drawn once by spec/figures/samples.py: pictures differ in their last bits between drivers.
_PICTURES = Path(__file__).with_name("pictures")

_INDEX = "index.json"
_WRITER = "gltf-iri samples"


def build_samples() -> tuple[Sample, ...]:
    """Build every sample, in the order of `NAMES`; each is `build()` of its own module."""
    modules = (import_module(f"gltf_iri.samples.{name.replace('-', '_')}") for name in NAMES)
    return tuple(module.build() for module in modules)


def collection_files() -> Mapping[str, bytes]:
    """Return every file of the collection, path relative to its folder → content."""
    samples = build_samples()
    index = {
        "generator": _WRITER,
        "samples": [{"name": s.name, "title": s.title, "file": s.file, "shows": s.shows} for s in samples],
    }
    files = {_INDEX: (json.dumps(index, indent=2, ensure_ascii=False) + "\n").encode()}
    for sample in samples:
        files[f"{sample.name}/README.md"] = sample.readme.encode()
        files[f"{sample.name}/{sample.picture}"] = (_PICTURES / sample.picture).read_bytes()
        files |= {f"{sample.name}/{name}": content for name, content in sample.files.items()}
    return files


def write_samples(folder: Path) -> list[Path]:
    """Write the collection into `folder` and return the paths written; an earlier collection is replaced.

    Raises UsageError where `folder` cannot be written to or holds something else: files that are not ours
    are never overwritten.
    """
    if folder.exists() and not folder.is_dir():
        raise UsageError(f"{folder} is not a folder: name another one.")
    if folder.is_dir() and any(folder.iterdir()) and not _is_ours(folder / _INDEX):
        raise UsageError(f"{folder} holds other files than the samples: name an empty folder.")
    files = {folder / name: content for name, content in collection_files().items()}
    try:
        write_whole(files)
    except OSError as error:
        raise UsageError(
            f"{folder} cannot be written to ({error.strerror or error}): name another folder."
        ) from error
    return list(files)


def _is_ours(index: Path) -> bool:
    try:
        content = json.loads(index.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(content, dict) and content.get("generator") == _WRITER
