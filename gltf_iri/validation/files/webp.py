"""WebP headers (RFC 9649): the first chunk, which says how large the picture is."""

from __future__ import annotations

from struct import unpack_from

from gltf_iri.validation.files.image_info import ImageDataError, ImageEndError, ImageInfo

__all__ = ["read_webp"]

# After "RIFF", a length and "WEBP" comes the first chunk: its name, a length, and its data (§2.4).
_NAME_AT, _DATA_AT = 12, 20

# Bits of the first byte of VP8X (§2.7.1).
_ANIMATION, _ALPHA, _ICC_PROFILE = 0x02, 0x10, 0x20


def read_webp(data: bytes | memoryview) -> ImageInfo:
    """Return what the first chunk says; raises ImageDataError or ImageEndError."""
    name = bytes(data[_NAME_AT : _NAME_AT + 4])
    if len(data) < (25 if name == b"VP8L" else 30):
        raise ImageEndError
    if name == b"VP8 ":
        # The frame tag and start code, then 14 bits each and 2 of scaling (RFC 6386 §9.1).
        width, height = (side & 0x3FFF for side in unpack_from("<HH", data, _DATA_AT + 6))
        return _info(width, height)
    if name == b"VP8L":
        # A signature byte, then 14 bits each, less one, and one of alpha (§3.4).
        (bits,) = unpack_from("<I", data, _DATA_AT + 1)
        return _info((bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1, has_alpha=bool(bits >> 28 & 1))
    if name == b"VP8X":
        flags = data[_DATA_AT]
        width, height = (
            int.from_bytes(data[at : at + 3], "little") + 1 for at in (_DATA_AT + 4, _DATA_AT + 7)
        )
        return _info(
            width,
            height,
            has_alpha=bool(flags & _ALPHA),
            colours="custom" if flags & _ICC_PROFILE else "srgb",
            is_animated=bool(flags & _ANIMATION),
        )
    raise ImageDataError("its first chunk is none of 'VP8 ', VP8L and VP8X")


def _info(
    width: int, height: int, *, has_alpha: bool = False, colours: str = "srgb", is_animated: bool = False
) -> ImageInfo:
    return ImageInfo(
        "image/webp",
        width,
        height,
        "rgba" if has_alpha else "rgb",
        8,
        primaries=colours,
        transfer=colours,
        is_unsupported=is_animated,
    )
