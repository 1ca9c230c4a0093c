"""Films and images that are out of range, broken or not what they say."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from typing import Any, Final

from wrong.sound import FILM, JPEG, PNG, WEBP, Edits, png, uri


def image_of(data: bytes, media_type: str = "image/png") -> Edits:
    return {"/images/0/uri": uri(data, media_type)}


def film(**properties: Any) -> Edits:
    return {f"{FILM}/{key}": value for key, value in properties.items()}


EDITED: Final[Mapping[str, Edits]] = {
    # The film.
    "film-factor-above-1": film(iridescenceFactor=1.5),
    "film-factor-text": film(iridescenceFactor="1"),
    "film-factor-null": film(iridescenceFactor=None),
    "film-ior-below-1": film(iridescenceIor=0.5),
    "film-ior-3e38": film(iridescenceIor=3e38),
    "film-thickness-negative": film(iridescenceThicknessMinimum=-1),
    "film-thickness-1e39": film(iridescenceThicknessMaximum=1e39),
    "film-thickness-3e38": film(iridescenceThicknessMaximum=3e38),
    "film-thickness-reversed": film(iridescenceThicknessMinimum=900, iridescenceThicknessMaximum=100),
    "film-texture-dangling": film(iridescenceTexture={"index": 1}),
    "film-texture-number": film(iridescenceTexture=0),
    "film-texture-without-index": film(iridescenceThicknessTexture={}),
    "film-texture-negative": film(iridescenceThicknessTexture={"index": -1}),
    "film-texture-third-uv-set": film(iridescenceThicknessTexture={"index": 0, "texCoord": 2}),
    "film-unlit": {"/materials/0/extensions/KHR_materials_unlit": {}},
    "base-color-of-3": {"/materials/0/pbrMetallicRoughness/baseColorFactor": [1, 1, 1]},
    "alpha-mode-unknown": {"/materials/0/alphaMode": "GLASS"},
    # Images.
    "png-bomb": image_of(png(60000, 60000, 8, 6, b"\0")),
    "png-16-bit": image_of(png(1, 1, 16, 2, b"\0" + b"\x80\x40" * 3)),
    "png-truncated": image_of(PNG[:45]),
    "png-header-only": image_of(PNG[:8]),
    "png-of-size-0": image_of(png(0, 0, 8, 6, b"")),
    "png-checksum": image_of(
        PNG.replace(struct.pack(">I", zlib.crc32(b"IEND")), b"\0\0\0\0").replace(b"\xff\xff", b"\xff\xfe")
    ),
    "jpeg-truncated": image_of(JPEG[:60], "image/jpeg"),
    "jpeg-as-png": image_of(JPEG, "image/png"),
    "webp-truncated": image_of(WEBP[:24], "image/webp"),
    "image-text": image_of(b"This is no picture."),
    "image-empty": image_of(b""),
    "image-media-type-text": {"/images/0/mimeType": "text/html"},
    "image-view-beyond-buffer": {
        "/images/0": {"bufferView": 3, "mimeType": "image/png"},
        "/bufferViews/3": {"buffer": 0, "byteOffset": 200, "byteLength": 4096},
    },
    "image-view-dangling": {"/images/0": {"bufferView": 99, "mimeType": "image/png"}},
    "image-without-source": {"/images/0": {}},
    "image-with-two-sources": {"/images/0/bufferView": 0},
}
