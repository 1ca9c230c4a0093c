"""The results of a long run on disk, one report a line, so that a run that was broken off can go on."""

from __future__ import annotations

import json
import os
from pathlib import Path
from types import TracebackType
from typing import IO, Any

from gltf_iri.errors import UsageError

__all__ = ["ResultsFile"]

# How every result begins.
_HEAD = b'{"uri": "'


class ResultsFile:
    """JSON Lines that grow with every result.

    done : names of the files whose reports are there already; their lines stay as they are.
    errors : how many of those reports have errors.

    With `is_resumed` the results that are there count, and a line that was cut off is taken away; without it
    the file begins anew. Raises UsageError where the place cannot be written to, and where it holds something
    else than such results.
    """

    def __init__(self, path: Path, *, is_resumed: bool) -> None:
        self.path = path
        self.done: set[str] = set()
        self.errors = 0
        try:
            # Never truncated on opening: what is there may be hours of work, or another file by mistake.
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
            self._stream: IO[bytes] = os.fdopen(descriptor, "r+b")
            whole = self._read() if is_resumed else 0
            self._stream.seek(whole)
            self._stream.truncate()
        except OSError as error:
            raise UsageError(f"'{path}' cannot be written: {error.strerror or error}.") from error

    def __enter__(self) -> ResultsFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stream.close()

    def append(self, line: str) -> None:
        """Write one report; it is on its way to the disk when this returns."""
        self._stream.write(line.encode("ascii") + b"\n")
        self._stream.flush()

    def _read(self) -> int:
        """Take in the results that are there; return how many bytes are whole lines."""
        whole = 0
        for number, line in enumerate(self._stream, 1):
            if not line.endswith(b"\n") and _is_beginning(line):
                break
            report = self._parsed(line, number)
            self.done.add(report["uri"])
            self.errors += report["issues"]["numErrors"] > 0
            whole += len(line)
        return whole

    def _parsed(self, line: bytes, number: int) -> dict[str, Any]:
        try:
            report: dict[str, Any] = json.loads(line)
            is_report = isinstance(report["uri"], str) and isinstance(report["issues"]["numErrors"], int)
        except (ValueError, KeyError, TypeError, RecursionError):
            is_report = False
        if not is_report:
            self._stream.close()
            raise UsageError(
                f"Line {number} of '{self.path}' is no result of an earlier run; name another file."
            )
        return report


def _is_beginning(line: bytes) -> bool:
    """Tell whether a line that was cut off may be a result: another file must not lose its only line."""
    return line.startswith(_HEAD) or _HEAD.startswith(line)
