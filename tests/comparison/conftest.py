"""Shading inputs made by hand: a row of equal pixels, seen head on from one metre."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.frame import ShadingInputs
from gltf_iri.scene.model import Camera, Light


@pytest.fixture
def row_of_pixels() -> Callable[..., ShadingInputs]:
    """Build inputs of `count` equal pixels in one row; keywords replace single quantities."""

    def build(count: int = 1, **values: object) -> ShadingInputs:
        quantities: dict[str, object] = {
            "colour": (0, 0, 0),
            "normal": (0, 0, 1),
            "metallic": 0,
            "position": (0, 0, 0),
            "perceptual_roughness": 0.5,
            "base_color": (0.8, 0.4, 0.2),
            "iridescence_factor": 0,
            "dielectric_f0": (0.04, 0.04, 0.04),
            "specular_weight": 1,
            "reflected_radiance": (0, 0, 0),
            "dfg_a": 0,
            "irradiance": (0, 0, 0),
            "dfg_b": 0,
            "emission": (0, 0, 0),
            "iridescence_thickness_nm": 400,
        }
        quantities.update(values)
        rows = {
            name: np.broadcast_to(np.asarray(value, np.float32), (1, count, *np.shape(value))).copy()
            for name, value in quantities.items()
        }
        return ShadingInputs(material=np.zeros((1, count), np.int32), **rows)

    return build


@pytest.fixture
def camera() -> Camera:
    view = np.eye(4)
    view[2, 3] = -1.0  # the eye stands at (0, 0, 1)
    return Camera("eye", "perspective", view, znear_m=0.01, zfar_m=None, yfov_rad=0.5)


@pytest.fixture
def plan() -> Callable[..., MaterialPlan]:
    """Build a plan; with a method it has a film."""

    def build(
        *effects: Effect, method: str | None = None, layering: str = "core", name: str = "test"
    ) -> MaterialPlan:
        if method is not None:
            effects = (*effects, Effect.IRIDESCENCE)
        return MaterialPlan(0, name, effects, method, "chosen by the test", layering)

    return build


@pytest.fixture
def sun() -> Callable[..., Light]:
    """Build a directional light of 3 lux that shines along `direction`."""

    def build(direction: tuple[float, float, float] = (0.0, 0.0, -1.0)) -> Light:
        return Light("sun", "directional", (1.0, 1.0, 1.0), 3.0, np.zeros(3), np.array(direction))

    return build
