"""A stage for the renderer's tests: primitives, materials and images made in code, drawn without files."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import moderngl
import numpy as np
import pytest
from numpy.typing import ArrayLike

from gltf_iri.asset.texture import Texture
from gltf_iri.material.material import Material
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.frame import Frame
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import white
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Light, Primitive, Scene

# For the files that tests share.
sys.path.append(str(Path(__file__).resolve().parent))


@dataclass
class Images:
    """Stands for a document: only its textures are asked for."""

    pixels: list[Any] = field(default_factory=list)
    textures: list[Texture] = field(default_factory=list)

    def add(self, pixels: ArrayLike, **sampler: int) -> int:
        """Append an image (h, w, 4) of uint8 and a texture of it; NEAREST unless told otherwise."""
        self.pixels.append(np.asarray(pixels, np.uint8))
        self.textures.append(
            Texture(len(self.pixels) - 1, **({"mag_filter": 9728, "min_filter": 9728} | sampler))
        )
        return len(self.textures) - 1

    def texture(self, index: int) -> Texture:
        return self.textures[index]

    def image(self, index: int) -> SimpleNamespace:
        return SimpleNamespace(pixels=self.pixels[index])


def quad(**changes: Any) -> Primitive:
    """The square from (−1, −1) to (1, 1) at z = 0, facing +Z, with glTF's UVs: (0, 0) at its upper left."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    uv = np.stack([corners[:, 0] / 2 + 0.5, 0.5 - corners[:, 1] / 2], axis=-1)
    made = Primitive(
        "/meshes/0/primitives/0",
        "quad",
        0,
        corners,
        np.tile(np.float32([0, 0, 1]), (4, 1)),
        np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        np.eye(4),
        uvs=(uv.astype(np.float32),),
    )
    return replace(made, **changes)


def sphere(**changes: Any) -> Primitive:
    """The unit sphere, 64 by 128 quads."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, 65), np.linspace(0, 2 * np.pi, 129), indexing="ij")
    points = np.stack([np.sin(polar) * np.sin(turn), np.cos(polar), np.sin(polar) * np.cos(turn)], axis=-1)
    points = points.reshape(-1, 3).astype(np.float32)
    i = (np.arange(64)[:, None] * 129 + np.arange(128)).ravel()
    triangles = np.concatenate([np.stack([i, i + 129, i + 130], -1), np.stack([i, i + 130, i + 1], -1)])
    made = Primitive(
        "/meshes/0/primitives/0", "sphere", 0, points, points, triangles.astype(np.uint32), np.eye(4)
    )
    return replace(made, **changes)


def camera(distance: float = 4.0, half_height: float | None = None) -> Camera:
    """On +Z looking at the origin: parallel rays over ±half_height, or 40° of perspective without it."""
    view = np.eye(4)
    view[2, 3] = -distance
    if half_height is not None:
        return Camera("", "orthographic", view, 0.1, 100.0, xmag_m=half_height, ymag_m=half_height)
    return Camera("", "perspective", view, 0.1, 100.0, yfov_rad=np.radians(40.0))


@dataclass
class Stage:
    """Draws what a test puts on it."""

    renderer: Renderer

    def draw(
        self,
        primitives: Primitive | Sequence[Primitive],
        materials: Material | Sequence[Material],
        *,
        images: Images | None = None,
        lights: Sequence[Light] = (),
        environment: Environment | None = None,
        seen_from: Camera | None = None,
        size: tuple[int, int] = (64, 64),
        method: str | None = None,
        plans: Sequence[MaterialPlan] | None = None,
        **options: Any,
    ) -> Frame:
        primitives = [primitives] if isinstance(primitives, Primitive) else primitives
        materials = [materials] if isinstance(materials, Material) else materials
        model = Model(Path("stage"), images or Images(), tuple(materials), ())  # type: ignore[arg-type]
        scene = Scene("", tuple(primitives), (), tuple(lights))
        plans = plan_materials(materials, method=method) if plans is None else plans
        view = seen_from or camera(half_height=1.0)
        return self.renderer.render(model, scene, plans, view, environment, size=size, **options)


@pytest.fixture(scope="session")
def _renderers() -> dict[moderngl.Context, Renderer]:
    return {}


@pytest.fixture
def stage(gl_context: moderngl.Context, _renderers: dict[moderngl.Context, Renderer]) -> Stage:
    """A stage whose renderer keeps its programs from test to test."""
    return Stage(_renderers.setdefault(gl_context, Renderer(gl_context)))


@pytest.fixture(scope="session")
def furnace() -> Environment:
    """The white environment, the same object for every test: it is prefiltered once."""
    return white()


@pytest.fixture
def props() -> SimpleNamespace:
    """What stands on a stage."""
    return SimpleNamespace(Images=Images, quad=quad, sphere=sphere, camera=camera)
