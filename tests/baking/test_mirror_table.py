"""Tables of mirrors hold the truth at their nodes, and approach it between them."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.baking.mirror_table import MirrorTable, bake_mirrors
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate

MIRRORS = Mirror.of(0.5, 1.0, np.array([1.4, 1.7, 2.0]), 120.0, np.array([90.0, 140.0, 200.0]), 8)


def test_a_node_holds_the_truth() -> None:
    baked = bake_mirrors(MirrorTable(5), MIRRORS)
    at_nodes = np.linspace(0.0, 1.0, 5)
    expected = evaluate(
        "yeh-spectral",
        Mirror.of(at_nodes, 1.0, MIRRORS.n2[:, None], 120.0, MIRRORS.d2_nm[:, None], 8),
    ).rgb
    found = baked.look_up(np.broadcast_to(at_nodes, (3, 5)))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-7)


def test_look_ups_are_linear_between_nodes_and_stay_within_the_ends() -> None:
    baked = bake_mirrors(MirrorTable(6, "f2"), MIRRORS)
    cosine = np.random.default_rng(3).uniform(-0.1, 1.1, (3, 40))
    found = baked.look_up(cosine)
    nodes = np.linspace(0.0, 1.0, 6)
    for m in range(3):
        for c in range(3):
            line = np.interp(cosine[m], nodes, baked.texels[m, :, c].astype(np.float64))
            np.testing.assert_allclose(found[m, :, c], line, rtol=0, atol=1e-13)
    assert baked.look_up(np.array([0.2, np.nan, 0.7])).shape == (3, 3)
    assert np.isnan(baked.look_up(np.array([0.2, np.nan, 0.7]))).all(axis=1).tolist() == [False, True, False]


def test_twice_the_nodes_err_a_quarter() -> None:
    cosine = np.random.default_rng(4).uniform(size=(3, 60))
    n2, d2_nm = MIRRORS.n2[:, None], MIRRORS.d2_nm[:, None]
    truth = evaluate("yeh-spectral", Mirror.of(cosine, 1.0, n2, 120.0, d2_nm, 8)).rgb
    baked = [bake_mirrors(MirrorTable(nodes), MIRRORS) for nodes in (101, 201)]
    coarse, fine = (np.median(np.abs(each.look_up(cosine) - truth)) for each in baked)
    assert 3.0 < coarse / fine < 5.0


def test_one_node_is_no_table() -> None:
    with pytest.raises(UsageError, match="two nodes"):
        bake_mirrors(MirrorTable(1), MIRRORS)
