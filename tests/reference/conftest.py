"""Scenes made in code for the ray caster, and the same scenes drawn by OpenGL."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from gltf_iri.asset.texture import Texture
from gltf_iri.material.material import Material
from gltf_iri.planning.decide import plan_materials
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.tracer import Tracer
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Light, Primitive, Scene

# Where layers_three_wavelengths.py lies.
sys.path.append(str(Path(__file__).resolve().parent))


@dataclass
class Images:
    """Stands for a document: only its textures are asked for."""

    pixels: list[Any] = field(default_factory=list)
    textures: list[Texture] = field(default_factory=list)

    def add(self, pixels: ArrayLike, **sampler: int) -> int:
        """Append an image (h, w, 4) of uint8 and a texture of it; return the texture's index."""
        self.pixels.append(np.asarray(pixels, np.uint8))
        self.textures.append(Texture(len(self.pixels) - 1, **sampler))
        return len(self.textures) - 1

    def texture(self, index: int) -> Texture:
        return self.textures[index]

    def image(self, index: int) -> SimpleNamespace:
        return SimpleNamespace(pixels=self.pixels[index])


def triangles(positions: ArrayLike, faces: ArrayLike, **changes: Any) -> Primitive:
    """A primitive with normals along +Z unless told otherwise."""
    points = np.asarray(positions, np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (len(points), 1))
    made = Primitive(
        "/meshes/0/primitives/0", "", 0, points, normals, np.asarray(faces, np.uint32), np.eye(4)
    )
    return replace(made, **changes)


def quad(**changes: Any) -> Primitive:
    """The square from (−1, −1) to (1, 1) at z = 0, facing +Z, with glTF's UVs."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    uv = np.stack([corners[:, 0] / 2 + 0.5, 0.5 - corners[:, 1] / 2], axis=-1)
    made = triangles(corners, [[0, 1, 2], [0, 2, 3]], uvs=(uv.astype(np.float32),))
    return replace(made, **changes)


def sphere(stacks: int = 24, **changes: Any) -> Primitive:
    """The unit sphere, `stacks` by twice as many quads, without triangles of no area at its poles."""
    turns = 2 * stacks
    polar, turn = np.meshgrid(
        np.linspace(0, np.pi, stacks + 1), np.linspace(0, 2 * np.pi, turns + 1), indexing="ij"
    )
    points = np.stack([np.sin(polar) * np.sin(turn), np.cos(polar), np.sin(polar) * np.cos(turn)], axis=-1)
    points[:, -1] = points[:, 0]
    points[0], points[-1] = (0, 1, 0), (0, -1, 0)
    uv = np.stack([turn / (2 * np.pi), polar / np.pi], axis=-1).reshape(-1, 2).astype(np.float32)
    points = points.reshape(-1, 3).astype(np.float32)
    row, column = np.meshgrid(np.arange(stacks), np.arange(turns), indexing="ij")
    i = row * (turns + 1) + column
    lower = np.stack([i, i + turns + 1, i + turns + 2], -1)[:-1].reshape(-1, 3)
    upper = np.stack([i, i + turns + 2, i + 1], -1)[1:].reshape(-1, 3)
    return triangles(points, np.concatenate([lower, upper]), normals=points, uvs=(uv,), **changes)


def camera(distance: float = 4.0, half_height: float | None = None) -> Camera:
    """On +Z looking at the origin: parallel rays over ±half_height, or 40° of perspective without it."""
    view = np.eye(4)
    view[2, 3] = -distance
    if half_height is not None:
        return Camera("", "orthographic", view, 0.1, 100.0, xmag_m=half_height, ymag_m=half_height)
    return Camera("", "perspective", view, 0.1, 100.0, yfov_rad=np.radians(40.0))


def scene_of(
    primitives: Primitive | Sequence[Primitive],
    materials: Material | Sequence[Material] | None = None,
    *,
    images: Images | None = None,
    lights: Sequence[Light] = (),
    method: str | None = None,
) -> tuple[Any, ...]:
    """Return (model, scene, plans), what both renderers take."""
    primitives = [primitives] if isinstance(primitives, Primitive) else primitives
    materials = [materials or Material()] if isinstance(materials, Material | None) else materials
    model = Model(Path("made.gltf"), images or Images(), tuple(materials), ())  # type: ignore[arg-type]
    return model, Scene("", tuple(primitives), (), tuple(lights)), plan_materials(materials, method=method)


def tracer_of(*arguments: Any, **options: Any) -> Tracer:
    """Return a tracer of what `scene_of` makes of the arguments."""
    return Tracer(build_stage(*scene_of(*arguments, **options)))


@pytest.fixture
def props() -> SimpleNamespace:
    """What stands on a stage."""
    return SimpleNamespace(
        Images=Images, triangles=triangles, quad=quad, sphere=sphere, camera=camera, scene_of=scene_of
    )


@pytest.fixture
def trace() -> Callable[..., Tracer]:
    """Build a tracer from primitives and materials."""
    return tracer_of
