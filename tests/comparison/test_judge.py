"""The verdict: what it catches, what it leaves out, and that it says so."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.comparison.methods import BRANCH
from gltf_iri.errors import AssetError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE


def test_equal_pixels_agree_to_the_rounding_of_float32(judged) -> None:
    comparison = judged()
    assert comparison.agrees
    (material,) = comparison.materials
    assert material.glsl_vs_python.all.pixels == 16
    assert material.glsl_vs_python.all.max_relative < 1e-6


def test_an_injected_deviation_is_found(judged) -> None:
    comparison = judged(0.01)
    assert not comparison.agrees
    assert comparison.whole.glsl_vs_python.rough.max_abs > GLSL_PIXEL_RELATIVE


def test_pixels_smoother_than_the_limit_are_reported_but_not_judged(judged) -> None:
    comparison = judged(1e6, perceptual_roughness=0.1)
    split = comparison.materials[0].glsl_vs_python
    assert comparison.agrees
    assert split.rough.pixels == 0
    assert split.smooth.max_abs > 1e5


def test_a_pixel_that_is_no_number_is_a_disagreement(judged) -> None:
    assert not judged(float("nan")).agrees


def test_film_error_is_the_methods_own_at_the_pixels_angle(judged) -> None:
    """Head on, 400 nm of index 1.35 over the base colour: the same film evaluated directly."""
    error = judged().materials[0].method_vs_truth
    base = np.array([0.8, 0.4, 0.2], np.float32).astype(np.float64)
    film = Film.of(1.0, 400.0, float(np.float32(1.35)), base_from_f0(base))
    method, truth = evaluate("khr-guarded", film).rgb, evaluate("spectral", film).rgb
    np.testing.assert_allclose(error.max_abs, np.max(np.abs(method - truth)), rtol=1e-9)
    np.testing.assert_allclose(error.delta_e_mean, delta_e_2000(method, truth), rtol=1e-9)


def test_undefined_cases_of_the_text_are_counted(judged) -> None:
    material = judged(method="khr", base_color=(1, 1, 1)).materials[0]
    assert set(material.undefined.values()) == {16}
    assert any("divides by zero" in case for case in material.undefined)


def test_both_whites_are_named(judged) -> None:
    row = judged(method="khr").to_json()["materials"][0]
    assert row["white"]["truth"] == "D65"
    assert "1.205" in row["white"]["method"]


def test_pixels_on_a_branch_of_the_text_are_left_out_and_counted(judged) -> None:
    """Base index = film index after the text's offset of 0.0001: float32 may turn the phase by π or not."""
    f0 = ((1.35 - 1.0) / (1.35 + 1.0)) ** 2 - 0.0001
    material = judged(0.5, method="khr", base_color=(f0, 0.5, 0.5)).materials[0]
    assert material.left_out == 16
    assert material.glsl_vs_python.all.pixels == 0
    assert material.undefined[BRANCH] == 16


def test_a_film_of_the_file_that_no_method_takes_is_an_error_of_the_file(judged) -> None:
    with pytest.raises(AssetError, match="thickness") as caught:
        judged(iridescence_thickness_nm=1e30)
    assert caught.value.pointer == "/materials/0/extensions/KHR_materials_iridescence"
