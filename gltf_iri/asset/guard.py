"""The only place that reads files of an asset: inside its folder, never the network, up to a stated size."""

from __future__ import annotations

import binascii
import os
import re
import stat
from pathlib import Path
from typing import Final

from gltf_iri.asset.limits import MAX_ASSET_BYTES, MAX_DECODED_PER_BYTE, MAX_UNVOUCHED_BYTES
from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError, UsageError

__all__ = ["Budget", "decode_data_uri", "is_data_uri", "read_given", "read_inside"]

_SCHEME: Final = re.compile(r"([A-Za-z][A-Za-z0-9+.\-]*):")
_DATA_URI: Final = re.compile(r"data:([^,;]*)((?:;[^,;]*)*),", re.IGNORECASE)


class Budget:
    """Counts the bytes that one asset keeps in memory, and refuses before they are allocated.

    `file_bytes` are those of the files themselves: what they vouch for may be large without being hostile.
    """

    def __init__(self, limit: int = MAX_ASSET_BYTES) -> None:
        self._limit = limit
        self._spent = 0
        self._decoded = 0
        self.file_bytes = 0

    def spend_on_file(self, count: int, pointer: str) -> None:
        """Account for `count` bytes of a file or data URI."""
        self.spend(count, pointer)
        self.file_bytes += count

    def spend_on_accessor(self, count: int, pointer: str) -> None:
        """Account for `count` bytes of decoded elements, which must be in proportion to the files' bytes."""
        self.spend(count, pointer)
        self._decoded += count
        allowed = MAX_UNVOUCHED_BYTES + MAX_DECODED_PER_BYTE * self.file_bytes
        if self._decoded > allowed:
            raise AssetError(
                f"its {count} bytes bring the accessors beyond {allowed} bytes, the most that is held for "
                f"files of {self.file_bytes}",
                pointer=pointer,
            )

    def spend(self, count: int, pointer: str) -> None:
        """Account for `count` bytes about to be allocated for the value at `pointer`."""
        if self._spent + count > self._limit:
            raise AssetError(
                f"its {count} bytes bring the asset beyond {self._limit} bytes, the most that is held",
                pointer=pointer,
            )
        self._spent += count


def read_given(path: Path, max_bytes: int) -> bytes:
    """Read a file that the user named; UsageError if it cannot be read, AssetError if it is too large."""
    try:
        return _read(path, max_bytes, None)
    except OSError as error:
        raise UsageError(f"{path} cannot be read: {error.strerror or error}.") from error
    except ValueError as error:
        raise UsageError(f"{str(path)!r} is not the name of a file.") from error


def read_inside(folder: Path, uri: str, pointer: str, max_bytes: int) -> bytes:
    """Read the file that a relative URI of the asset names, if it lies inside `folder`.

    Percent-encoding is undone once (RFC 3986 §2.4), symbolic links are followed before the place is checked,
    and the size is compared with `max_bytes` before anything is read. Raises AssetError with `pointer`.
    """
    root = folder.resolve()
    try:
        place = root.joinpath(*_steps(uri, pointer)).resolve(strict=True)
        if not place.is_relative_to(root):
            raise AssetError(f"{shown(uri)} leads out of the asset's folder", pointer=pointer)
        return _read(place, max_bytes, pointer)
    except FileNotFoundError as error:
        raise AssetError(
            f"the file {shown(uri)} is missing; put it beside the asset", pointer=pointer
        ) from error
    except (OSError, RuntimeError) as error:  # RuntimeError: a loop of symbolic links, before Python 3.13
        reason = error.strerror if isinstance(error, OSError) else "its symbolic links form a loop"
        raise AssetError(f"the file {shown(uri)} cannot be read: {reason}", pointer=pointer) from error


def is_data_uri(uri: str) -> bool:
    """Tell whether the URI carries its own data."""
    return uri[:5].lower() == "data:"


def decode_data_uri(uri: str, pointer: str, max_bytes: int) -> tuple[bytes, str]:
    """Return data and media type of a data URI (RFC 2397); AssetError if it is broken or too large.

    Base64 is strict: no foreign characters, no missing padding.
    """
    from urllib.parse import unquote_to_bytes  # slow to load, and most files need it not

    # The head is short: searching only there keeps a data URI without comma from being scanned whole.
    head = _DATA_URI.match(uri, 0, 1024)
    if head is None:
        raise AssetError(f"the data URI {shown(uri)} has no comma after its media type", pointer=pointer)
    is_base64 = head[2].lower().rpartition(";")[2] == "base64"
    encoded = uri[head.end() :]
    size = len(encoded) * 3 // 4 if is_base64 else len(encoded)
    if size > max_bytes:
        raise AssetError(
            f"the data URI holds {size} bytes, more than the {max_bytes} allowed", pointer=pointer
        )
    try:
        raw = encoded.encode("ascii")
        data = binascii.a2b_base64(raw, strict_mode=True) if is_base64 else unquote_to_bytes(raw)
    except (binascii.Error, UnicodeEncodeError) as error:
        reason = str(error) if isinstance(error, binascii.Error) else "a character beyond ASCII"
        raise AssetError(f"the data URI is broken: {reason}", pointer=pointer) from error
    return data, head[1].lower()


def _steps(uri: str, pointer: str) -> list[str]:
    """Folder names and file name of a relative URI; every other form is refused by its name."""
    from urllib.parse import unquote

    scheme = _SCHEME.match(uri)
    if scheme:
        raise AssetError(
            f"{shown(uri)} has the scheme {scheme[1]!r}; only files beside the asset and data URIs are read",
            pointer=pointer,
        )
    try:
        path = unquote(uri, errors="strict")
    except UnicodeDecodeError as error:
        raise AssetError(f"the percent-encoding of {shown(uri)} is not UTF-8", pointer=pointer) from error
    if any(ord(character) < 0x20 or character == "\x7f" for character in path):
        raise AssetError(f"{shown(uri)} contains a control character", pointer=pointer)
    if "\\" in path:
        raise AssetError(f"{shown(uri)} contains a backslash; write '/' between folders", pointer=pointer)
    steps = path.split("/")
    if ".." in steps:
        raise AssetError(f"{shown(uri)} leads out of its folder with '..'", pointer=pointer)
    # A scheme or drive may hide behind percent-encoding; joining must never restart at a root.
    if path.startswith("/") or _SCHEME.match(path):
        raise AssetError(f"{shown(uri)} is absolute; only files beside the asset are read", pointer=pointer)
    if not path.strip("/."):
        raise AssetError(f"{shown(uri)} names no file", pointer=pointer)
    return steps


def _read(path: Path, max_bytes: int, pointer: str | None) -> bytes:
    # O_NONBLOCK: opening a named pipe would otherwise wait for a writer without end.
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(0, "it is not a regular file")
        if status.st_size > max_bytes:
            raise AssetError(
                f"the file {shown(path.name)} has {status.st_size} bytes, more than the {max_bytes} allowed",
                pointer=pointer,
            )
        return file.read(status.st_size)
