"""One renderer for all, and shading inputs made by hand: equal pixels in a row, seen from one metre."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from gltf_iri.comparison.judge import Shot, judge
from gltf_iri.comparison.result import Comparison
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.frame import BRAGG_INPUT_TARGETS, Frame, ShadingInputs
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import studio
from gltf_iri.scene.model import Camera, Environment, Light


@pytest.fixture(scope="session")
def renderer(_session_context: moderngl.Context) -> Iterator[Renderer]:
    """Keeps programs and prefiltered light from test to test; tests ask for `gl_context` beside it."""
    renderer = Renderer(_session_context)
    yield renderer
    renderer.release()


@pytest.fixture(scope="session")
def studio_light() -> Environment:
    """The studio, the same object for every test: it is prefiltered once."""
    return studio()


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
            "iridescence_thickness_std_nm": 0,
            "transmitted_radiance": (0, 0, 0),
            "transmission": 0,
            "clearcoat_normal": (0, 0, 1),
            "clearcoat": 0,
            "clearcoat_radiance": (0, 0, 0),
            "clearcoat_roughness": 0,
            "sheen_color": (0, 0, 0),
            "sheen_roughness": 0,
            "sheen_radiance": (0, 0, 0),
            "anisotropy_tangent": (1, 0, 0),
            "anisotropy_strength": 0,
            "layer_albedos": (0, 0, 0),
            "facet_cosine": 0,
            **{colour: (0, 0, 0) for colour, _ in BRAGG_INPUT_TARGETS},
            **{scalar: 0 for _, scalar in BRAGG_INPUT_TARGETS if scalar},
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


@pytest.fixture
def judged(row_of_pixels, camera, plan, sun) -> Callable[..., Comparison]:
    """Judge a row of lit, film-covered metal whose GLSL colours are Python's own plus `error`."""

    def build(
        error: float = 0.0,
        *,
        count: int = 16,
        name: str = "test",
        method: str = "khr-guarded",
        **values: object,
    ) -> Comparison:
        material = Material(name=name, iridescence=Iridescence(factor=1.0, film_ior=1.35))
        inputs = row_of_pixels(count, metallic=1, iridescence_factor=1, **values)
        its_plan = plan(Effect.METAL, method=method, layering="specular", name=name)
        shot = Shot(
            file="row.gltf",
            materials=(material,),
            plans=(its_plan,),
            lights=(sun(),),
            camera=camera,
            white="D65",
            exposure=1.0,
            setup={"size": [count, 1], "camera": "eye", "environment": "none", "exposure": 0.0},
            program={"gltf_iri": "0"},
        )
        exact = judge(frame_of(inputs), shot).pictures.python
        return judge(frame_of(replace(inputs, colour=(exact + error).astype(np.float32))), shot)

    return build


def frame_of(inputs: ShadingInputs) -> Frame:
    rgba = np.concatenate([inputs.colour, np.ones((*inputs.material.shape, 1), np.float32)], axis=-1)
    return Frame(rgba, "made by hand", 0.0, (), inputs)
