"""What the header of a compressed picture says, and what can be wrong with it."""

from __future__ import annotations

from typing import Any

__all__ = ["ImageDataError", "ImageEndError", "ImageInfo", "Segments"]

# Real pictures have some dozens of segments before their pixels; this many are read within half a second.
_MOST_SEGMENTS = 500_000

# So many bytes between two segments take as long as one segment.
_FILL_BYTES = 256


class ImageDataError(ValueError):
    """The header is broken; the message says what of it."""


class ImageEndError(ValueError):
    """The bytes end within the header."""


class Segments:
    """How many segments of pictures are still read: chunks of PNG, marker segments of JPEG.

    One count serves all pictures of a file: a hostile one could name the same bytes many times.
    """

    __slots__ = ("_left",)

    def __init__(self) -> None:
        self._left = _MOST_SEGMENTS

    def count(self) -> None:
        """Count one more; raises ImageDataError where there were too many."""
        self._left -= 1
        if self._left < 0:
            raise ImageDataError(f"more than {_MOST_SEGMENTS} segments stand before the pixels")

    def count_fill(self, length: int) -> None:
        """Count bytes that belong to no segment."""
        self._left -= length // _FILL_BYTES


class ImageInfo:
    """What a picture is, by its header.

    pixel_format : "rgb", "rgba", "luminance" or "luminance-alpha"; None where the header names none.
    primaries, transfer : "srgb", "linear" or "custom"; None where the format has no such statement.
    bits : of one channel; of an index for a palette.
    is_unsupported : it has colours, oblong pixels or frames that glTF ignores.
    """

    __slots__ = (
        *("bits", "height", "is_unsupported", "media_type", "pixel_format"),
        *("primaries", "transfer", "width"),
    )

    def __init__(
        self,
        media_type: str,
        width: int,
        height: int,
        pixel_format: str | None,
        bits: int,
        *,
        primaries: str | None = None,
        transfer: str | None = None,
        is_unsupported: bool = False,
    ) -> None:
        self.media_type = media_type
        self.width = width
        self.height = height
        self.pixel_format = pixel_format
        self.bits = bits
        self.primaries = primaries
        self.transfer = transfer
        self.is_unsupported = is_unsupported or "custom" in (primaries, transfer)

    @property
    def has_power_of_two_sides(self) -> bool:
        """Whether width and height both are powers of two."""
        return all(side > 0 and side & (side - 1) == 0 for side in (self.width, self.height))

    def to_json(self) -> dict[str, Any]:
        """Return the object "image" of the report's `info`."""
        told = {
            "width": self.width,
            "height": self.height,
            "format": self.pixel_format,
            "primaries": self.primaries,
            "transfer": self.transfer,
            "bits": self.bits or None,
        }
        return {key: value for key, value in told.items() if value is not None}
