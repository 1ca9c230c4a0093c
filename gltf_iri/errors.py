"""What can go wrong, and the exit code each kind of failure gives.

    GltfIriError
    ├── AssetError              1  the file (or the comparison) has errors
    ├── UsageError              2  the call is wrong: a bad option, a path that does not exist
    └── MissingCapabilityError  3  the machine lacks something: OpenGL, an optional package

Every message is one sentence that says what is wrong, where, and what to do. The command line prints it to
stderr and leaves with the exit code; a traceback is a bug.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import ClassVar

__all__ = ["AssetError", "GltfIriError", "MissingCapabilityError", "UsageError", "naming_file"]


class GltfIriError(Exception):
    """Base of every error that this package raises on purpose."""

    exit_code: ClassVar[int] = 1


class AssetError(GltfIriError):
    """The asset is broken, hostile or beyond what this program reads.

    Parameters
    ----------
    what : what is wrong and what to do, without a final full stop.
    pointer : JSON Pointer to the offending value, such as ``/accessors/3/count``.
    offset : byte offset into a GLB, where there is no pointer.
    file : the file that is read. Most readers do not know it: their callers add it with `naming_file`.
    """

    exit_code = 1

    def __init__(
        self, what: str, *, pointer: str | None = None, offset: int | None = None, file: Path | None = None
    ) -> None:
        self.what = what
        self.pointer = pointer
        self.offset = offset
        self.file = file
        super().__init__(what)

    def __str__(self) -> str:
        where = []
        if self.file is not None:
            where.append(str(self.file))
        if self.pointer is not None:
            where.append(self.pointer or "/")
        elif self.offset is not None:
            where.append(f"byte {self.offset}")
        return ": ".join([*where, self.what]) + "."


class UsageError(GltfIriError):
    """The caller asked for something that does not exist or does not go together."""

    exit_code = 2


class MissingCapabilityError(GltfIriError):
    """The machine lacks something; the message says what to install."""

    exit_code = 3


@contextmanager
def naming_file(path: Path) -> Iterator[None]:
    """Add `path` to every AssetError of the block that does not name a file yet."""
    try:
        yield
    except AssetError as error:
        if error.file is None:
            error.file = path
        raise
