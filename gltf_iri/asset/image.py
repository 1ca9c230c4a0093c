"""Compressed pictures to RGBA pixels. The bytes say what they are; a wrong media type is only remarked."""

from __future__ import annotations

import io
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.guard import Budget
from gltf_iri.asset.limits import MAX_IMAGE_PIXELS
from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

__all__ = ["Image", "decode_image", "sniff_media_type"]

_PILLOW_NAMES: Final[Mapping[str, str]] = {"image/png": "PNG", "image/jpeg": "JPEG", "image/webp": "WEBP"}

# Offset of IHDR's bit depth: the signature and IHDR lead every PNG (ISO 15948 §5.6, §11.2.2).
_PNG_BIT_DEPTH_AT: Final = 24

_STRIP_ROWS: Final = 256


@dataclass(frozen=True, slots=True)
class Image:
    """Decoded pixels, uint8 (height, width, 4), row 0 on top, values as stored; `bits` are the file's own."""

    pixels: NDArray[np.uint8]
    mime_type: str
    name: str
    bits: int


def sniff_media_type(data: bytes) -> str | None:
    """Tell PNG, JPEG, WebP and KTX2 by their first bytes; None for anything else."""
    if data.startswith(b"\x89PNG\r\n\x1a\n"):
        return "image/png"
    if data.startswith(b"\xff\xd8\xff"):
        return "image/jpeg"
    if data[:4] == b"RIFF" and data[8:12] == b"WEBP":
        return "image/webp"
    if data.startswith(b"\xabKTX 20\xbb"):
        return "image/ktx2"
    return None


def decode_image(
    data: bytes, declared: str | None, name: str, pointer: str, budget: Budget
) -> tuple[Image, list[str]]:
    """Decode to RGBA and return the image and remarks.

    Grey becomes R = G = B, a missing alpha 255. Colour profiles and gamma are ignored, as glTF 2.0 §3.8.3
    wants: the colour space follows from the use. Raises AssetError if the bytes are no picture, a broken
    one, or one too large.
    """
    found = sniff_media_type(data)
    if found is None or found not in _PILLOW_NAMES:
        what = "KTX2" if found == "image/ktx2" else f"bytes that start with {data[:8]!r}"
        raise AssetError(f"the image holds {what}; PNG, JPEG and WebP are read", pointer=pointer)
    notes = []
    if declared and declared != found:
        notes.append(f"{pointer}: declared as {shown(declared)}, but read as {found}, which its bytes are.")
    bits = data[_PNG_BIT_DEPTH_AT] if found == "image/png" and len(data) > _PNG_BIT_DEPTH_AT else 8
    pixels = _pixels(data, found, bits, pointer, budget, notes)
    return Image(pixels, found, name, bits), notes


def _pixels(
    data: bytes, media_type: str, bits: int, pointer: str, budget: Budget, notes: list[str]
) -> NDArray[np.uint8]:
    import PIL.Image

    # Pillow warns of large pictures and odd metadata; size is bounded here, and only the pixels count.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with PIL.Image.open(io.BytesIO(data), formats=[_PILLOW_NAMES[media_type]]) as picture:
                width, height = picture.size
                if width * height > MAX_IMAGE_PIXELS:
                    raise AssetError(
                        f"the image has {width} × {height} pixels, more than the {MAX_IMAGE_PIXELS} allowed",
                        pointer=pointer,
                    )
                budget.spend(width * height * 4, pointer)
                notes += _remarks(picture, bits, pointer)
                pixels = _rgba(picture, bits)
        except AssetError:
            raise
        except PIL.UnidentifiedImageError as error:
            raise AssetError(
                f"the {media_type} is cut off or broken at its start", pointer=pointer
            ) from error
        except PIL.Image.DecompressionBombError as error:
            raise AssetError(
                f"the image has more than the {MAX_IMAGE_PIXELS} pixels allowed", pointer=pointer
            ) from error
        # Fed hostile bytes, a decoder fails in more ways than its documentation lists.
        except Exception as error:
            reason = str(error).rstrip(".") or type(error).__name__
            raise AssetError(f"the {media_type} cannot be decoded: {reason}", pointer=pointer) from error
    pixels.setflags(write=False)
    return pixels


def _rgba(picture: PillowImage, bits: int) -> NDArray[np.uint8]:
    """Convert to (height, width, 4) by strips: Pillow would hold the whole picture three times over."""
    width, height = picture.size
    pixels = np.zeros((height, width, 4), np.uint8)
    for top in range(0, height, _STRIP_ROWS):
        below = min(top + _STRIP_ROWS, height)
        pixels[top:below] = np.asarray(_as_rgba(picture.crop((0, top, width, below)), bits))
    return pixels


def _remarks(picture: PillowImage, bits: int, pointer: str) -> list[str]:
    remarks = []
    if bits == 16:
        remarks.append(f"{pointer}: of 16 bits a channel the upper 8 are used, off by at most 1/255.")
        if "transparency" in picture.info:
            remarks.append(f"{pointer}: the transparent colour of a 16-bit image is ignored.")
    if getattr(picture, "n_frames", 1) > 1:
        remarks.append(f"{pointer}: the image is animated; its first frame is used.")
    if picture.mode == "CMYK":
        remarks.append(f"{pointer}: the image is CMYK; it is converted without a colour profile.")
    return remarks


def _as_rgba(picture: PillowImage, bits: int) -> PillowImage:
    """Convert any mode that PNG, JPEG and WebP decode to."""
    import PIL.Image

    if bits == 16:
        # tRNS names a 16-bit colour; Pillow would compare it with the upper 8 bits.
        picture.info.pop("transparency", None)
    elif picture.mode == "L" and bits < 8 and "transparency" in picture.info:
        # Pillow scales the pixels to 8 bits, but not the grey that tRNS names.
        picture.info["transparency"] *= 255 // (2**bits - 1)
    if picture.mode.startswith("I"):
        # Pillow's own conversion clips 16-bit grey at 255 instead of scaling it.
        upper = np.right_shift(np.asarray(picture), 8).astype(np.uint8)
        picture = PIL.Image.fromarray(upper)
    return picture.convert("RGBA")
