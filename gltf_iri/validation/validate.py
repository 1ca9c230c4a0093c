"""One file from its bytes to its report, stage by stage."""

from __future__ import annotations

import json
from contextlib import suppress
from os import PathLike
from pathlib import Path
from typing import Any

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.limits import MAX_FILE_BYTES
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.collector import Collector, EnoughError
from gltf_iri.validation.links import check_links
from gltf_iri.validation.options import Options
from gltf_iri.validation.report import Report
from gltf_iri.validation.resources import check_resources
from gltf_iri.validation.rules import every as _every  # noqa: F401  # registers the rules
from gltf_iri.validation.rules.registry import DATA_RULES, RULES
from gltf_iri.validation.walk import Walk

__all__ = ["validate"]


def validate(
    source: str | PathLike[str] | bytes,
    *,
    uri: str | None = None,
    folder: Path | None = None,
    options: Options | None = None,
) -> Report:
    """Check one glTF file and return its report.

    source : the path of a .gltf or .glb file, or its bytes.
    uri : what the report calls the file; without it the path as given, or "" for bytes.
    folder : where the files that the asset names lie; without it the file's own folder, for bytes none.

    Raises UsageError where `source` is a path that cannot be read; whatever is wrong with the file is told in
    the report.
    """
    chosen = Options() if options is None else options
    if isinstance(source, bytes):
        data, name, place = source, uri or "", folder
    else:
        path = Path(source)
        data = read_given(path, MAX_FILE_BYTES)
        name, place = str(source) if uri is None else uri, path.parent if folder is None else folder
    collector = Collector(chosen)
    info: dict[str, Any] | None = None
    with suppress(EnoughError):  # the report says that it is cut short
        info = _check(data, collector, chosen, place)
    return Report(name, "model/gltf+json", tuple(collector.issues), info, is_truncated=collector.is_truncated)


def _check(data: bytes, collector: Collector, options: Options, folder: Path | None) -> dict[str, Any] | None:
    raw = json.loads(data)
    declared = frozenset(name for name in raw.get("extensionsUsed", ()) if isinstance(name, str))
    walk = Walk(collector, declared)
    root = walk.object("glTF", raw)
    asset = Asset(root, walk, collector, options, declared, folder=folder, is_glb=False, binary=None)
    check_links(asset)
    for entry in asset.entries:
        for rule in RULES.get(entry.table, ()):
            collector.add_all(rule(entry, asset))
    check_resources(asset)
    for entry in asset.entries:
        for rule in DATA_RULES.get(entry.table, ()):
            collector.add_all(rule(entry, asset))
    return None
