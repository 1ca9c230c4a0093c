"""A mirror of one cell in its own n1 has the colour of the film that it is."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.mirror import film_in_mirror

COUNT = 200


def single_cells():
    """Return cosines, n1, n2, d1, d2 of random cells, total reflection inside among them."""
    g = np.random.default_rng(5)
    n1, n2 = g.uniform(1.0, 2.2, (2, COUNT))
    d1_nm, d2_nm = g.uniform(0.0, 900.0, (2, COUNT))
    return g.uniform(0.0, 1.0, COUNT), n1, n2, d1_nm, d2_nm


def as_film(cosine, n1, n2, d2_nm):
    found = film_in_mirror(n1, n2, d2_nm, 1)
    base = base_from_ior(found.base_ior)
    return Film.of(cosine, found.thickness_nm, found.film_ior, base, found.outside_ior)


def test_the_film_has_the_mirrors_colour():
    cosine, n1, n2, d1_nm, d2_nm = single_cells()
    mirror = evaluate("yeh-spectral", Mirror.of(cosine, n1, n2, d1_nm, d2_nm, 1))
    film = evaluate("spectral", as_film(cosine, n1, n2, d2_nm))
    np.testing.assert_allclose(film.rgb, mirror.rgb, rtol=0, atol=1e-12)


@pytest.mark.parametrize("case", [{"cells": 2}, {"host_ior": 1.0}, {"n2": 1.5 + 0.1j}, {"n1": 2.0 + 1e-9j}])
def test_no_other_mirror_is_a_film(case):
    given = {"n1": 1.5, "n2": 2.0, "d2_nm": 100.0, "cells": 1, "host_ior": 1.5} | case
    assert film_in_mirror(**given) is None


def test_one_other_mirror_among_many_is_enough():
    assert film_in_mirror(1.5, 2.0, 100.0, [1, 1, 1]) is not None
    assert film_in_mirror(1.5, 2.0, 100.0, [1, 2, 1]) is None
    assert film_in_mirror([1.5, 1.6], 2.0, 100.0, 1, [1.5, 1.6]) is not None
    assert film_in_mirror([1.5, 1.6], 2.0, 100.0, 1, 1.5) is None
