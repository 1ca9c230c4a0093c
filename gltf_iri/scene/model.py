"""What a scene is: plain arrays and numbers that OpenGL and the CPU both read.

Lengths are metres, angles radians, colours linear Rec.709; +Y is up, cameras look along −Z (glTF 2.0 §3.4).
Vertex arrays are float32 as the files hold them, matrices float64 in column-vector convention (p' = M p).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError

__all__ = ["Camera", "Environment", "Light", "Primitive", "Scene"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
UInt32 = NDArray[np.uint32]


@dataclass(frozen=True, slots=True)
class Primitive:
    """Triangles with one material, in their rest pose (morph weights and skin of the default state applied).

    `world` maps positions to world space; for a skinned mesh the joints have already done that and it is the
    identity. `normals` always exist: flat ones are made where the file has none.
    """

    pointer: str  # JSON Pointer of the glTF primitive
    node_name: str
    material: int  # index into the file's materials, or DEFAULT_MATERIAL
    positions: Float32  # (n, 3)
    normals: Float32  # (n, 3), unit length
    triangles: UInt32  # (m, 3), indices of vertices
    world: Float64  # (4, 4)
    tangents: Float32 | None = None  # (n, 4), w is the handedness
    uvs: tuple[Float32, ...] = ()  # up to two arrays (n, 2)
    colours: Float32 | None = None  # (n, 4), linear

    @property
    def is_mirrored(self) -> bool:
        """True where `world` turns the winding around (negative determinant, glTF 2.0 §3.7.4)."""
        return bool(np.linalg.det(self.world[:3, :3]) < 0)


@dataclass(frozen=True, slots=True)
class Camera:
    """A view: `view` maps world to eye space; `aspect` None means "the picture's own"."""

    name: str
    kind: Literal["perspective", "orthographic"]
    view: Float64  # (4, 4)
    znear_m: float
    zfar_m: float | None  # None: infinite perspective
    yfov_rad: float = 0.0
    xmag_m: float = 0.0
    ymag_m: float = 0.0
    aspect: float | None = None

    @property
    def position(self) -> Float64:
        """Eye position in world space, (3,)."""
        return np.asarray(np.linalg.inv(self.view)[:3, 3], dtype=np.float64)


@dataclass(frozen=True, slots=True)
class Light:
    """KHR_lights_punctual: candela for point and spot, lux for directional."""

    name: str
    kind: Literal["directional", "point", "spot"]
    colour: tuple[float, float, float]
    intensity: float
    position: Float64  # (3,), world
    direction: Float64  # (3,), unit, the way the light travels
    range_m: float | None = None
    inner_cone_rad: float = 0.0  # the two angles are read for a spot only
    outer_cone_rad: float = 0.0


@dataclass(frozen=True, slots=True)
class Environment:
    """Image light: an equirectangular map, row 0 at +Y, column centre at +X, +Z to its right.

    direction → (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π).
    """

    name: str
    radiance: Float32  # (height, width, 3), linear Rec.709, finite and not negative
    notes: tuple[str, ...] = ()  # what was changed while reading, in sentences for the report
    backdrop: tuple[float, float, float] | None = None  # behind the scene; None: the map, out of focus


@dataclass(frozen=True, slots=True)
class Scene:
    """One glTF scene, flattened."""

    name: str
    primitives: tuple[Primitive, ...]
    cameras: tuple[Camera, ...]
    lights: tuple[Light, ...]
    notes: tuple[str, ...] = ()  # what was left out, in sentences for the report

    def vertices(self) -> Float64:
        """Return every vertex that a triangle uses in world space, (n, 3); AssetError for an empty scene."""
        placed = []
        for p in self.primitives:
            is_used = np.zeros(len(p.positions), dtype=bool)
            is_used[p.triangles] = True
            used = p.positions[is_used].astype(np.float64)
            placed.append(used @ p.world[:3, :3].T + p.world[:3, 3])
        if not placed:
            raise AssetError("the scene has no triangles to draw")
        return np.concatenate(placed)

    def bounds(self) -> tuple[Float64, Float64]:
        """Corners (lowest, highest) of the world-space box around every vertex, each (3,)."""
        points = self.vertices()
        return points.min(axis=0), points.max(axis=0)
