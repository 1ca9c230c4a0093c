"""The workloads are what they say, peers are judged fairly, and the fastest correct one is correct."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gltf_iri.bench import optics
from gltf_iri.bench.fifty_digits import stack_50_digits
from gltf_iri.bench.optics import OpticsRow, load_peers, measure_optics
from gltf_iri.bench.ours import OURS
from gltf_iri.bench.peers import PEERS, Peer, silent_peers
from gltf_iri.bench.plot import plot_optics
from gltf_iri.bench.workloads import WORKLOADS, Workload, error_max_abs
from gltf_iri.errors import MissingCapabilityError

# Peers lose digits towards grazing light and at the edges of 200 cells' band; wrong ones are off by 1e-2.
PEER_MAX_ABS = 1e-9
OWN_MAX_ABS = 1e-11

# colour takes the real part of each index before Snell's law: absorption at an angle, and total reflection
# inside, are beyond it.
BEYOND = {("colour", name) for name in ("W2", "lossy-film", "lossy-cells", "tir-film", "tir-cells")}

SHAPES = {
    "W1": (1, 91, 471),
    "W2": (1, 91, 471),
    "W3": (1, 91, 471),
    "W4": (1, 91, 471),
    "W5": (10_000, 1, 81),
}


def small(name: str) -> Workload:
    return WORKLOADS[name].thinned(2, 3, 2)


def test_the_grids_are_those_that_were_agreed_on() -> None:
    assert {name: WORKLOADS[name].shape for name in SHAPES} == SHAPES
    w1, w5 = WORKLOADS["W1"], WORKLOADS["W5"]
    assert (w1.wavelength_nm[0], w1.wavelength_nm[-1], w1.angle_deg[-1]) == (360.0, 830.0, 89.0)
    assert (w5.wavelength_nm[0], w5.wavelength_nm[-1], w5.angle_deg[0]) == (380.0, 780.0, 30.0)
    g = np.random.default_rng(0)
    assert np.array_equal(w5.cell_index[:, 1].real, g.uniform(1.3, 2.5, 10_000))
    assert np.array_equal(w5.cell_nm[:, 0], g.uniform(100, 500, 10_000))
    assert np.array_equal(w5.cell_nm[:, 1], g.uniform(100, 500, 10_000))


@pytest.mark.parametrize("name", WORKLOADS)
def test_the_truth_is_that_of_the_layers_written_out(name: str) -> None:
    workload = WORKLOADS[name].thinned(1, 2, 1)
    indices, thicknesses_nm = workload.layers(0)
    powers = stack_50_digits(
        indices.tolist(), thicknesses_nm.tolist(), workload.wavelength_nm[0], workload.cos_theta[-1]
    )
    assert abs(workload.truth()[0, -1, 0] - powers.reflected) < 1e-30


def test_a_thinned_grid_keeps_its_ends() -> None:
    thinned = WORKLOADS["W5"].thinned(5, 9, 3)
    assert thinned.shape == (5, 1, 3)
    assert thinned.wavelength_nm.tolist() == [380.0, 580.0, 780.0]
    assert thinned.cell_nm[-1, 0] == WORKLOADS["W5"].cell_nm[-1, 0]


@pytest.mark.parametrize("name", WORKLOADS)
@pytest.mark.parametrize("peer", PEERS, ids=lambda peer: peer.name)
def test_peers_that_are_installed_agree_with_50_digits(peer: Peer, name: str) -> None:
    if not peer.version:
        pytest.skip(f"{peer.package} is not installed: pip install 'gltf-iri[peers]'")
    with silent_peers():
        error = error_max_abs(peer.prepare(peer.load(), small(name))(), small(name).truth())
    if (peer.name, name) in BEYOND:
        assert not error < PEER_MAX_ABS
    else:
        assert error < PEER_MAX_ABS


@pytest.mark.parametrize("name", WORKLOADS)
def test_own_functions_agree_with_50_digits(name: str) -> None:
    workload = small(name)
    fitting = [own for own in OURS if own.fits(workload)]
    assert fitting
    for own in fitting:
        for backend in own.backends:
            assert error_max_abs(own.prepare(workload, backend)(), workload.truth()) < OWN_MAX_ABS


def test_an_answer_with_nan_is_not_correct() -> None:
    truth = small("W1").truth()
    values = truth.astype(np.float64)
    assert error_max_abs(values, truth) < 1e-15
    values[0, 1, 1] = np.nan
    assert np.isnan(error_max_abs(values, truth))
    assert not OpticsRow("W1", "x", "peer", "", 1.0, np.nan, 1).is_correct


def fake_peer(name: str, prepare: Any) -> Peer:
    return Peer(name, name, name, prepare, PEERS[0].grids)


def test_the_fastest_correct_peer_is_neither_wrong_nor_broken(monkeypatch: pytest.MonkeyPatch) -> None:
    def right_but_slow(_: Any, workload: Workload) -> Any:
        return lambda: sum(1.0 for _ in range(10_000)) * 0.0 + workload.truth().astype(np.float64)

    def wrong(_: Any, workload: Workload) -> Any:
        return lambda: np.zeros(workload.shape)

    def broken(_: Any, workload: Workload) -> Any:
        raise ValueError("no such layer\nand more")

    fakes = {"right": right_but_slow, "wrong": wrong, "broken": broken}
    monkeypatch.setattr(optics, "PEERS", tuple(fake_peer(name, prepare) for name, prepare in fakes.items()))
    (rows,) = measure_optics(["W1"], dict.fromkeys(fakes), rounds=1, grid=(1, 2, 2))
    by_name = {row.method: row for row in rows if row.backend == "peer"}
    assert by_name["right"].is_fastest_correct_peer
    assert by_name["right"].speedup == pytest.approx(1.0)
    assert not by_name["wrong"].is_correct
    assert by_name["broken"].remark == "ValueError: no such layer"
    assert by_name["broken"].ns_per_eval is None
    own = [row for row in rows if row.backend == "numpy"]
    assert own
    assert all(row.speedup is not None and row.speedup > 0.0 for row in own)
    assert plot_optics(rows).startswith(b"\x89PNG")


def test_without_peers_there_is_nothing_to_compare_with(monkeypatch: pytest.MonkeyPatch) -> None:
    missing = fake_peer("no_such_library", lambda *_: None)
    monkeypatch.setattr(optics, "PEERS", (missing, *(peer for peer in PEERS if peer.name == "colour")))
    with pytest.raises(MissingCapabilityError, match=r"pip install 'gltf-iri\[peers\]'"):
        load_peers()


def test_a_peer_that_cannot_be_loaded_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    missing = fake_peer("no_such_library", lambda *_: None)
    monkeypatch.setattr(optics, "PEERS", (missing, *(peer for peer in PEERS if peer.name == "tmm")))
    libraries, skipped = load_peers()
    assert set(libraries) == {"tmm"}
    assert "no_such_library" in skipped["no_such_library"]
