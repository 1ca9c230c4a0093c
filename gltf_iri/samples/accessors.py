"""Arrays of a glTF file: the bytes of its buffer, and the views and accessors that say what they are."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.rounding import rounded

if TYPE_CHECKING:
    import pygltflib

__all__ = ["Accessors"]

_FLOAT, _UNSIGNED_SHORT = 5126, 5123
_VERTICES, _INDICES = 34962, 34963  # bufferView.target


class Accessors:
    """The one buffer of an asset in the making; an array that several meshes share is stored once."""

    def __init__(self, gltf: pygltflib.GLTF2) -> None:
        import pygltflib

        self.binary = bytearray()
        self._model, self._gltf = pygltflib, gltf
        self._added: dict[int, tuple[NDArray[Any], int]] = {}

    def attribute(self, values: NDArray[np.float64], kind: str, *, bounded: bool = False) -> int:
        """Return the accessor of a vertex attribute; POSITION must state its bounds (glTF 2.0 §3.7.2.1)."""
        if id(values) not in self._added:
            index = self.floats(values, kind, bounded=bounded, target=_VERTICES)
            self._added[id(values)] = (values, index)  # the array stays, and its id with it
        return self._added[id(values)][1]

    def indices(self, triangles: NDArray[np.uint16]) -> int:
        """Return the accessor of the corners of triangles, (m, 3)."""
        if id(triangles) not in self._added:
            index = self._accessor(triangles.ravel(), "SCALAR", _UNSIGNED_SHORT, _INDICES)
            self._added[id(triangles)] = (triangles, index)
        return self._added[id(triangles)][1]

    def floats(
        self, values: NDArray[np.float64], kind: str, *, bounded: bool = False, target: int | None = None
    ) -> int:
        """Add an accessor of `values` on the grid of rounding.py, with its bounds where `bounded`."""
        data = rounded(values).astype(np.float32)
        index = self._accessor(data, kind, _FLOAT, target)
        if bounded:
            self._gltf.accessors[index].min = [float(low) for low in data.min(axis=0)]
            self._gltf.accessors[index].max = [float(high) for high in data.max(axis=0)]
        return index

    def view(self, content: bytes, target: int | None = None) -> int:
        """Add `content` to the buffer and return its view."""
        view = self._model.BufferView(
            buffer=0, byteOffset=len(self.binary), byteLength=len(content), target=target
        )
        self._gltf.bufferViews.append(view)
        self.binary += content + bytes(-len(content) % struct.calcsize("I"))  # the next view starts aligned
        return len(self._gltf.bufferViews) - 1

    def _accessor(self, data: NDArray[Any], kind: str, component_type: int, target: int | None) -> int:
        little_endian = data.astype(data.dtype.newbyteorder("<"), copy=False)
        view = self.view(little_endian.tobytes(), target)
        self._gltf.accessors.append(
            self._model.Accessor(bufferView=view, componentType=component_type, count=len(data), type=kind)
        )
        return len(self._gltf.accessors) - 1
