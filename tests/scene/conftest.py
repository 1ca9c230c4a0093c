"""A small writer of glTF files, so that each test states only what it is about."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, DTypeLike

from gltf_iri.scene.load import Model, load

_COMPONENT = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_TYPE = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class AssetWriter:
    """Collects accessors into one embedded buffer; everything else is written straight into `json`."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "asset.gltf"
        self.json: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "accessors": [],
            "bufferViews": [],
            "scenes": [{"nodes": [0]}],
            "scene": 0,
            "nodes": [{"mesh": 0}],
        }
        self._bytes = bytearray()

    def accessor(self, values: ArrayLike, dtype: DTypeLike = "f4", *, normalized: bool = False) -> int:
        """Append an accessor of `values` (count, components); each element is padded to 4 bytes."""
        array = np.asarray(values, dtype=dtype)
        array = array.reshape(len(array), -1)
        width = array.shape[1] * array.dtype.itemsize
        stride = width if array.shape[1] in (1, 16) else -(-width // 4) * 4
        rows = np.zeros((len(array), stride), dtype=np.uint8)
        rows[:, :width] = np.ascontiguousarray(array).view(np.uint8).reshape(len(array), width)
        view: dict[str, Any] = {"buffer": 0, "byteOffset": len(self._bytes), "byteLength": rows.size}
        if stride != width:
            view["byteStride"] = stride
        self._bytes += rows.tobytes() + b"\0" * (-rows.size % 4)
        self.json["bufferViews"].append(view)
        accessor: dict[str, Any] = {
            "bufferView": len(self.json["bufferViews"]) - 1,
            "componentType": _COMPONENT[array.dtype.str[1:]],
            "count": len(array),
            "type": _TYPE[array.shape[1]],
        }
        if normalized:
            accessor["normalized"] = True
        if array.dtype.kind == "f" and array.shape[1] == 3 and np.all(np.isfinite(array)):
            accessor["min"], accessor["max"] = array.min(axis=0).tolist(), array.max(axis=0).tolist()
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def primitive(
        self, positions: ArrayLike, indices: ArrayLike | None = None, **rest: Any
    ) -> dict[str, Any]:
        """Add a primitive to mesh 0 and return its JSON; `rest` goes into it, attributes are merged."""
        primitive: dict[str, Any] = {"attributes": {"POSITION": self.accessor(positions)}}
        if indices is not None:
            primitive["indices"] = self.accessor(np.reshape(indices, (-1, 1)), "u2")
        primitive["attributes"].update(rest.pop("attributes", {}))
        primitive.update(rest)
        meshes = self.json.setdefault("meshes", [{"primitives": []}])
        meshes[0]["primitives"].append(primitive)
        return primitive

    def load(self) -> Model:
        """Write the file and open it."""
        if self._bytes:
            data = base64.b64encode(self._bytes).decode("ascii")
            uri = f"data:application/octet-stream;base64,{data}"
            self.json["buffers"] = [{"byteLength": len(self._bytes), "uri": uri}]
        document = {key: value for key, value in self.json.items() if value != []}
        self.path.write_text(json.dumps(document), encoding="utf-8")
        return load(self.path)


@pytest.fixture
def asset(tmp_path: Path) -> AssetWriter:
    return AssetWriter(tmp_path)


@pytest.fixture
def triangle(asset: AssetWriter) -> AssetWriter:
    """One triangle in the plane z = 0, facing +Z."""
    asset.primitive([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    return asset
