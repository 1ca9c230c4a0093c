"""Our shaders, given the vectors' inputs in single precision, answer as it and their fixed rules allow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import moderngl
import numpy as np
import pytest

from gltf_iri.bench.layers_fixed import PROBES
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.conformance.bragg_input import BraggInput, read_bragg_input
from gltf_iri.conformance.bragg_truth import WAVELENGTHS_NM
from gltf_iri.conformance.khr_rows import khr_film
from gltf_iri.evaluation.film import Base, Film
from gltf_iri.optics.layer_stack import sight_of
from gltf_iri.rendering.optics_tables import optics_table
from gltf_iri.rendering.probe import Probe

Record = Callable[[str, object], None]


@pytest.fixture
def probe(gl_context: moderngl.Context) -> Probe:
    return Probe(gl_context)


@pytest.mark.gl
@pytest.mark.parametrize(
    ("method", "quantity", "bound"),
    # The truth by 513 wavelengths: fringes of 5 µm at grazing light err most.
    [("khr", "khr", 5e-6), ("khr-guarded", "khr_guarded", 5e-6), ("spectral", "truth", 1e-4)],
)
def test_films_in_glsl_are_the_vectors(
    method: str, quantity: str, bound: float, khr: dict[str, Any], probe: Probe, record_property: Record
) -> None:
    rows = [row for row in khr["rows"] if row["output"]["khr"] is not None]
    films = [khr_film(row["input"]) for row in rows]
    cosine, thickness_nm, film_ior = (
        np.array([getattr(film, name) for film in films])
        for name in ("cos_theta_1", "thickness_nm", "film_ior")
    )
    base = Base(np.stack([film.base.f0 for film in films]), np.stack([film.base.index for film in films]))
    found = probe.evaluate(method, Film.of(cosine, thickness_nm, film_ior, base)).rgb
    error = np.abs(found - np.array([row["output"][quantity] for row in rows])).max(axis=-1)
    record_property("measured", f"{method}: p99 {np.quantile(error, 0.99):.1e}, max {error.max():.1e}")
    assert error.max() <= bound
    assert np.quantile(error, 0.99) <= 5e-6


def cosines_of(row: BraggInput) -> list[float]:
    """Those of h, i and o in the host."""
    seen = sight_of(row.host_ior, row.cos_theta_i, row.cos_theta_o, row.cos_phi)
    return [min(float(c), 1.0) for c in (seen.cos_h, seen.cos_i, seen.cos_o)]


@pytest.mark.gl
def test_facets_in_glsl_reflect_what_the_vectors_say(
    bragg: dict[str, Any], probe: Probe, record_property: Record
) -> None:
    arguments, given = [], []
    for each in bragg["rows"]:
        row = read_bragg_input(each["input"])
        for f, values in zip(row.facets, each["output"]["reflectance"], strict=True):
            cell = [row.host_ior, f.n1, f.n2, f.d1_nm, f.d2_nm, f.cells]
            arguments += [[*cell, nm, cosines_of(row)[0]] for nm in WAVELENGTHS_NM]
            given += values
    columns, types = list(np.array(arguments).T), ["float"] * 8
    found = probe.call("bragg_reflectance", "optics/bragg.glsl", columns, "float", argument_types=types)
    error = np.abs(found - np.array(given))
    record_property("measured", f"p99 {np.quantile(error, 0.99):.1e}, max {error.max():.1e}")
    # Sharp bands of two hundred cells are moved by a float32 step of a thickness.
    assert error.max() <= 1e-4
    assert np.quantile(error, 0.99) <= 5e-6


@pytest.mark.gl
@pytest.mark.parametrize("count", [1, 2])
def test_colours_in_glsl_are_the_vectors_but_for_their_rules(
    count: int, bragg: dict[str, Any], probe: Probe, record_property: Record
) -> None:
    """layers_single.glsl has 36 angles and 129 wavelengths of what passes: enough for few cells only."""
    pairs = [(read_bragg_input(each["input"]), each["output"]) for each in bragg["rows"]]
    pairs = [(row, output) for row, output in pairs if len(row.facets) == count]
    rows, outputs = [row for row, _ in pairs], [output for _, output in pairs]
    given = [np.array([row.host_ior for row in rows]), np.array([cosines_of(row) for row in rows])]
    for k in range(count):
        films = [row.facets[k] for row in rows]
        given.append(np.array([[f.n1, f.n2, f.alpha] for f in films]))
        given.append(np.array([[f.d1_nm, f.d2_nm, f.cells] for f in films]))
    size_nm = np.array([max(f.cells * (f.d1_nm + f.d2_nm) for f in row.facets) for row in rows])
    tables = {"spectral_rule": optics_table("spectral_rule", "D65", {})}
    truths = {
        f"reflected_{count}": np.array([output["layer_colours"][-1] for output in outputs]),
        f"passed_{count}": np.array([output["base_colour"] for output in outputs]),
    }
    for name, truth in truths.items():
        found = probe.call(name, "optics/layers_single.glsl", given, lines=PROBES, tables=tables)
        delta = delta_e_2000(found, truth)
        for low, high in ((0.0, 1000.0), (1000.0, 2000.0), (2000.0, np.inf)):
            some = delta[(size_nm > low) & (size_nm <= high)]
            numbers = f"median {np.median(some):.1e}, p95 {np.quantile(some, 0.95):.1e}, max {some.max():.1e}"
            record_property("measured", f"{name}, {low:g} to {high:g} nm, {len(some)} rows: {numbers}")
        assert np.median(delta[size_nm <= 1000.0]) <= 1e-2
        assert np.quantile(delta[size_nm <= 2000.0], 0.95) <= 1.0
        assert delta.max() <= 6.0
