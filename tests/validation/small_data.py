"""Assets whose buffers hold a few given numbers, for tests of what is said of data."""

from __future__ import annotations

import base64
import json
import struct
from typing import Any

__all__ = ["BYTE", "FLOAT", "SHORT", "UNSIGNED_BYTE", "UNSIGNED_INT", "UNSIGNED_SHORT"]
__all__ += ["IDENTITY", "Data", "binary"]

BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126

IDENTITY = [1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]

_CODES = {BYTE: "b", UNSIGNED_BYTE: "B", SHORT: "h", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I", FLOAT: "f"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


class Data:
    """An asset with one buffer that grows with every accessor."""

    def __init__(self, **root: Any) -> None:
        self.blob = b""
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.root = root

    def view(self, raw: bytes, **more: Any) -> int:
        """Add bytes and return the index of their buffer view."""
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(raw), **more})
        self.blob += raw
        return len(self.views) - 1

    def accessor(
        self, kind: str, component: int, numbers: list[float], stride: int | None = None, **more: Any
    ) -> int:
        """Add an accessor, with bytes of 0x7f between elements `stride` apart, and return its index."""
        width = _WIDTHS[kind]
        size = width * struct.calcsize(_CODES[component])
        raw = struct.pack(f"<{len(numbers)}{_CODES[component]}", *numbers)
        if stride is not None:
            elements = (raw[start : start + size] for start in range(0, len(raw), size))
            raw = b"".join(element + b"\x7f" * (stride - size) for element in elements)
        view = self.view(raw, **({"byteStride": stride} if stride is not None else {}))
        accessor = {"bufferView": view, "componentType": component, "count": len(numbers) // width}
        accessor |= {"type": kind, **more}
        self.accessors.append({key: value for key, value in accessor.items() if value is not None})
        return len(self.accessors) - 1

    def sparse(self, indices: list[int], component: int, numbers: list[float]) -> dict[str, Any]:
        """Return the sparse part of an accessor."""
        values = struct.pack(f"<{len(numbers)}{_CODES[component]}", *numbers)
        return {
            "count": len(indices),
            "indices": {"bufferView": self.view(bytes(indices)), "componentType": UNSIGNED_BYTE},
            "values": {"bufferView": self.view(values)},
        }

    def positions(self, count: int) -> int:
        """Add that many positions, all 0."""
        return self.accessor("VEC3", FLOAT, [0.0] * 3 * count, min=[0, 0, 0], max=[0, 0, 0])

    @property
    def asset(self) -> dict[str, Any]:
        """The glTF object."""
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.blob or b"\0").decode()
        buffers = [{"byteLength": len(self.blob) or 1, "uri": uri}]
        arrays = {"accessors": self.accessors, "bufferViews": self.views, "buffers": buffers}
        return {**{key: value for key, value in arrays.items() if value}, **self.root}


def binary(asset: dict[str, Any], chunk: bytes | None) -> bytes:
    """Return a GLB with that BIN chunk."""
    text = json.dumps({"asset": {"version": "2.0"}, **asset}).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    if chunk is not None:
        body += struct.pack("<I4s", len(chunk), b"BIN\0") + chunk
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body
