"""`bloch` is near the truth on every set of mirrors, and keeps the laws that a mirror's colour keeps."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.backends import has_numba
from gltf_iri.bench.mirror_set import LOW_CONTRAST_CELLS, MIRROR_CELLS, low_contrast_set, mirror_set
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.spaces import rec709_to_xyz
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate

COUNT = 100  # of the sets' 300: their first third
SETS = {
    **{f"{n} cells": mirror_set(n, COUNT) for n in MIRROR_CELLS},
    **{f"low contrast, {n} cells": low_contrast_set(n, COUNT) for n in LOW_CONTRAST_CELLS},
}


def bloch(mirror: Mirror, **parameters: float) -> NDArray[np.float64]:
    return evaluate("bloch", mirror, backend="numpy", parameters=parameters).rgb


@pytest.mark.parametrize("name", SETS)
def test_colours_are_near_the_truth(name: str) -> None:
    truth = evaluate("yeh-spectral", SETS[name], backend="numpy").rgb
    # Measured on all 300: 0.045-0.081 / 0.11-0.21, with 16 samples 0.020-0.039 / 0.05-0.09.
    for samples, mean, p95 in ((12, 0.1, 0.25), (16, 0.05, 0.2), (32, 0.025, 0.08)):
        delta_e = delta_e_2000(bloch(SETS[name], samples=samples), truth)
        assert delta_e.mean() <= mean
        assert np.percentile(delta_e, 95) <= p95
        assert delta_e.max() <= 0.5


def test_one_cell_is_a_slab() -> None:
    g = np.random.default_rng(11)
    cosine, index, nm = g.uniform(0.1, 1.0, 200), g.uniform(1.2, 2.5, 200), g.uniform(0.0, 800.0, 200)
    # n1 = 1 before and behind: only the second film of a single cell is seen.
    slab = evaluate("spectral", Film.of(cosine, nm, index, base_from_ior(1.0))).rgb
    one = bloch(Mirror.of(cosine, 1.0, index, g.uniform(0.0, 500.0, 200), nm, 1), samples=32)
    assert delta_e_2000(one, slab).max() <= 0.3


def test_host_of_the_first_index_is_no_host() -> None:
    drawn = mirror_set(20, 50)
    with_host = Mirror.of(drawn.cos_theta_h, 1.2, drawn.n2, drawn.d1_nm, drawn.d2_nm, 20, 1.2)
    without = Mirror.of(drawn.cos_theta_h, 1.2, drawn.n2, drawn.d1_nm, drawn.d2_nm, 20)
    assert np.array_equal(bloch(with_host), bloch(without))


def test_equal_films_reflect_what_the_host_does() -> None:
    cosine = np.linspace(0.05, 1.0, 9)
    none = bloch(Mirror.of(cosine, 1.4, 1.4, 200.0, 300.0, 50))
    assert np.abs(none).max() <= 1e-12
    surface = evaluate("spectral", Film.of(cosine, 0.0, 1.4, base_from_ior(1.4))).rgb
    assert np.abs(bloch(Mirror.of(cosine, 1.4, 1.4, 200.0, 300.0, 50, 1.0)) - surface).max() <= 1e-9


def test_brewsters_angle_closes_all_gaps() -> None:
    # tan θ = n2/n1: no p light is reflected, so that at most half of all light is.
    cosine = 1.0 / np.sqrt(1.0 + 1.5**2)
    near = [cosine * (1.0 + offset) for offset in (-1e-9, 0.0, 1e-9)]
    rgb = bloch(Mirror.of(near, 1.0, 1.5, 200.0, 150.0, 1000))
    assert 0.3 <= rec709_to_xyz(rgb)[1, 1] <= 0.5
    assert np.abs(rgb - rgb[1]).max() <= 1e-6


def test_many_cells_are_like_ever_more() -> None:
    truth = evaluate("yeh-spectral", mirror_set(200, 50)).rgb
    for cells in (10**3, 10**6):
        assert delta_e_2000(bloch(mirror_set(cells, 50), samples=32), truth).max() <= 0.3


def test_thick_cells_stay_near_the_truth() -> None:
    g = np.random.default_rng(3)
    period_nm, share = 10.0 ** g.uniform(3.0, 4.0, 60), g.uniform(0.1, 0.9, 60)
    cosine, n2 = g.uniform(0.3, 1.0, 60), g.uniform(1.3, 2.2, 60)
    mirror = Mirror.of(cosine, 1.0, n2, share * period_nm, (1.0 - share) * period_nm, 3)
    delta_e = delta_e_2000(bloch(mirror), evaluate("yeh-spectral", mirror).rgb)
    assert np.percentile(delta_e, 95) <= 0.7


def hard_mirrors() -> Mirror:
    rows = [
        (c, n1, n2, d1, d2, cells, host)
        for c, n1, n2, d1, d2, cells, host in itertools.product(
            (0.0, 1e-8, 0.03, 1.0),
            (1.0, 1.5),
            (1.0, 1.5, 2.5),
            (0.0, 1e-6, 300.0, 1e6),
            (0.0, 200.0, 1e6),
            (1, 10, 10**3, 10**6),
            (1.0, 1.3),
        )
        if host * host * (1.0 - c * c) < n2 * n2
    ]
    cosine, n1, n2, d1, d2, cells, host = np.array(rows).T
    return Mirror.of(cosine, n1, n2, d1, d2, cells, host)


def test_hard_cases_have_colours_of_reflectances() -> None:
    rgb = bloch(hard_mirrors())
    assert np.isfinite(rgb).all()
    # Reflectances in [0, 1] have colours in [−0.1, 1.35] under Rec.709.
    assert rgb.min() >= -0.1
    assert rgb.max() <= 1.35


def test_light_along_the_films_is_all_reflected() -> None:
    rgb = bloch(Mirror.of([0.0, 1e-12], 1.0, 1.5, 100.0, 100.0, [[1], [10**6]]))
    assert np.abs(rgb - 1.0).max() <= 1e-9


def test_total_reflection_at_the_first_film_is_white() -> None:
    assert np.abs(bloch(Mirror.of(0.2, 1.0, 1.8, 100.0, 100.0, 10, 1.5)) - 1.0).max() <= 1e-14


def test_what_bloch_cannot_do_is_refused() -> None:
    with pytest.raises(UsageError, match="yeh-spectral"):
        bloch(Mirror.of(0.5, 1.0, 1.5 + 0.1j, 100.0, 100.0, 10))
    with pytest.raises(UsageError, match="yeh-spectral"):
        bloch(Mirror.of(0.2, 1.5, 1.2, 100.0, 100.0, 10))
    with pytest.raises(UsageError, match="samples"):
        bloch(Mirror.of(0.2, 1.0, 1.2, 100.0, 100.0, 10), samples=4)


def test_arrays_broadcast() -> None:
    rgb = bloch(Mirror.of(np.linspace(0.2, 1.0, 4)[:, None], 1.0, 1.5, [100.0, 200.0, 300.0], 150.0, 10))
    assert rgb.shape == (4, 3, 3)
    assert np.abs(rgb[0, 1] - bloch(Mirror.of(0.2, 1.0, 1.5, 200.0, 150.0, 10))).max() <= 1e-12
    assert bloch(Mirror.of(np.zeros(0), 1.0, 1.5, 200.0, 150.0, 10)).shape == (0, 3)


@pytest.mark.skipif(not has_numba(), reason="compiled loops need numba")
def test_compiled_loops_give_the_same_colours() -> None:
    g = np.random.default_rng(5)
    cells = np.array([1, 2, 5, 17, 200, 10**6])[:, None]
    thick = 10.0 ** g.uniform(2.0, 4.5, 70)
    # `mirror_set` without a host, low contrast under one, and cells whose gaps are looked for by finer steps.
    for mirror in (
        mirror_set(20),
        low_contrast_set(8),
        Mirror.of(g.uniform(0.1, 1.0, 70), 1.3, g.uniform(1.4, 2.2, 70), thick, 0.7 * thick, cells, 1.0),
    ):
        compiled = evaluate("bloch", mirror, backend="numba").rgb
        assert np.abs(compiled - bloch(mirror)).max() <= 1e-13
