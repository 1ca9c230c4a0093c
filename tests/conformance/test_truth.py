"""The vectors hold against mpmath's matrices, sums over facets' normals, and the package's own truth."""

from __future__ import annotations

from functools import partial
from typing import Any

import independent
import numpy as np
import pytest

from gltf_iri.conformance.bragg_input import read_bragg_input
from gltf_iri.conformance.bragg_truth import WAVELENGTHS_NM
from gltf_iri.conformance.facet_sum import Facets, Passing
from gltf_iri.conformance.khr_rows import khr_film
from gltf_iri.conformance.spectral_sum import NotSettledError, colour_sum
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.layer_stack import sight_of

LAST_DECIMAL = 6e-10


def sight(row: Any) -> Any:
    return sight_of(row.host_ior, row.cos_theta_i, row.cos_theta_o, row.cos_phi)


def test_facets_reflect_what_mpmaths_matrices_do(bragg: dict[str, Any]) -> None:
    for each in bragg["rows"][::41]:
        row = read_bragg_input(each["input"])
        for facets, given in zip(row.facets, each["output"]["reflectance"], strict=True):
            cosine = min(float(sight(row).cos_h), 1.0)
            for nm, value in zip(WAVELENGTHS_NM, given, strict=True):
                assert abs(float(independent.cell_reflectance(facets, nm, cosine)) - value) <= LAST_DECIMAL


def test_what_sums_over_facets_and_wavelengths_stand_on_is_mpmaths_too(bragg: dict[str, Any]) -> None:
    """Of every kind of row, at angles from grazing on: float64 matrices are in the sums of tests below."""
    g = np.random.default_rng(7)
    for each in bragg["rows"][::31]:
        for facets in read_bragg_input(each["input"]).facets:
            if facets.cells > 30:
                continue
            nm, cosine = g.uniform(360.0, 830.0), g.uniform(0.05, 1.0)
            fast = independent.fast_reflectance(facets, np.asarray(nm), np.asarray(cosine))
            assert abs(float(independent.cell_reflectance(facets, nm, cosine)) - fast) <= 1e-9


def test_films_reflect_what_mpmaths_matrices_do(khr: dict[str, Any]) -> None:
    for each in khr["rows"][::37]:
        film = khr_film(each["input"])
        for nm, channels in zip(WAVELENGTHS_NM, each["output"]["reflectance"], strict=True):
            for index, value in zip(film.base.index.real.reshape(-1), channels, strict=True):
                cosine = float(film.cos_theta_1)
                if np.isfinite(index) and cosine > 0.0:
                    indices = [1.0, float(film.film_ior), float(index)]
                    R = independent.matrix_reflectance(indices, [float(film.thickness_nm)], nm, cosine)
                    assert abs(float(R) - value) <= LAST_DECIMAL


def test_layers_let_pass_what_their_facets_normals_add_up_to(bragg: dict[str, Any]) -> None:
    """Over tilts and turns of facets, of which the vectors know one integral only, F_α."""
    count = 0
    for each in bragg["rows"]:
        row = read_bragg_input(each["input"])
        for facets, given in zip(row.facets, each["output"]["transmittance"], strict=True):
            is_simple = facets.alpha > 0.0 and facets.cells <= 2 and facets.d1_nm + facets.d2_nm < 500.0
            cosine = float(sight(row).cos_i)
            if is_simple and cosine > 0.2 and facets.n1 >= facets.host_ior and count < 5:
                T = independent.facet_transmittance(facets, np.array(WAVELENGTHS_NM), cosine, 120)
                np.testing.assert_allclose(T, given, rtol=0.0, atol=1e-8)
                count += 1
    assert count == 5


def test_colours_of_smooth_layers_are_those_of_another_sum(bragg: dict[str, Any]) -> None:
    rows = [(read_bragg_input(each["input"]), each["output"]) for each in bragg["rows"]]
    smooth = [(row, out) for row, out in rows if row.facets and is_easy(row) and row.is_smooth]
    for row, out in smooth[:6]:
        seen = sight(row)
        way_in, way_out, facet = (
            [partial(independent.fast_reflectance, each, cosine=np.asarray(c)) for each in row.facets]
            for c in (seen.cos_i, seen.cos_o, seen.cos_h)
        )

        def passed(nm: Any, ways: list[Any] = [*way_in, *way_out]) -> Any:  # noqa: B006
            return np.prod([1.0 - R(nm) for R in ways], axis=0)

        first = independent.colour_of(facet[0])
        np.testing.assert_allclose(first, out["layer_colours"][0], rtol=0, atol=2e-9)
        np.testing.assert_allclose(independent.colour_of(passed), out["base_colour"], rtol=0, atol=2e-9)
        once = independent.colour_of(partial(passed, ways=way_out))
        np.testing.assert_allclose(once, out["entering"], rtol=0, atol=2e-9)
    assert len(smooth) >= 6


def is_easy(row: Any) -> bool:
    return all(each.cells <= 12 and (each.alpha == 0.0) == row.is_smooth for each in row.facets)


def test_the_packages_truth_is_the_vectors_within_what_it_says(bragg: dict[str, Any]) -> None:
    """Layers up to five cells, by `layers-single`: 1e-6 in colours, and f_r by the lobe's height."""
    count = 0
    for each in bragg["rows"][::13]:
        row = read_bragg_input(each["input"])
        size = sum(f.cells * (f.d1_nm + f.d2_nm) for f in row.facets)
        if not row.facets or row.is_smooth or size > 1500.0 or count == 4:
            continue
        seen = sight(row)
        layers = tuple(BraggLayer.of(f.n1, f.n2, f.d1_nm, f.d2_nm, f.cells, f.alpha) for f in row.facets)
        share = (1.0 - row.metallic) * (1.0 - row.transmission)
        base = LayerBase.of(share * row.base_colour, row.base_colour, row.metallic, row.base_alpha)
        stack = LayerStack.of(layers, row.host_ior, base)
        colours, out = LayersSingle(stack, "D65"), each["output"]
        passed = colours.passed(seen.cos_i, seen.cos_o)
        np.testing.assert_allclose(passed, out["base_colour"], rtol=0, atol=1e-6)
        np.testing.assert_allclose(colours.entering(seen.cos_o), out["entering"], rtol=0, atol=1e-6)
        f = brdf(stack, Pose.of(row.cos_theta_i, row.cos_theta_o, row.cos_phi), colours)
        np.testing.assert_allclose(f, out["stack_brdf"], rtol=1e-5, atol=1e-6)
        count += 1
    assert count == 4


def test_the_packages_film_truth_is_the_vectors(khr: dict[str, Any]) -> None:
    for each in khr["rows"][::29]:
        truth = evaluate("spectral", khr_film(each["input"])).rgb
        np.testing.assert_allclose(truth, each["output"]["truth"], rtol=0.0, atol=2e-9)


def test_a_spectrum_of_one_is_white_and_one_of_straight_pieces_is_exact() -> None:
    white = colour_sum(lambda nm: np.stack([np.ones_like(nm), nm / 500.0]))
    assert np.abs(white[0] - 1.0).max() <= 1e-14
    np.testing.assert_allclose(white[1], independent.colour_of(lambda nm: nm / 500.0), rtol=0, atol=1e-13)


def test_what_does_not_settle_is_said_and_not_given() -> None:
    with pytest.raises(NotSettledError):
        Passing(Facets(1.0, 1.0, 2.2, 500.0, 500.0, 200, 0.5), np.array([0.5]))


def test_facets_that_mirror_nothing_pass_what_masking_leaves() -> None:
    cosine = np.array([0.05, 0.5, 1.0])
    T = Passing(Facets(1.0, 1.0, 1.0, 100.0, 100.0, 3, 0.2), cosine).transmittance(np.array([500.0]))[:, 0]
    g1 = 2.0 * cosine / (cosine + np.sqrt(0.04 + 0.96 * cosine**2))
    np.testing.assert_allclose(T, g1, rtol=0.0, atol=1e-12)
