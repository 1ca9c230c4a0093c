"""One file from its bytes to its report, stage by stage."""

from __future__ import annotations

import gc
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.limits import MAX_FILE_BYTES
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.collector import Collector, EnoughError
from gltf_iri.validation.files.images import check_images
from gltf_iri.validation.files.resources import check_resources
from gltf_iri.validation.info import asset_info
from gltf_iri.validation.options import Options
from gltf_iri.validation.plugins import load_plugins
from gltf_iri.validation.reading.read import Reading, read
from gltf_iri.validation.report import Report
from gltf_iri.validation.rules import every as _every  # noqa: F401  # registers the rules
from gltf_iri.validation.rules.registry import DATA_RULES, RULES
from gltf_iri.validation.schema.links import check_links
from gltf_iri.validation.schema.usage import check_usage
from gltf_iri.validation.schema.walk import Walk

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from os import PathLike
    from typing import Any

    from gltf_iri.validation.rules.registry import Rules

__all__ = ["validate"]

# An exception may quote what it met, which may be megabytes.
_LONGEST_REASON = 200


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

    Raises UsageError where `source` is a path that cannot be read, AssetError where it is a file beyond all
    bounds; whatever else is wrong with the file is told in the report.
    """
    chosen = Options() if options is None else options
    if isinstance(source, bytes):
        data, name, place = source, uri or "", folder
    else:
        path = Path(source)
        data = read_given(path, MAX_FILE_BYTES)
        name, place = str(source) if uri is None else uri, path.parent if folder is None else folder
    collector = Collector(chosen)
    reading: Reading | None = None
    info: dict[str, Any] | None = None
    with _no_collection(), suppress(EnoughError):  # the report says that it is cut short
        collector.add_all(load_plugins())
        reading = read(data, name, collector.add)
        if reading.root is not None:
            info = _judge(reading.root, reading, collector, chosen, place)
    mime_type = None if reading is None else reading.mime_type
    return Report(name, mime_type, tuple(collector.issues), info, is_truncated=collector.is_truncated)


@contextmanager
def _no_collection() -> Iterator[None]:
    """Keep Python from looking for garbage: nothing of a file is any before its report is there, and in
    large files the search takes half of the time.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def _judge(
    raw: dict[str, Any], reading: Reading, collector: Collector, options: Options, folder: Path | None
) -> dict[str, Any] | None:
    """Run every stage and return the `info` block; what was kept of the file is then let go at once."""
    walk = Walk(collector)
    try:
        return _stages(raw, walk, reading, collector, options, folder)
    finally:
        walk.let_go()


def _stages(
    raw: dict[str, Any],
    walk: Walk,
    reading: Reading,
    collector: Collector,
    options: Options,
    folder: Path | None,
) -> dict[str, Any] | None:
    """Run every stage.

    Of an unknown version, and of a file that breaks off, only the JSON is judged: no data, and no block.
    """
    try:
        root = walk.root(raw)
    except EnoughError:
        raise
    except Exception as error:
        _tell_failure(walk.root, error, "", collector, options)
        return None
    asset = Asset(
        root,
        walk,
        collector,
        options,
        walk.declared,
        folder=folder,
        is_glb=reading.is_glb,
        binary=reading.binary,
    )
    _run(check_links, asset)
    _follow(RULES, asset)
    _run(check_usage, asset)
    if not (walk.is_known_version and reading.is_whole):
        return None
    _run(check_resources, asset)
    _run(check_images, asset)
    _follow(DATA_RULES, asset)
    # After an empty last chunk the Khronos validator writes no block either.
    told: dict[str, Any] | None = None if reading.ends_empty else _run(asset_info, asset)
    return told


def _follow(rules: Rules, asset: Asset) -> None:
    """Ask every rule about every object of its table."""
    tell_all = asset.collector.add_all
    for entry in asset.entries:
        for rule in rules.get(entry.table, ()):
            try:
                tell_all(rule(entry, asset))
            except EnoughError:
                raise
            except Exception as error:
                _tell_failure(rule, error, entry.pointer, asset.collector, asset.options)


def _run(stage: Callable[[Asset], Any], asset: Asset) -> Any:
    try:
        return stage(asset)
    except EnoughError:
        raise
    except Exception as error:
        _tell_failure(stage, error, "", asset.collector, asset.options)
        return None


def _tell_failure(
    rule: Callable[..., Any], error: Exception, pointer: str, collector: Collector, options: Options
) -> None:
    """Make a remark of a rule's own fault: one broken rule must not cost the verdict of all others."""
    if options.raises:
        raise error
    name = f"{rule.__module__}.{getattr(rule, '__qualname__', type(rule).__name__)}"
    reason = f"{type(error).__name__}: {error}"[:_LONGEST_REASON]
    collector.add(issue("IRI_RULE_FAILED", pointer, rule=name, reason=reason))
