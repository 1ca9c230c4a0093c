"""Budgets of films and mirrors that are given one by one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import gltf_iri
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.planning.method import method_names

FILMS: dict[str, Any] = {
    "cos_theta_1": np.linspace(0.02, 1.0, 30)[:, None],
    "thickness_nm": np.linspace(100.0, 700.0, 20),
    "base_ior": 1.6,
}
MIRRORS: dict[str, Any] = {
    "cos_theta_1": np.linspace(0.1, 1.0, 40),
    "bragg": (1.56, 1.68, 95.0, 90.0, 20),
    "host_ior": 1.0,
}


@pytest.mark.parametrize("subject", [FILMS, MIRRORS])
def test_the_p95_of_all_colours_keeps_the_budget(subject: dict[str, Any]) -> None:
    truth = gltf_iri.evaluate(budget=0.0, **subject)
    assert truth.delta_e == 0.0
    errors = []
    for budget in (5.0, 0.5, 0.05, 0.005):
        found = gltf_iri.evaluate(budget=budget, **subject)
        p95 = np.percentile(delta_e_2000(found.rgb, truth.rgb), 95)
        assert found.delta_e is not None
        assert p95 <= found.delta_e <= budget
        errors.append(found.delta_e)
    assert errors == sorted(errors, reverse=True)


def test_a_budget_stands_alone() -> None:
    also: dict[str, Any]
    for also in ({"method": "khr"}, {"parameters": {"tolerance": 1e-3}}):
        with pytest.raises(UsageError, match="give it alone"):
            gltf_iri.evaluate(budget=1.0, **FILMS, **also)
    with pytest.raises(UsageError, match="not nan"):
        gltf_iri.evaluate(budget=float("nan"), **FILMS)


def test_cells_that_absorb_are_left_to_the_truth() -> None:
    found = gltf_iri.evaluate(budget=0.5, cos_theta_1=[0.5, 1.0], bragg=(1.0, 1.5 + 0.01j, 90.0, 80.0, 10))
    assert found.method in ("yeh-spectral", "yeh-grid")


def test_one_film_and_none_have_an_answer() -> None:
    assert gltf_iri.evaluate(budget=0.5, cos_theta_1=0.5, thickness_nm=300.0).rgb.shape == (3,)
    assert gltf_iri.evaluate(budget=0.5, cos_theta_1=np.zeros(0), thickness_nm=300.0).rgb.shape == (0, 3)


def test_a_mirror_of_one_cell_in_its_own_medium_is_computed_as_the_film_that_it_is() -> None:
    cosine = np.linspace(0.1, 1.0, 20)
    found = gltf_iri.evaluate(budget=0.3, cos_theta_1=cosine, bragg=(1.3, 1.9, 80.0, 250.0, 1))
    assert found.method in method_names("film")
    true = gltf_iri.evaluate("yeh-spectral", cos_theta_1=cosine, bragg=(1.3, 1.9, 80.0, 250.0, 1))
    assert delta_e_2000(found.rgb, true.rgb).max() < 1.0
    cells = gltf_iri.evaluate(budget=0.3, cos_theta_1=cosine, bragg=(1.3, 1.9, 80.0, 250.0, 2))
    assert cells.method in method_names("mirror")
