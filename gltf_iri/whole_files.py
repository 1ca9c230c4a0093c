"""Files that appear whole or not at all: what is written goes beside its place first and is then renamed."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from gltf_iri.errors import UsageError

__all__ = ["Content", "write_or_refuse", "write_whole"]

# The bytes of a file, or a function that writes it to the path that it is given.
Content = bytes | Callable[[Path], None]


def write_whole(contents: Mapping[Path, Content]) -> None:
    """Write all files, replacing those that are there; missing folders are made.

    Nothing is replaced before everything is written, so that a full disk leaves the earlier files as they
    were, and no reader ever sees half a file. Raises OSError, and whatever a content's function raises.
    """
    unfinished: dict[Path, Path] = {}
    try:
        for path, content in contents.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            # In the same folder: a rename is one step within a file system only.
            handle, name = tempfile.mkstemp(prefix=".", suffix=path.suffix, dir=path.parent)
            unfinished[path] = Path(name)
            with os.fdopen(handle, "wb") as stream:
                if isinstance(content, bytes):
                    stream.write(content)
            if not isinstance(content, bytes):
                content(unfinished[path])
            unfinished[path].chmod(0o666 & ~_umask())  # mkstemp's files are private
        for path, temporary in unfinished.items():
            temporary.replace(path)
    finally:
        for temporary in unfinished.values():
            temporary.unlink(missing_ok=True)


def write_or_refuse(contents: Mapping[Path, Content], folder: Path | None = None) -> None:
    """Write all files as `write_whole` does, where a user chose the place.

    Raises UsageError for what the system refuses, which names the `folder`, or else the first file.
    """
    try:
        write_whole(contents)
    except OSError as error:
        if folder is None:
            place = f"'{next(iter(contents))}' cannot be written"
        else:
            place = f"'{folder}' cannot be written to"
        raise UsageError(f"{place}: {error.strerror or error}.") from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
