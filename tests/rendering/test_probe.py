"""The probe is exact: what goes in comes out, in the evaluators' own shapes."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.probe import Probe
from gltf_iri.rendering.source import ShaderError

LAYERING = "material/film_layering.glsl"


@pytest.fixture
def probe(gl_context: moderngl.Context) -> Probe:
    return Probe(gl_context)


def test_numbers_pass_through_unrounded(probe: Probe) -> None:
    colours = np.random.default_rng(0).normal(0, 1e6, (1000, 3)).astype(np.float32)
    np.testing.assert_array_equal(probe.call("vec3", "common/math.glsl", [colours]), colours)
    np.testing.assert_array_equal(
        probe.call("float", "common/math.glsl", [colours[:, 0]], "float"), colours[:, 0]
    )


def test_arguments_broadcast_as_in_the_evaluators(probe: Probe) -> None:
    base = base_from_f0(np.linspace(0, 0.9, 12).reshape(1, 4, 3))
    film = Film.of(np.linspace(0, 1, 5)[:, None], 400.0, 1.3, base)
    whole = probe.evaluate("khr", film)
    assert whole.rgb.shape == (5, 4, 3)
    assert whole.rgb.dtype == np.float64
    one = probe.evaluate("khr", Film.of(film.cos_theta_1[2, 0], 400.0, 1.3, base_from_f0(base.f0[0, 3])))
    np.testing.assert_array_equal(whole.rgb[2, 3], one.rgb)


def test_evaluation_names_method_and_renderer(probe: Probe, gl_context: moderngl.Context) -> None:
    made = probe.evaluate("khr-guarded", Film.of(0.5, 400.0, 1.3, base_from_f0([0.04] * 3)))
    assert (made.method, made.backend) == ("khr-guarded", renderer_name(gl_context))


def test_probe_is_called_as_the_evaluators_and_lists_the_same_undefined_rows(probe: Probe) -> None:
    film = Film.of(0.5, 400.0, 1.6, base_from_f0([[0.5] * 3, [0.04] * 3, [1.0] * 3]))
    expected = evaluate("khr", film, white="E")
    made = probe.evaluate("khr", film, white="E")
    assert made.white == expected.white == "E"
    assert len(expected.undefined) == 2
    assert {case: rows.tolist() for case, rows in made.undefined.items()} == {
        case: rows.tolist() for case, rows in expected.undefined.items()
    }
    with pytest.raises(UsageError, match="D65"):
        probe.evaluate("khr", film, white="A")


def test_no_rows_give_no_rows(probe: Probe) -> None:
    assert probe.call("max3", "common/math.glsl", [np.zeros((0, 3))], "float").shape == (0,)


def test_member_of_a_struct_is_read(probe: Probe) -> None:
    weight = probe.call("rgb_mix", LAYERING, [[0.1, 0.5, 0.2]], "float", member="base_weight")
    np.testing.assert_allclose(weight, 0.5, rtol=0, atol=1e-7)


def test_unknown_method_names_those_that_there_are(probe: Probe) -> None:
    with pytest.raises(UsageError, match=r"kehr.*khr, khr-guarded"):
        probe.evaluate("kehr", Film.of(0.5, 400.0, 1.3, base_from_f0([0.04] * 3)))


def test_a_table_fills_the_sampler_of_its_name(probe: Probe) -> None:
    one_wavelength = np.float32([[[1.0 / 512.0, 0.0, 0.0]], [[1.0, 0.0, 0.5]]])
    film = Film.of(np.float32(0.6), 400.0, 1.5, base_from_f0([0.25] * 3))
    made = probe.call(
        "iridescent_fresnel_spectral",
        "optics/spectral.glsl",
        [1.0, 1.5, [0.25] * 3, 400.0, 0.6],
        tables={"spectral_rule": one_wavelength},
    )
    reflectance = film_spectrum(film, np.array([512.0]))[:, 0]
    np.testing.assert_allclose(made, reflectance * [1.0, 0.0, 0.5], rtol=0, atol=1e-6)


def test_shapes_that_do_not_go_together_are_refused(probe: Probe) -> None:
    with pytest.raises(UsageError, match="broadcast"):
        probe.call("f_schlick", "optics/fresnel.glsl", [np.zeros(4), np.zeros(5)], "float")
    with pytest.raises(UsageError, match="three channels"):
        probe.call("max3", "common/math.glsl", [np.zeros(4)], "float", argument_types=["vec3"])


def test_call_of_an_unknown_function_is_a_shader_error(probe: Probe) -> None:
    with pytest.raises(ShaderError, match="f_schlik"):
        probe.call("f_schlik", "optics/fresnel.glsl", [np.zeros(4), np.zeros(4)], "float")
