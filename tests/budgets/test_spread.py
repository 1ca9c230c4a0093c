"""A thickness that varies within a pixel counts among the errors of ways that do not average over it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gltf_iri.budgets.candidates import direct_candidates
from gltf_iri.budgets.errors import FilmErrors
from gltf_iri.planning.costs import shipped_costs
from gltf_iri.planning.reach import Reach, Span
from gltf_iri.planning.way import AVERAGED

GLASS = (Span.at(0.06),) * 3
SMOOTH = Reach(
    film_ior=1.5,
    factor=Span.at(1.0),
    thickness_nm=Span(300.0, 700.0),
    metallic=Span.at(0.0),
    roughness=Span.at(0.0),
    base_color=GLASS,
    dielectric_f0=GLASS,
    is_dielectric_grey=True,
)
FINE = replace(SMOOTH, spread_nm=Span(80.0, 200.0))


def errors(reach: Reach, *, has_spread: bool = True) -> FilmErrors:
    return FilmErrors(reach, has_image_light=False, has_spread=has_spread)


def test_what_cannot_average_errs_by_the_spread() -> None:
    sharp = errors(SMOOTH).of_method("spectral", {}, np.inf).delta_e
    fine = errors(FINE).of_method("spectral", {}, np.inf).delta_e
    assert sharp == 0.0
    assert fine > 3.0
    assert errors(FINE, has_spread=False).of_method("spectral", {}, np.inf).delta_e == 0.0


def test_what_averages_errs_as_without_a_spread() -> None:
    parameters = {"tolerance": 1e-4}
    sharp = errors(SMOOTH).of_method("fourier", parameters, np.inf)
    assert errors(FINE).of_method("fourier", parameters, np.inf) == sharp


def test_averaging_has_its_own_price() -> None:
    costs = shipped_costs()
    averaging = direct_candidates("film", "glsl", ["films"], has_spread=True)
    assert any(each.method == "fourier" for each in averaging)
    for each in averaging:
        label = each.label + AVERAGED if each.method == "fourier" else each.label
        assert each.ns_per_colour == costs.ns_of("glsl", "films", label)
