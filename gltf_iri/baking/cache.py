"""Filled tables on disk, by what is in them: read back only where every byte is as it was written.

A file is the SHA-256 of the rest, a line of JSON that says what the table is, a line with the seconds that it
took, and the texels, little-endian. Its name is the SHA-256 of the first line, which names the table, the
white and the state of the code that fills it; so nothing in the folder is ever wrong, only superfluous.
Processes may share the folder: files appear whole (`gltf_iri.whole_files`), and two that fill the same table
write the same texels.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri import __version__
from gltf_iri.baking.baked import BakedTable
from gltf_iri.planning.film_table import FilmTable, Texel
from gltf_iri.whole_files import write_whole

__all__ = ["TableCache", "described", "user_folder"]

_FORMAT: Final = 1
_SUFFIX: Final = ".table"
_DIGEST_BYTES: Final = 32
_LINES_MAX: Final = 1 << 13
_LARGEST_BYTES: Final = 512 << 20

# Folders of the package whose code the texels depend on.
_COMPUTED_BY: Final = ("baking", "evaluation", "optics", "colour", "compiled")


def user_folder() -> Path:
    """Return where tables are kept: $XDG_CACHE_HOME/gltf-iri/tables, by default below ~/.cache."""
    chosen = os.environ.get("XDG_CACHE_HOME", "")
    # The specification has relative paths ignored.
    base = Path(chosen) if Path(chosen).is_absolute() else Path("~/.cache").expanduser()
    return base / "gltf-iri" / "tables"


@dataclass(slots=True)
class TableCache:
    """A folder of filled tables.

    largest_bytes : of all files together; the least recently used go first.
    notes : what kept tables from being read or put there, one sentence each; nothing else comes of it.
    """

    folder: Path = field(default_factory=user_folder)
    largest_bytes: int = _LARGEST_BYTES
    notes: list[str] = field(default_factory=list)

    def path(self, table: FilmTable, white: str) -> Path:
        """Return the file in which `table` under `white` lies, if it does."""
        return self.path_of(_description(table, white))

    def path_of(self, description: bytes) -> Path:
        """Return the file of what `described` has said."""
        return self.folder / (hashlib.sha256(description).hexdigest() + _SUFFIX)

    def read(self, table: FilmTable, white: str) -> BakedTable | None:
        """Return the filled table; None where it is not there. A file that is not sound is removed."""
        found = self.read_values(_description(table, white), table.texel, 3 * math.prod(table.shape))
        if found is None:
            return None
        values, filled_in_s = found
        return BakedTable(table, values.reshape(*table.shape, 3), white, filled_in_s, is_cached=True)

    def read_values(
        self, description: bytes, texel: Texel, count: int
    ) -> tuple[NDArray[np.floating[Any]], float] | None:
        """Return `count` numbers and the seconds that they took; None where they are not there."""
        path = self.path_of(description)
        try:
            if not path.is_file():  # a pipe would keep its reader waiting
                return None
            with path.open("rb") as stream:
                content = stream.read(count * np.dtype(texel).itemsize + _LINES_MAX + 1)
        except FileNotFoundError:
            return None
        except OSError as error:
            self._note(f"Tables are not read from {self.folder}: {error.strerror or error}.")
            return None
        found = _decoded(content, description, texel, count)
        with suppress(OSError):
            if found is None:
                path.unlink()
            else:
                os.utime(path)  # for what is removed first
        return found

    def write(self, baked: BakedTable) -> None:
        """Put a filled table there; where that fails the reason is noted."""
        values = baked.texels.reshape(-1)
        self.write_values(
            _description(baked.table, baked.white), baked.table.texel, values, baked.filled_in_s
        )

    def write_values(
        self, description: bytes, texel: Texel, values: NDArray[np.floating[Any]], filled_in_s: float
    ) -> None:
        """Put numbers (n,) there, in the precision of `texel`; where that fails the reason is noted."""
        path = self.path_of(description)
        content = description + f"\n{filled_in_s:.6e}\n".encode()
        content += values.astype(np.dtype(texel).newbyteorder("<")).tobytes()
        try:
            write_whole({path: hashlib.sha256(content).digest() + content})
            self._shrink(path)
        except OSError as error:
            self._note(f"Tables are not kept in {self.folder}: {error.strerror or error}.")

    def _shrink(self, newest: Path) -> None:
        """Remove what was used least recently, and what writers that died left, until the rest fits."""
        files = []
        for path in self.folder.iterdir():
            with suppress(FileNotFoundError):  # another process shrinks, too
                if path.suffix == _SUFFIX:
                    status = path.stat()
                    files.append((path == newest, status.st_mtime, status.st_size, path))
        left = sum(size for _, _, size, _ in files)
        for _, _, size, path in sorted(files):
            if left <= self.largest_bytes:
                break
            with suppress(FileNotFoundError):
                path.unlink()
            left -= size

    def _note(self, sentence: str) -> None:
        if sentence not in self.notes:
            self.notes.append(sentence)


def described(said: Mapping[str, Any]) -> bytes:
    """Return `said` as canonical JSON, with the state of the code: equal descriptions have equal bytes."""
    whole = {"format": _FORMAT, "computed_by": _state_of_the_code(), **said}
    return json.dumps(whole, sort_keys=True, separators=(",", ":")).encode()


def _decoded(
    content: bytes, description: bytes, texel: Texel, count: int
) -> tuple[NDArray[np.floating[Any]], float] | None:
    """Return what a file holds; None where it is damaged, or not what it should be."""
    if hashlib.sha256(content[_DIGEST_BYTES:]).digest() != content[:_DIGEST_BYTES]:
        return None
    line, _, rest = content[_DIGEST_BYTES:].partition(b"\n")
    took, _, values = rest.partition(b"\n")
    dtype = np.dtype(texel).newbyteorder("<")
    if line != description or len(values) != count * dtype.itemsize:
        return None
    try:
        filled_in_s = float(took)
    except ValueError:
        return None
    numbers: NDArray[Any] = np.frombuffer(values, dtype).astype(texel)
    if not np.all(np.isfinite(numbers)) or not 0.0 <= filled_in_s < math.inf:
        return None
    return numbers, filled_in_s


def _description(table: FilmTable, white: str) -> bytes:
    """Return all that the texels depend on."""
    return described(
        {
            "white": white,
            "lobe": table.lobe,
            "film_ior": table.film_ior.hex(),
            "thickness_nm": float(table.thickness_nm).hex(),
            "base_f0": [float(f0).hex() for f0 in table.base_f0],
            "axes": [
                [axis.quantity, float(axis.span.low).hex(), float(axis.span.high).hex(), axis.nodes]
                for axis in table.axes
            ],
            "texel": table.texel,
        }
    )


@cache
def _state_of_the_code() -> str:
    """Return the version of the program, and a digest of the sources that compute texels."""
    digest = hashlib.sha256()
    package = Path(__file__).parents[1]
    for folder in _COMPUTED_BY:
        for file in sorted((package / folder).rglob("*")):
            if file.suffix in (".py", ".csv"):
                digest.update(file.read_bytes())
    return f"{__version__} {digest.hexdigest()}"
