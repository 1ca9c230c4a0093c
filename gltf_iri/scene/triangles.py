"""Topology: vertex indices of lists, strips and fans to triangles (glTF 2.0 §3.7.2.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["MODES_WITHOUT_TRIANGLES", "read_triangles"]

UInt32 = NDArray[np.uint32]

MODES_WITHOUT_TRIANGLES = {0: "points", 1: "lines", 2: "a line loop", 3: "a line strip"}
_LIST, _STRIP, _FAN = 4, 5, 6


def read_triangles(
    document: Document, primitive: dict[str, Any], vertices: int, pointer: str, notes: list[str]
) -> UInt32:
    """Return (m, 3) indices into the primitive's `vertices` vertices, wound as the file means them.

    Raises AssetError where an index points past the last vertex.
    """
    if "indices" in primitive:
        where = f"{pointer}/indices"
        listed = document.accessor(primitive["indices"])
        if listed.shape[1:] != (1,) or not np.issubdtype(listed.dtype, np.unsignedinteger):
            raise AssetError("indices must be unsigned integers, one a vertex", pointer=where)
        index: UInt32 = listed[:, 0].astype(np.uint32)
        if len(index) and int(index.max()) >= vertices:
            raise AssetError(
                f"index {int(index.max())} points past the last of {vertices} vertices", pointer=where
            )
    else:
        index = np.arange(vertices, dtype=np.uint32)
    return _split(index, primitive.get("mode", _LIST), pointer, notes)


def _split(index: UInt32, mode: int, pointer: str, notes: list[str]) -> UInt32:
    if mode == _LIST:
        whole = len(index) - len(index) % 3
        if whole != len(index):
            notes.append(f"{pointer} ends in an incomplete triangle, which is left out.")
        return index[:whole].reshape(-1, 3)
    first = np.arange(max(len(index) - 2, 0))
    if mode == _STRIP:  # pᵢ = {vᵢ, v₍ᵢ₊₁₊ᵢ mod 2₎, v₍ᵢ₊₂₋ᵢ mod 2₎}: every second one turns around
        odd = first % 2
        return index[np.column_stack([first, first + 1 + odd, first + 2 - odd])]
    if mode == _FAN:  # pᵢ = {vᵢ₊₁, vᵢ₊₂, v₀}
        return index[np.column_stack([first + 1, first + 2, np.zeros_like(first)])]
    raise AssetError(f"there is no primitive mode {mode}", pointer=f"{pointer}/mode")
