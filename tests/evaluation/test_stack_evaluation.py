"""A stack described in numbers: its shares and its BRDF are the model's own, and the face gives both."""

from __future__ import annotations

import numpy as np
import pytest

import gltf_iri
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_energy import stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.evaluation.stack_evaluation import StackEvaluation, evaluate_stack, stack_of

ROWS = [(1.3, 1.45, 100.0, 120.0, 3, 0.3), (1.3, 1.5, 90.0, 110.0, 2, 0.1)]
BASE = {"host_ior": 1.3, "base_diffuse": 0.2, "base_metal": [0.8, 0.6, 0.4], "base_alpha": 0.3}
STACK = LayerStack.of(
    tuple(BraggLayer.of(*row) for row in ROWS), 1.3, LayerBase.of(0.2, [0.8, 0.6, 0.4], 1.0, 0.3)
)
COSINES = np.array([[1.0, 0.6], [0.3, 0.05]])
FAST = {"method": "layers-bands", "parameters": {"bands": 4}}
COLOURS = layer_colours("layers-bands", STACK, parameters={"bands": 4})


def face(**given: object) -> StackEvaluation:
    done = gltf_iri.evaluate(**({"layers": ROWS, "cos_theta_1": COSINES} | BASE | FAST | given))
    assert isinstance(done, StackEvaluation)
    return done


def test_without_a_light_the_face_tells_where_all_of_it_goes() -> None:
    cosines = np.array([[0.9], [0.3]])
    coarse = {"nodes": 32, "wavelengths": 32}
    given = {"layers": ROWS[:1], "base_metal": None, "base_alpha": None, "cos_theta_1": cosines}
    stack = LayerStack.of(STACK.layers[:1], 1.3, LayerBase.of(0.2))
    found = face(**given, method="layers-single-table", parameters=coarse)
    energy = stack_energy(stack, [0.9, 0.3], layer_colours("layers-single-table", stack, parameters=coarse))
    for name, expected in (("rgb", "reflected"), *((n, n) for n in ("transmitted", "absorbed", "from_base"))):
        np.testing.assert_array_equal(getattr(found, name), getattr(energy, expected).reshape(2, 1, 3))
    assert (found.method, found.parameters) == ("layers-single-table", coarse)
    # What was at the base has passed and counts among the transmitted.
    total = found.rgb - found.from_base + found.transmitted + found.absorbed
    np.testing.assert_allclose(total, 1.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("light", [(0.7,), (0.7, -1.0), (0.7, 0.25)])
def test_lit_from_one_direction_it_is_the_brdf(light: tuple[float, ...]) -> None:
    found = face(light=light)
    turn = light[1] if len(light) == 2 else -1.0
    np.testing.assert_array_equal(found.rgb, brdf(STACK, Pose.of(0.7, COSINES, turn), COLOURS))
    np.testing.assert_array_equal(found.mirrored, coating_reflectance(1.3, COSINES))
    assert found.transmitted is None and found.absorbed is None


def test_by_default_it_is_the_truth_in_the_first_layers_medium_on_nothing() -> None:
    done = gltf_iri.evaluate(layers=ROWS[:1], cos_theta_1=0.8, light=(0.6, 0.0))
    stack = LayerStack.of((BraggLayer.of(*ROWS[0]),), 1.3)
    expected = brdf(stack, Pose.of(0.6, 0.8, 0.0), layer_colours("layers-single", stack))
    assert (done.method, done.rgb.shape) == ("layers-single", (3,))
    np.testing.assert_array_equal(done.rgb, expected)


def test_under_a_light_layers_broadcast() -> None:
    layer = (1.0, 1.5, np.linspace(80.0, 120.0, 3)[:, None], 120.0, 3, 0.3)
    done = gltf_iri.evaluate(layers=[layer], cos_theta_1=[0.3, 0.9], light=(0.6,), **FAST)
    assert done.rgb.shape == (3, 2, 3)
    one = gltf_iri.evaluate(layers=[(1.0, 1.5, 100.0, 120.0, 3, 0.3)], cos_theta_1=0.9, light=(0.6,), **FAST)
    np.testing.assert_allclose(done.rgb[1, 1], one.rgb, rtol=0, atol=1e-12)
    with pytest.raises(UsageError, match="give numbers"):
        gltf_iri.evaluate(layers=[layer], cos_theta_1=0.3)


def test_a_smooth_layers_mirror_image_is_told() -> None:
    done = evaluate_stack("layers-bands", stack_of([(1, 1.5, 90, 90, 2, 0.0)]), [0.7, 0.8], (0.7,))
    assert done.undefined["the mirror image of a smooth layer"].tolist() == [True, False]


def test_a_budget_chooses_here_too() -> None:
    done = gltf_iri.evaluate(layers=ROWS[:1], cos_theta_1=0.8, light=(0.6,), budget=0.0)
    assert (done.method, done.delta_e) == ("layers-single", 0.0)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"layers": []}, "wants six"),
        ({"layers": [(1.0, 1.5, 100.0)]}, "wants six"),
        ({"layers": [(1.0, 1.5 + 0.1j, 100.0, 100.0, 3, 0.1)], "host_ior": 1.0}, "real indices"),
        ({"base_metal": None}, "give both"),
        ({"base_diffuse": 0.5}, "more than 1"),
        ({"base_diffuse": 1.5, "base_metal": None, "base_alpha": None}, "must lie in"),
        ({"light": (0.5, 0.5, 0.5)}, "at most"),
        ({"light": (1.5,)}, "must lie in"),
        ({"cos_theta_1": -0.5}, "must lie in"),
        ({"method": "khr"}, "no method 'khr' for layers"),
        ({"white": "A"}, "no white 'A'"),
        ({"thickness_nm": 300.0}, "no film"),
        ({"bragg": (1.5, 1.6, 90.0, 80.0, 5)}, "no film and no mirror"),
        ({"backend": "numba"}, "backend"),
    ],
    ids=str,
)
def test_nothing_said_of_layers_is_ignored(wrong: dict[str, object], says: str) -> None:
    with pytest.raises(UsageError, match=says):
        face(**wrong)


@pytest.mark.parametrize("name", ["base_diffuse", "base_metal", "base_alpha", "light"])
def test_what_belongs_to_layers_is_refused_without_them(name: str) -> None:
    with pytest.raises(UsageError, match="go with layers"):
        gltf_iri.evaluate(cos_theta_1=1.0, thickness_nm=300.0, **{name: 0.5})
