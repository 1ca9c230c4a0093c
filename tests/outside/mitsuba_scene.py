"""A scene in Mitsuba's own terms, and its picture with the error of every pixel."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["View", "batches", "environment_emitter", "mitsuba_scene", "write_ply"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class View:
    """A perspective camera that keeps +Y up: what glTF and Mitsuba are both told."""

    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    yfov_rad: float
    size: tuple[int, int]  # width and height, pixels

    def directions(self) -> Float64:
        """Return unit directions (height, width, 3) through the pixels' centres, row 0 on top."""
        width, height = self.size
        forward = np.subtract(self.target, self.eye)
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, (0.0, 1.0, 0.0))
        right /= np.linalg.norm(right)
        slope = np.tan(0.5 * self.yfov_rad)
        across = slope * (2.0 * np.arange(width) + 1.0 - width) / height
        upwards = slope * (height - 2.0 * np.arange(height) - 1.0) / height
        rays = forward + across[None, :, None] * right + upwards[:, None, None] * np.cross(right, forward)
        return np.asarray(rays / np.linalg.norm(rays, axis=-1, keepdims=True))


def write_ply(path: Path, positions: NDArray[Any], normals: NDArray[Any], triangles: NDArray[Any]) -> None:
    """Write a mesh with normals, every digit of its float32."""
    head = ["ply", "format ascii 1.0", f"element vertex {len(positions)}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    head += [f"element face {len(triangles)}", "property list uchar uint vertex_indices", "end_header"]
    rows = np.hstack([positions, normals]).astype(np.float32)
    vertices = [" ".join(f"{number:.9g}" for number in row) for row in rows]
    faces = [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join([*head, *vertices, *faces, ""]), encoding="ascii")


def environment_emitter(mi: ModuleType, grey: Callable[[Float64], Float64], height: int) -> dict[str, Any]:
    """Return an environment of D65's colour whose radiance is `grey` of a direction (..., 3).

    In Mitsuba's map the first and the last row are the poles and columns are centred; the first begins at −Z,
    and +X follows after a quarter.
    """
    width = 2 * height
    azimuth = 2.0 * np.pi * (np.arange(width) + 0.5) / width
    polar = np.pi * np.arange(height) / (height - 1)
    polar, azimuth = np.meshgrid(polar, azimuth, indexing="ij")
    out = np.sin(polar)
    directions = np.stack([out * np.sin(azimuth), np.cos(polar), -out * np.cos(azimuth)], axis=-1)
    texels = np.repeat(grey(directions)[..., None], 3, axis=-1).astype(np.float32)
    return {"type": "envmap", "bitmap": mi.Bitmap(texels)}


def mitsuba_scene(
    mi: ModuleType,
    mesh: Path | None,
    bsdf: Mapping[str, Any],
    emitters: Sequence[Mapping[str, Any]],
    view: View,
    samples: int,
) -> Any:
    """Load a scene of one mesh (or none), `samples` a pixel."""
    film = {
        "type": "hdrfilm",
        "width": view.size[0],
        "height": view.size[1],
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
    }
    inside = {
        "type": "perspective",
        "fov": np.degrees(view.yfov_rad),
        "fov_axis": "y",
        "to_world": mi.ScalarTransform4f().look_at(list(view.eye), list(view.target), [0, 1, 0]),
        "film": film,
    }
    sampler = {"type": "independent", "sample_count": samples}
    scene = {
        "type": "scene",
        # Emission, then one meeting with the surface.
        "integrator": {"type": "path", "max_depth": 2},
        "sensor": {"type": "pixel_centres", "inside": inside, "film": film, "sampler": sampler},
    }
    scene |= {f"emitter {number}": dict(emitter) for number, emitter in enumerate(emitters)}
    if mesh is not None:
        scene["mesh"] = {"type": "ply", "filename": str(mesh), "bsdf": dict(bsdf)}
    return mi.load_dict(scene)


def batches(mi: ModuleType, scene: Any, count: int) -> Float64:
    """Return independent pictures (count, height, width, 3), linear Rec.709 in which D65 is white."""
    return np.stack([np.array(mi.render(scene, seed=seed), dtype=np.float64) for seed in range(count)])
