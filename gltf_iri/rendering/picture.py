"""Frames to files: PNG for eyes, OpenEXR for numbers. A file appears whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.errors import UsageError
from gltf_iri.rendering.tonemap import tone_map
from gltf_iri.whole_files import write_whole

__all__ = ["check_picture_path", "display_pixels", "write_picture"]

Float32 = NDArray[np.float32]


def display_pixels(rgba: Float32, exposure: float, tonemap: str) -> NDArray[np.uint8]:
    """Return sRGB pixels (height, width, 3) of linear ones: × 2^exposure, tone map, encode, round."""
    display = tone_map(tonemap, rgba[..., :3].astype(np.float64) * 2.0**exposure)
    return np.rint(srgb_encode(display) * 255.0).astype(np.uint8)


def check_picture_path(path: str | PathLike[str]) -> Path:
    """Return `path` if a picture can be written there; UsageError says why not, before anything is drawn."""
    place = Path(path)
    if place.suffix.lower() not in _WRITERS:
        raise UsageError(f"A picture is a {' or '.join(_WRITERS)} file, and '{place.name}' is neither.")
    if not place.parent.is_dir():
        raise UsageError(f"There is no folder '{place.parent}' to write '{place.name}' into; make it first.")
    if place.is_dir():
        raise UsageError(f"'{place}' is a folder; name a file to write.")
    if not os.access(place.parent, os.W_OK):
        raise UsageError(f"'{place}' cannot be written: choose a file in a folder that you may write to.")
    return place


def write_picture(
    path: str | PathLike[str], rgba: Float32, exposure: float = 0.0, tonemap: str = "none"
) -> None:
    """Write a frame (height, width, 4).

    ``.png``: 8-bit sRGB, exposed and tone mapped. ``.exr``: float32 linear Rec.709 times 2^exposure, never
    tone mapped; A is how much of the pixel the model covers. RGB holds the background in both, so it is not
    premultiplied by A. Raises UsageError for any other ending and a place that cannot be written to.
    """
    place = check_picture_path(path)
    write = _WRITERS[place.suffix.lower()]
    try:
        write_whole({place: lambda unfinished: write(str(unfinished), rgba, exposure, tonemap)})
    except OSError as error:
        raise UsageError(f"'{place}' cannot be written: {error.strerror or error}.") from error


def _write_png(name: str, rgba: Float32, exposure: float, tonemap: str) -> None:
    import PIL.Image

    PIL.Image.fromarray(display_pixels(rgba, exposure, tonemap)).save(name, format="PNG")


def _write_exr(name: str, rgba: Float32, exposure: float, tonemap: str) -> None:
    import OpenEXR

    scaled = rgba.astype(np.float32)
    scaled[..., :3] *= np.float32(2.0**exposure)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGBA": np.ascontiguousarray(scaled)}) as file:
        file.write(name)


_WRITERS: Final[Mapping[str, Callable[[str, Float32, float, str], None]]] = MappingProxyType(
    {".png": _write_png, ".exr": _write_exr}
)
