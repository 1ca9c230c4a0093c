"""What a picture's first bytes say it is."""

from __future__ import annotations

__all__ = ["media_type_of"]

# Fewer bytes are no picture of any kind: the longest of the signatures below ends here.
_SHORTEST = 14

# PNG (third edition, §5.2), JPEG (ITU-T T.81, B.1.1.3: SOI and the next marker), KTX 2.0 (§3.1).
_SIGNATURES = (
    (b"\x89PNG\r\n\x1a\n", "image/png"),
    (b"\xff\xd8\xff", "image/jpeg"),
    (b"\xabKTX 20\xbb\r\n\x1a\n", "image/ktx2"),
)


def media_type_of(data: bytes | memoryview) -> str | None:
    """Return the media type of a compressed picture, or None where the bytes are none that glTF knows."""
    head = bytes(data[:_SHORTEST])
    if len(head) < _SHORTEST:
        return None
    for signature, media_type in _SIGNATURES:
        if head.startswith(signature):
            return media_type
    # WebP (RFC 9649 §2.4): a RIFF file whose first chunk is VP8, VP8L or VP8X.
    return "image/webp" if head[:4] == b"RIFF" and head[8:] == b"WEBPVP" else None
