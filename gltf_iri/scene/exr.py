"""OpenEXR pictures as image light, read with the OpenEXR package."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.asset.limits import MAX_IMAGE_PIXELS
from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    import OpenEXR

__all__ = ["read_exr"]

Float32 = NDArray[np.float32]

# CIE xy of red, green, blue and white in ITU-R BT.709-6, table 1.
_REC709: Final = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)


def read_exr(path: Path) -> Float32:
    """Return a picture (height, width, 3) of the display window, linear Rec.709, row 0 at the top.

    Of several parts and layers it is the first part's R, G and B without a layer's name, else another part's,
    else those of the only layer that has them; a picture of luminance alone becomes grey. Where the data
    window does not reach there is no light. Raises AssetError where the file cannot be read, keeps colour as
    luminance and chroma, or is made of other primaries.
    """
    parts = _open(path, header_only=True).parts
    for part in parts:
        _check_size(path, part.header)
    number, names = _choose(path, [_channel_names(path, part) for part in parts])
    primaries = parts[number].header.get("chromaticities")
    if primaries is not None and not np.allclose(np.ravel(primaries), _REC709, atol=2e-3):
        raise AssetError("the picture's primaries are not Rec.709's; convert it to linear Rec.709", file=path)

    part = _open(path, header_only=False).parts[number]
    if not set(names) <= set(part.channels) or any(part.channels[n].pixels is None for n in names):
        raise AssetError("the OpenEXR picture's channels cannot be decoded", file=path)
    planes = [np.asarray(part.channels[name].pixels) for name in names]
    data, display = (_window(part.header[key]) for key in ("dataWindow", "displayWindow"))
    if any(plane.shape != data.shape for plane in planes):
        raise AssetError("the picture's channels differ in size", file=path)
    picture = np.zeros((*display.shape, 3), dtype=np.float32)
    shared, inside = display.overlap(data), data.overlap(display)
    picture[shared] = np.stack([plane[inside] for plane in planes], axis=2)
    return picture


@dataclass(frozen=True, slots=True)
class _Window:
    """Pixels from (left, top) to (right, bottom), both included, as the format counts them."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def shape(self) -> tuple[int, int]:
        return self.bottom - self.top + 1, self.right - self.left + 1

    def overlap(self, other: _Window) -> tuple[slice, slice]:
        """Return where in an array of this window's shape the pixels lie that both windows have."""
        rows = max(self.top, other.top) - self.top, min(self.bottom, other.bottom) - self.top + 1
        columns = max(self.left, other.left) - self.left, min(self.right, other.right) - self.left + 1
        return slice(rows[0], max(rows)), slice(columns[0], max(columns))


def _window(corners: Sequence[ArrayLike]) -> _Window:
    (left, top), (right, bottom) = (np.asarray(corner).astype(np.int64).tolist() for corner in corners)
    return _Window(left, top, right, bottom)


def _check_size(path: Path, header: Mapping[str, Any]) -> None:
    for key in ("dataWindow", "displayWindow"):
        height, width = _window(header[key]).shape
        if not (width > 0 and height > 0 and width * height <= MAX_IMAGE_PIXELS):
            raise AssetError(
                f"the picture has {width} × {height} pixels; 1 to {MAX_IMAGE_PIXELS} are read", file=path
            )


def _channel_names(path: Path, part: OpenEXR.Part) -> list[str]:
    """Return the names that the header lists, also where nothing was decoded yet."""
    try:
        return [channel.name for channel in part.header["channels"]]
    except UnicodeDecodeError as error:
        raise AssetError("the name of a channel is not UTF-8", file=path) from error


def _choose(path: Path, parts: Sequence[Sequence[str]]) -> tuple[int, tuple[str, str, str]]:
    """Return which part to read and the names of its red, green and blue."""
    for number, names in enumerate(parts):
        if set("RGB") <= set(names):
            return number, ("R", "G", "B")
    layered = [
        (number, name[:-1])
        for number, names in enumerate(parts)
        for name in names
        if name.endswith(".R") and {name[:-1] + "G", name[:-1] + "B"} <= set(names)
    ]
    if len(layered) == 1:
        number, prefix = layered[0]
        return number, (prefix + "R", prefix + "G", prefix + "B")
    if layered:
        layers = ", ".join(prefix[:-1] for _, prefix in layered)
        raise AssetError(
            f"the picture has several layers with R, G and B ({layers}); write one of them alone", file=path
        )
    for number, names in enumerate(parts):
        if "Y" in names:
            if {"RY", "BY"} & set(names):
                raise AssetError(
                    "the picture keeps colour as luminance and chroma; write it as R, G and B", file=path
                )
            return number, ("Y", "Y", "Y")
    found = ", ".join(sorted({name for names in parts for name in names})) or "none"
    raise AssetError(f"the picture needs the channels R, G and B, or Y; it has {found}", file=path)


def _open(path: Path, *, header_only: bool) -> OpenEXR.File:
    import OpenEXR

    try:
        with _silence():
            picture: Any = OpenEXR.File(str(path), separate_channels=True, header_only=header_only)
    except (OSError, RuntimeError, TypeError, ValueError) as error:
        raise AssetError("the file is not an OpenEXR picture that can be read", file=path) from error
    if not picture.parts:
        raise AssetError("the OpenEXR picture is damaged or cut short", file=path)
    return picture


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Keep what the package and its library print, a line for each broken chunk, out of both streams."""
    kept = os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        with contextlib.redirect_stdout(io.StringIO()):
            yield
    finally:
        os.dup2(kept, 2)
        os.close(nowhere)
        os.close(kept)
