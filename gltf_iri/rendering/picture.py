"""Frames to files: PNG and WebP for eyes, OpenEXR for numbers. A file appears whole or not at all."""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.errors import UsageError
from gltf_iri.rendering.tonemap import tone_map
from gltf_iri.whole_files import write_or_refuse

if TYPE_CHECKING:
    import PIL.Image

__all__ = ["ANIMATED", "TURN_MS", "check_picture_path", "display_pixels", "orbit_paths", "webp_bytes"]
__all__ += ["write_orbit", "write_picture"]

Float32 = NDArray[np.float32]

# What holds a whole orbit in one file; the other kinds become numbered files.
ANIMATED: Final = ".webp"

# One turn of an animated orbit, and the shortest picture that browsers do not slow down.
TURN_MS: Final = 6000
_PICTURE_MS_MIN: Final = 20

# Pillow takes an animation as a whole: 8-bit pixels of 800 MB, and not more.
_ANIMATION_PIXELS_MAX: Final = 1 << 28

# WebP is for looking: at this quality its loss is not seen beside the PNG. VP8 counts a side in 14 bits.
_WEBP_QUALITY: Final = 90
_WEBP_SIDE_MAX: Final = 16383


def display_pixels(rgba: Float32, exposure: float, tonemap: str) -> NDArray[np.uint8]:
    """Return sRGB pixels (height, width, 3) of linear ones: × 2^exposure, tone map, encode, round."""
    display = tone_map(tonemap, rgba[..., :3].astype(np.float64) * 2.0**exposure)
    return np.rint(srgb_encode(display) * 255.0).astype(np.uint8)


def check_picture_path(path: str | PathLike[str]) -> Path:
    """Return `path` if a picture can be written there; UsageError says why not, before anything is drawn."""
    place = Path(path)
    if place.suffix.lower() not in _WRITERS:
        *others, last = _WRITERS
        raise UsageError(
            f"A picture is a {', '.join(others)} or {last} file; '{place.name}' is none of them."
        )
    if not place.parent.is_dir():
        raise UsageError(f"There is no folder '{place.parent}' to write '{place.name}' into; make it first.")
    if place.is_dir():
        raise UsageError(f"'{place}' is a folder; name a file to write.")
    if not os.access(place.parent, os.W_OK):
        raise UsageError(f"'{place}' cannot be written: choose a file in a folder that you may write to.")
    return place


def orbit_paths(path: str | PathLike[str], count: int) -> tuple[Path, ...]:
    """Return the files that an orbit of `count` pictures becomes.

    OUT.webp is one animation; OUT.png and OUT.exr become OUT-000.png and so on. UsageError as for a picture.
    """
    place = check_picture_path(path)
    if place.suffix.lower() == ANIMATED:
        return (place,)
    digits = max(3, len(str(count - 1)))
    numbered = (place.with_name(f"{place.stem}-{i:0{digits}d}{place.suffix}") for i in range(count))
    return tuple(check_picture_path(name) for name in numbered)


def write_picture(
    path: str | PathLike[str], rgba: Float32, exposure: float = 0.0, tonemap: str = "none"
) -> None:
    """Write a frame (height, width, 4).

    ``.png``: 8-bit sRGB, exposed and tone mapped. ``.webp``: the same, compressed with a loss that is hard to
    see. ``.exr``: float32 linear Rec.709 times 2^exposure, never tone mapped; A is how much of the pixel the
    model covers. RGB holds the background in all, so it is not premultiplied by A.
    Raises UsageError for any other ending and a place that cannot be written to.
    """
    place = check_picture_path(path)
    _write({place: lambda: rgba}, exposure, tonemap)


def write_orbit(
    path: str | PathLike[str],
    frames: Iterable[Float32],
    count: int,
    exposure: float = 0.0,
    tonemap: str = "none",
) -> tuple[Path, ...]:
    """Write `count` frames, each (height, width, 4), to `orbit_paths` and return those: all files or none.

    `frames` may draw each picture when it is asked for. An animation loops for ever, `TURN_MS` a turn.
    Raises UsageError as `write_picture`, and for an animation too large to be held.
    """
    paths = orbit_paths(path, count)
    drawn = iter(frames)
    if paths[0].suffix.lower() == ANIMATED:
        write_or_refuse(
            {paths[0]: lambda unfinished: _write_animation(unfinished, drawn, count, exposure, tonemap)}
        )
    else:
        _write({place: lambda: next(drawn) for place in paths}, exposure, tonemap)
    return paths


def webp_bytes(pixels: NDArray[np.uint8]) -> bytes:
    """Return sRGB pixels (height, width, 3) as a WebP file."""
    stream = io.BytesIO()
    _as_image(pixels).save(stream, format="WEBP", quality=_WEBP_QUALITY)
    return stream.getvalue()


def _write(frames: Mapping[Path, Callable[[], Float32]], exposure: float, tonemap: str) -> None:
    def writing(place: Path, frame: Callable[[], Float32]) -> Callable[[Path], None]:
        encode = _WRITERS[place.suffix.lower()]
        return lambda unfinished: encode(str(unfinished), frame(), exposure, tonemap)

    write_or_refuse({place: writing(place, frame) for place, frame in frames.items()})


def _as_image(pixels: NDArray[np.uint8]) -> PIL.Image.Image:
    import PIL.Image

    height, width, _ = pixels.shape
    if max(height, width) > _WEBP_SIDE_MAX:
        raise UsageError(f"A WebP picture has at most {_WEBP_SIDE_MAX} pixels a side; choose PNG or EXR.")
    return PIL.Image.fromarray(pixels)


def _write_animation(
    name: Path, frames: Iterator[Float32], count: int, exposure: float, tonemap: str
) -> None:
    first = next(frames)
    if count * first.shape[0] * first.shape[1] > _ANIMATION_PIXELS_MAX:
        raise UsageError(
            f"{count} pictures of {first.shape[1]} × {first.shape[0]} are too large for one animation; "
            "ask for fewer, smaller or numbered ones (.png)."
        )
    images = [_as_image(display_pixels(first, exposure, tonemap))]
    images += [_as_image(display_pixels(frame, exposure, tonemap)) for frame in frames]
    images[0].save(
        name,
        format="WEBP",
        save_all=True,
        append_images=images[1:],
        duration=max(_PICTURE_MS_MIN, round(TURN_MS / count)),
        loop=0,
        quality=_WEBP_QUALITY,
    )


def _write_png(name: str, rgba: Float32, exposure: float, tonemap: str) -> None:
    import PIL.Image

    PIL.Image.fromarray(display_pixels(rgba, exposure, tonemap)).save(name, format="PNG")


def _write_webp(name: str, rgba: Float32, exposure: float, tonemap: str) -> None:
    _as_image(display_pixels(rgba, exposure, tonemap)).save(name, format="WEBP", quality=_WEBP_QUALITY)


def _write_exr(name: str, rgba: Float32, exposure: float, tonemap: str) -> None:
    import OpenEXR

    scaled = rgba.astype(np.float32)
    scaled[..., :3] *= np.float32(2.0**exposure)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGBA": np.ascontiguousarray(scaled)}) as file:
        try:
            file.write(name)
        except RuntimeError as error:  # how OpenEXR tells of a full disk
            raise OSError(str(error)) from error


_WRITERS: Final[Mapping[str, Callable[[str, Float32, float, str], None]]] = MappingProxyType(
    {".png": _write_png, ".webp": _write_webp, ".exr": _write_exr}
)
