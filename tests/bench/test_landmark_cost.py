"""What landmarks cost is told apart: constants, search, evaluation."""

from __future__ import annotations

import pytest

from gltf_iri.backends import has_numba
from gltf_iri.bench.landmark_cost import landmark_cost


@pytest.mark.skipif(not has_numba(), reason="numba is not installed")
def test_subdivision_costs_reflectances_and_the_root_finder_none() -> None:
    plain = landmark_cost("newton-2", 1, count=300, rounds=1)
    finer = landmark_cost("newton-2", 3, count=300, rounds=1)
    halved = landmark_cost("bisect-10", 3, count=300, rounds=1)
    assert finer.reflectances > 1.1 * plain.reflectances
    assert halved.reflectances == pytest.approx(finer.reflectances, rel=0.01)
    for cost in (plain, finer, halved):
        assert min(cost.constants_ns, cost.search_ns) > 0.0
