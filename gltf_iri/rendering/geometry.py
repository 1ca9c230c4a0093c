"""Primitives as OpenGL buffers, and the matrices that place them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.model import Primitive

if TYPE_CHECKING:
    import moderngl

__all__ = ["GeometryStore", "column_major", "placement_uniforms"]

Float64 = NDArray[np.float64]


class GeometryStore:
    """Uploads each vertex array once, however many primitives and programs read it."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        # The array is kept beside its buffer: its identity is the key only while it lives.
        self._buffers: dict[int, tuple[NDArray[Any], moderngl.Buffer]] = {}
        self._vertex_arrays: list[moderngl.VertexArray] = []

    def vertex_array(self, primitive: Primitive, program: moderngl.Program) -> moderngl.VertexArray:
        """Return the triangles of `primitive`, bound to the attributes that `program` reads."""
        arrays = {
            "in_position": ("3f", primitive.positions),
            "in_normal": ("3f", primitive.normals),
            "in_tangent": ("4f", primitive.tangents),
            "in_uv0": ("2f", primitive.uvs[0] if primitive.uvs else None),
            "in_uv1": ("2f", primitive.uvs[1] if len(primitive.uvs) > 1 else None),
            "in_colour": ("4f", primitive.colours),
        }
        # An attribute without an array reads as 0, which is glTF's advice for a missing UV set.
        content = [
            (self._buffer(array), layout, name)
            for name, (layout, array) in arrays.items()
            if array is not None and name in program
        ]
        vertex_array = self._context.vertex_array(
            program, content, index_buffer=self._buffer(primitive.triangles)
        )
        self._vertex_arrays.append(vertex_array)
        return vertex_array

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for vertex_array in self._vertex_arrays:
            vertex_array.release()
        for _, buffer in self._buffers.values():
            buffer.release()
        self._vertex_arrays.clear()
        self._buffers.clear()

    def _buffer(self, array: NDArray[Any]) -> moderngl.Buffer:
        if id(array) not in self._buffers:
            self._buffers[id(array)] = (array, self._context.buffer(np.ascontiguousarray(array).tobytes()))
        return self._buffers[id(array)][1]


def placement_uniforms(primitive: Primitive) -> dict[str, Any]:
    """Return the world matrix, its inverse, its cofactors for normals, and the sign of mirrored bitangents.

    Cofactors are the inverse transpose times the determinant; with the determinant's sign they turn normals
    outwards under negative scales too, and they exist where a scale of 0 leaves no inverse.
    """
    linear = primitive.world[:3, :3]
    # Scaled to a length near 1, so that products of three tiny or huge entries stay within float32.
    largest = float(np.abs(linear).max())
    linear = linear / largest if largest > 0.0 else linear
    x, y, z = linear.T
    side = -1.0 if primitive.is_mirrored else 1.0
    normal_matrix = side * np.column_stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)])
    return {
        "u_world": column_major(primitive.world),
        "u_world_to_mesh": column_major(_inverse(primitive.world[:3, :3])),
        "u_normal_matrix": column_major(normal_matrix),
        "u_handedness": side,
    }


def _inverse(linear: Float64) -> Float64:
    """Return the inverse of a (3, 3) matrix; 0 where there is none within single precision."""
    with np.errstate(all="ignore"):
        try:
            inverse = np.linalg.inv(linear)
        except np.linalg.LinAlgError:
            return np.zeros((3, 3))
        is_usable = np.all(np.abs(inverse) <= np.finfo(np.float32).max)
    return np.asarray(inverse, dtype=np.float64) if is_usable else np.zeros((3, 3))


def column_major(matrix: Float64) -> tuple[float, ...]:
    """Return the entries of `matrix` in OpenGL's order."""
    return tuple(float(entry) for entry in matrix.T.ravel())
