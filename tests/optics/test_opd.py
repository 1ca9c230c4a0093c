"""Films described by their path difference at normal incidence."""

from __future__ import annotations

import numpy as np

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.opd import film_ior_of_thin, opd_at_normal_nm, thickness_of_opd_nm


def test_thickness_and_path_difference_undo_each_other() -> None:
    film_ior = np.array([1.1, 1.5, 2.4])
    opd_nm = opd_at_normal_nm(film_ior, 300.0)
    assert np.allclose(opd_nm, [660.0, 900.0, 1440.0], rtol=1e-15)
    assert np.allclose(thickness_of_opd_nm(film_ior, opd_nm), 300.0, rtol=1e-15)


def test_a_film_that_vanishes_has_the_outsides_index() -> None:
    ior = film_ior_of_thin(1.2, 1.8, np.array([0.0, 50.0, 100.0, 1000.0]), 100.0)
    assert np.allclose(ior, [1.2, 1.5, 1.8, 1.8], rtol=1e-15)
    dense = film_ior_of_thin(1.0, 2.0, np.linspace(0.0, 120.0, 1201), 100.0)
    assert (np.diff(dense) >= 0.0).all()


def test_with_it_the_cut_series_ends_at_the_bare_base() -> None:
    base = base_from_ior(1.9)
    film_ior = film_ior_of_thin(1.0, 1.5, 0.0, 100.0)
    bare = evaluate("spectral", Film.of(0.6, 0.0, 1.0, base)).rgb
    assert np.abs(evaluate("bb17", Film.of(0.6, 0.0, film_ior, base)).rgb - bare).max() <= 1e-14
