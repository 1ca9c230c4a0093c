"""The map of cost and error: every registered method stands in it, tables too, and prices ship for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from gltf_iri.backends import has_numba
from gltf_iri.bench import accuracy_glsl, accuracy_tables
from gltf_iri.bench.accuracy_entries import method_entries, table_entries, true_colours
from gltf_iri.bench.accuracy_row import errors_of
from gltf_iri.bench.accuracy_sets import ACCURACY_SETS, THICK_NM, metal_set, thick_set
from gltf_iri.bench.film_parts import point_parts
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.planning.costs import Device, shipped_costs
from gltf_iri.planning.method import METHODS, Domain, method_names
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import NO_FILM, Way

if TYPE_CHECKING:
    import moderngl

SUBJECTS: dict[Domain, Film | Mirror] = {"film": film_set(3), "mirror": mirror_set(5, 2)}


def ways(method: str) -> set[str]:
    """Return the label of every setting of a method."""
    return {Way(method, with_defaults(method, each)).label for each in settings_of(method, ACCURACY_SETTINGS)}


@pytest.mark.parametrize("domain", ["film", "mirror"])
def test_every_registered_method_is_measured_with_all_its_settings(domain: Domain) -> None:
    subject = SUBJECTS[domain]
    entries = list(method_entries(subject, true_colours(subject)))
    measured = {(entry.way, entry.backend) for entry in entries}
    wanted = {
        (way, backend)
        for name in method_names(domain)
        for backend in METHODS[name].backends
        if backend != "numba" or has_numba()
        for way in ways(name)
    }
    assert measured == wanted


@pytest.mark.parametrize("workload", ACCURACY_SETS)
def test_every_registered_method_has_a_price_on_each_of_its_devices(workload: str) -> None:
    domain: Domain = "mirror" if workload.startswith("mirrors") else "film"
    missing = []
    for name in method_names(domain):
        devices: list[Device] = list(METHODS[name].backends)
        if METHODS[name].glsl_function:
            devices.append("glsl")
        for device in devices:
            for way in ways(name):
                price = shipped_costs().ns_per_colour(device, workload, way)
                if price is None or not price > 0.0:
                    missing.append((device, way))
    assert missing == [], "measure the map anew: make map"


def test_tables_textures_and_no_film_have_a_price() -> None:
    for workload in ("films", "metals", "thick"):
        for device in ("numpy", "numba", "glsl"):
            for axes in (1, 2, 3, 4):
                assert shipped_costs().ns_of(device, workload, f"table of {axes} axes") > 0.0
            assert shipped_costs().ns_of(device, workload, NO_FILM) == 0.0
        assert shipped_costs().ns_of("glsl", workload, "texture") > 0.0


def test_finer_tables_err_less_and_their_filling_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accuracy_tables, "_ALONG_COSINES", (16, 64))
    monkeypatch.setattr(accuracy_tables, "_POINTS", 40)
    film = film_set(2)
    parts = point_parts(film, "dielectric", 2)
    tables = list(accuracy_tables.film_tables(parts))
    assert [each.label for each in tables] == [
        "table: cos_theta 16, RGBA16F",
        "table: cos_theta 16, RGBA32F",
        "table: cos_theta 64, RGBA16F",
        "table: cos_theta 64, RGBA32F",
    ]
    coarse, fine = (next(table_entries(tables[k])).errors for k in (1, 3))
    assert coarse is not None
    assert fine is not None
    assert fine.delta_e_p95 < 0.2 * coarse.delta_e_p95
    assert all(each.filling_ns is not None and each.filling_ns > 0.0 for each in tables)


def test_tables_in_opengl_give_what_python_looks_up(
    gl_context: moderngl.Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(accuracy_tables, "_ALONG_MORE", ((16, 16, 8),))
    monkeypatch.setattr(accuracy_tables, "_POINTS", 40)
    metals = accuracy_tables.set_parts("metals", metal_set(24))
    for parts in metals[1:]:
        tables = list(accuracy_tables.film_tables(parts[:1]))[-1]
        row = accuracy_glsl._table_row(gl_context, "metals", tables)
        python = tables.errors(tables.colours("numpy"))
        assert row.errors is not None
        assert python is not None
        # The bound of a graphics card, which filters with weights of eight bits; software does better.
        assert row.errors.max_abs == pytest.approx(python.max_abs, abs=0.005)


def test_thick_films_are_the_films_stretched() -> None:
    thin, thick = film_set(), thick_set()
    share = (thin.thickness_nm - 100.0) / 700.0
    np.testing.assert_allclose(thick.thickness_nm, THICK_NM.low + share * 9000.0)
    np.testing.assert_array_equal(thin.film_ior, thick.film_ior)


def test_metals_have_coloured_bases_and_shorter_sets_begin_longer_ones() -> None:
    few, many = metal_set(3), metal_set(9)
    np.testing.assert_array_equal(few.base.f0, many.base.f0[:3])
    assert np.ptp(few.base.f0, axis=-1).min() > 0.0


def test_undefined_colours_are_counted_and_not_averaged() -> None:
    truth = np.full((3, 3), 0.5)
    rgb = np.array([[0.5] * 3, [np.nan] * 3, [0.6] * 3])
    errors = errors_of(rgb, truth)
    assert errors.undefined == 1
    assert errors.max_abs == pytest.approx(0.1)
    assert np.isnan(errors_of(np.full((2, 3), np.nan), truth[:2]).delta_e_p95)
