"""The sound file that every case makes wrong in one place: a triangle with a film over metal.

Nothing here depends on a compressor's version, so that the same bytes come out everywhere.
"""

from __future__ import annotations

import base64
import copy
import json
import struct
import zlib
from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np

Json = dict[str, Any]
Edits = Mapping[str, Any]

DROP: Final = object()  # as a value: take the property away
WHOLE: Final = ""  # as a key: with the arrays that only a few cases need
FILM: Final = "/materials/0/extensions/KHR_materials_iridescence"
PRIMITIVE: Final = "/meshes/0/primitives/0"

# A grey 2 × 2 JPEG and WebP, from Pillow 11.
JPEG: Final = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAP//////////////////////////////////////////////////////////////////////////////////////wAALCAACAAIBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAAv/EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQEAAD8AT//Z"
)
WEBP: Final = base64.b64decode("UklGRhwAAABXRUJQVlA4TA8AAAAvAUAAAAcQRY7+ByKi/wEA")


def uri(data: bytes, media_type: str = "application/octet-stream") -> str:
    return f"data:{media_type};base64,{base64.b64encode(data).decode()}"


def png(width: int, height: int, depth: int, colour: int, rows: bytes) -> bytes:
    """A PNG whose rows lie uncompressed in one deflate block (RFC 1951 §3.2.4)."""
    stored = b"\x78\x01\x01" + struct.pack("<HH", len(rows), len(rows) ^ 0xFFFF) + rows
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    return png_of_chunks(header, stored + struct.pack(">I", zlib.adler32(rows)))


def png_of_chunks(header: bytes, packed: bytes) -> bytes:
    chunks = ((b"IHDR", header), (b"IDAT", packed), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in chunks
    )


PNG: Final = png(2, 2, 8, 6, (b"\0" + b"\xff\x80\x40\xff" * 2) * 2)

PNG: Final = png(2, 2, 8, 6, (b"\0" + b"\xff\x80\x40\xff" * 2) * 2)

# name: values, component type, type. Each has a buffer view and an accessor, in this order.
ARRAYS: Final = {
    "positions": (np.float32([[-1, -1, 0], [1, -1, 0], [0, 1, 0]]), 5126, "VEC3"),
    "uvs": (np.float32([[0, 1], [1, 1], [0.5, 0]]), 5126, "VEC2"),
    "indices": (np.uint16([[0], [1], [2]]), 5123, "SCALAR"),
    "normals": (np.float32([[0, 0, 1]] * 3), 5126, "VEC3"),
    "joints": (np.uint8([[0, 0, 0, 0]] * 3), 5121, "VEC4"),
    "weights": (np.float32([[1, 0, 0, 0]] * 3), 5126, "VEC4"),
    "inverse_binds": (np.eye(4, dtype=np.float32).reshape(1, 16), 5126, "MAT4"),
    "sparse_indices": (np.uint16([[0], [2]]), 5123, "SCALAR"),
    "sparse_values": (np.float32([[-1, -1, 0], [0, 1, 0]]), 5126, "VEC3"),
}
VIEW: Final = {name: number for number, name in enumerate(ARRAYS)}


BASIC: Final = ("positions", "uvs", "indices")


def packed(names: Iterable[str], **changes: Any) -> tuple[bytes, list[Json]]:
    """The buffer of some arrays, with some values replaced, and its views."""
    data, views = b"", []
    for name in names:
        values = ARRAYS[name][0]
        piece = np.asarray(changes.get(name, values), values.dtype).tobytes()
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(piece)})
        data += piece + b"\0" * (-len(piece) % 4)
    return data, views


def values(**changes: Any) -> Edits:
    """The edits that replace the values of some arrays."""
    if set(changes) <= set(BASIC):
        return {"/buffers/0/uri": uri(packed(BASIC, **changes)[0])}
    return {WHOLE: True, "/buffers/0/uri": uri(packed(ARRAYS, **changes)[0])}


def sound(names: Iterable[str] = BASIC) -> Json:
    data, views = packed(names)
    film = {"iridescenceFactor": 1, "iridescenceThicknessTexture": {"index": 0}}
    return {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_iridescence"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": VIEW["positions"], "TEXCOORD_0": VIEW["uvs"]},
                        "indices": VIEW["indices"],
                        "material": 0,
                    }
                ]
            }
        ],
        "materials": [
            {
                "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                "extensions": {"KHR_materials_iridescence": film},
            }
        ],
        "textures": [{"source": 0}],
        "images": [{"uri": uri(PNG, "image/png")}],
        "accessors": [
            {"bufferView": number, "componentType": component, "count": len(array), "type": kind}
            for number, (array, component, kind) in enumerate(ARRAYS[name] for name in names)
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": uri(data)}],
    }


def edited(edits: Edits) -> Json:
    """The sound file with the values at some JSON Pointers replaced, added or dropped."""
    root = sound(ARRAYS if WHOLE in edits else BASIC)
    for pointer, value in edits.items():
        if pointer == WHOLE:
            continue
        *path, last = pointer[1:].split("/")
        holder: Any = root
        for step in path:
            holder = holder.setdefault(step, {}) if isinstance(holder, dict) else holder[int(step)]
        if value is DROP:
            holder.pop(last, None)
        elif isinstance(holder, list):
            holder[int(last) : int(last) + 1] = [copy.deepcopy(value)]
        else:
            holder[last] = copy.deepcopy(value)
    return root


def text(edits: Edits | None = None) -> bytes:
    return json.dumps(edited(edits or {}), separators=(",", ":")).encode()


def with_token(pointer: str, token: bytes) -> bytes:
    """The sound file with JSON text that json.dumps would not write at a pointer."""
    return text({pointer: "@"}).replace(b'"@"', token)
