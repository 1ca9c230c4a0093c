"""Simulated paths through layers: Eq. 34 where each reflects once, and the laws of light where they go on."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from layers_three_wavelengths import ROUGH, STACKS, A, ThreeWavelengths, binned_model, sidak_z
from numpy.testing import assert_allclose

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.errors import UsageError
from gltf_iri.evaluation import layers
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.layer_stack import coating_transmittance
from gltf_iri.optics.microfacet import d_ggx, v_smith_ggx_correlated
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.reference import layers_mc, layers_walk
from gltf_iri.reference.layers_mc import LayersEstimate, simulate, simulate_brdf
from gltf_iri.reference.layers_tally import Bins, Sampled

WAVELENGTH_NM = np.array([450.0, 550.0, 640.0])
BINS = Bins(6, 4)
# Angles of the light, one a stack: from straight on to low.
COSINES = dict(zip(STACKS, (0.7, 0.95, 0.6, 0.3, 0.25), strict=True))

# Fewer paths than this in a bin are not normally distributed enough for |z| of 4.5.
HITS_MIN = 300


@cache
def single_reflections(name: str) -> LayersEstimate:
    rng = np.random.default_rng([20, list(STACKS).index(name)])
    return simulate(
        *(STACKS[name], COSINES[name]),
        **{"paths": 240_000, "rng": rng, "wavelength_nm": WAVELENGTH_NM, "bins": BINS},
        **{"transmission": "facets", "spectrum": "single", "max_reflections": 1},
    )


def scores(passage: float = 1.0) -> np.ndarray:
    """Return z of every (stack, bin, wavelength) that is hit often enough, and of each albedo."""
    found = []
    for name, stack in STACKS.items():
        estimate = single_reflections(name)
        model = binned_model(stack, COSINES[name], WAVELENGTH_NM, BINS, passage=passage)
        mean, error = estimate.values.mean, estimate.values.error
        often = mean > error * np.sqrt(HITS_MIN)
        found.append(((mean - model) / np.where(often, error, 1.0))[often])
        albedo = estimate.balance["reflected"]
        found.append((albedo.mean - model.sum(axis=(0, 1))) / albedo.error)
    return np.concatenate(found)


def test_paths_that_reflect_once_are_the_single_reflection_model() -> None:
    z = scores()
    assert len(z) > 250
    assert np.abs(z).max() < sidak_z(len(z))


def test_one_percent_in_transmission_is_seen() -> None:
    z = scores(passage=1.01)
    assert np.abs(z).max() > 1.3 * sidak_z(len(z))


def test_another_masking_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    def correlated(sine_squared: np.ndarray, i: np.ndarray, o: np.ndarray, alpha: np.ndarray) -> np.ndarray:
        return d_ggx(sine_squared, alpha) * v_smith_ggx_correlated(i, o, alpha)

    monkeypatch.setattr(layers, "facet_weight", correlated)
    z = scores()
    assert np.abs(z).max() > 1.3 * sidak_z(len(z))


VIEWERS = Pose.of(0.7, [0.9, 0.7, 0.3, 0.6], [-1.0, -0.9, 0.5, -1.0])


def assert_same(found: list[Sampled]) -> None:
    """Assert that independent estimates of one array agree, each pair of neighbours, family-wise."""
    z = np.stack([(a.mean - b.mean) / np.hypot(a.error, b.error) for a, b in pairwise(found)])
    assert np.abs(z).max() < sidak_z(z.size)


@pytest.mark.parametrize("name", ["A under a coating on grey", "beetle on white"])
def test_all_ways_of_simulating_agree(name: str) -> None:
    rng = np.random.default_rng(3)
    ways = [(t, s) for t in ("table", "facets") for s in ("multiplexed", "single")]
    found = [
        simulate_brdf(
            *(STACKS[name], VIEWERS),
            **{"paths": 12_000, "rng": rng, "wavelength_nm": WAVELENGTH_NM},
            **{"transmission": transmission, "spectrum": spectrum},
        )
        for transmission, spectrum in ways
    ]
    assert_same([each.values for each in found])
    assert_same([each.balance["reflected"] for each in found])


def test_estimates_at_viewers_and_in_bins_agree() -> None:
    stack = STACKS["A under a coating on grey"]
    nodes, weights = gauss_unit(10)
    cosine, turn = np.broadcast_arrays((0.5 + nodes / 6.0)[:, None], np.pi * (0.25 * nodes))
    pose = Pose.of(0.6, cosine.ravel(), np.cos(turn.ravel()))
    options = {"rng": np.random.default_rng(9), "wavelength_nm": 550.0}
    viewers = simulate_brdf(stack, pose, paths=6_000, **options).values
    areas = 2.0 * np.pi / 24.0 * (cosine * weights[:, None] * weights).ravel()
    # All viewers see the same paths: their errors add up.
    sent = Sampled(areas @ viewers.mean, areas @ viewers.error)
    bins = simulate(stack, 0.6, paths=200_000, bins=BINS, **options).values
    assert_same([sent, Sampled(bins.mean[3, 0], bins.error[3, 0])])


def test_colours_are_those_of_the_truth() -> None:
    stack = LayerStack.of(
        (BraggLayer.of(1.0, 1.5, 90.0, 80.0, 2, 0.2),),
        base=LayerBase.of([0.6, 0.3, 0.1], [0.9, 0.6, 0.2], 0.3, 0.4),
    )
    pose = Pose.of(0.7, [0.7, 0.3], [-0.9, 0.5])
    rule = colour_rule(32, "D65")
    found = simulate_brdf(
        *(stack, pose),
        **{"paths": 6_000, "rng": np.random.default_rng(4), "max_reflections": 1},
        **{"wavelength_nm": rule.wavelength_nm, "weights": rule.weights},
    ).values
    truth = brdf(stack, pose, LayersSingle(stack, "D65"))
    assert np.abs((found.mean - truth) / found.error).max() < sidak_z(truth.size)
    # Enough to tell a rule of 32 degrees from the truth, were it not enough.
    assert np.all(found.error < 0.016 * truth)


def test_light_and_viewer_may_change_places() -> None:
    # Smoother layers throw a few paths at the viewer with great weight: too few for a test of normal errors.
    under = BraggLayer.of(1.0, 1.4, 220.0, 230.0, 4, 0.3)
    stack = LayerStack.of((ROUGH, under), base=LayerBase.of(0.8))
    rng = np.random.default_rng(6)
    options = {"paths": 60_000, "rng": rng, "wavelength_nm": WAVELENGTH_NM, "transmission": "facets"}
    there = simulate_brdf(stack, Pose.of(0.9, 0.35, 0.3), **options).values
    back = simulate_brdf(stack, Pose.of(0.35, 0.9, 0.3), **options).values
    assert_same([there, back])
    # Both are more than the single reflections, which are reciprocal by their formula.
    single = brdf(stack, Pose.of(0.35, 0.9, 0.3), ThreeWavelengths(stack, WAVELENGTH_NM))
    assert np.all(there.mean[0] > single + 4.0 * there.error[0])


def total(estimate: LayersEstimate) -> np.ndarray:
    return np.sum([part.mean for part in estimate.balance.values()], axis=0)


@pytest.mark.parametrize("name", STACKS)
def test_no_power_is_made_or_lost(name: str) -> None:
    # Drawn facets and one wavelength: every path keeps its power to the last digit.
    assert_allclose(total(single_reflections(name)), 1.0, atol=1e-10)
    full = simulate(
        *(STACKS[name], 0.5),
        **{"paths": 30_000, "rng": np.random.default_rng(7), "wavelength_nm": [550.0]},
    )
    error = np.sqrt(np.sum([part.error**2 for part in full.balance.values()], axis=0))
    assert np.all(np.abs(total(full) - 1.0) < 5.0 * error)
    assert full.balance["cut"].mean == full.balance["lost"].mean == 0.0


def test_more_reflections_only_add() -> None:
    stack = STACKS["A under a coating on grey"]
    options = {"paths": 40_000, "wavelength_nm": 550.0}
    albedos = [
        simulate(stack, 0.7, rng=np.random.default_rng(8), max_reflections=most, **options).balance[
            "reflected"
        ]
        for most in (1, 2, None)
    ]
    for fewer, more in pairwise(albedos):
        assert more.mean > fewer.mean + 4.0 * np.hypot(more.error, fewer.error)


def test_one_layer_on_black_reflects_but_once() -> None:
    stack = LayerStack.of((A,))
    options = {"paths": 5_000, "wavelength_nm": WAVELENGTH_NM}
    once, all_of_them = (
        simulate(stack, 0.7, rng=np.random.default_rng(8), max_reflections=most, **options)
        for most in (1, None)
    )
    assert np.array_equal(once.values.mean, all_of_them.values.mean)


def test_smooth_layers_mirror_and_pass_what_their_reflectance_says() -> None:
    stack = LayerStack.of((BraggLayer.of(1.0, 1.5, 250.0, 250.0, 10),))
    found = simulate(
        *(stack, 0.7),
        **{"paths": 40_000, "rng": np.random.default_rng(2), "wavelength_nm": [465.0], "bins": Bins(4, 2)},
    )
    mirrored = bragg_reflectance(1.0, 1.0, 1.5, 250.0, 250.0, 10, np.array([465.0]), 0.7)
    assert 0.4 < mirrored < 0.6
    assert found.balance["masked"].mean == 0.0
    assert abs(found.balance["base"].mean - (1.0 - mirrored)) < 4.0 * found.balance["base"].error
    assert found.values.mean[2, 1] == found.balance["reflected"].mean > 0.0
    assert np.count_nonzero(found.values.mean) == 1


def test_light_trapped_under_a_coating_is_the_closed_sum() -> None:
    # No layers: ρ T(i) (1 − r)/(1 − ρ r), r what the coating mirrors inside of even light (Saunderson 1942).
    ior, rho = 1.6, 0.8
    cosine, weights = gauss_unit(200)
    inside = 1.0 - np.sum(2.0 * cosine * coating_transmittance(ior, cosine) * weights) / ior**2
    expected = rho * coating_transmittance(ior, 0.6) * (1.0 - inside) / (1.0 - rho * inside)
    stack = LayerStack.of((), ior, LayerBase.of(rho))
    found = simulate(stack, 0.6, paths=100_000, rng=np.random.default_rng(5), wavelength_nm=[550.0])
    reflected = found.balance["reflected"]
    assert abs(reflected.mean - expected) < 4.0 * reflected.error < 0.02
    assert_allclose(found.balance["mirrored"].mean, 1.0 - coating_transmittance(ior, 0.6))


def test_blocks_of_paths_are_one_simulation(monkeypatch: pytest.MonkeyPatch) -> None:
    options = {"paths": 5_001, "wavelength_nm": [550.0]}
    whole = simulate(STACKS["beetle on white"], 0.5, rng=np.random.default_rng(1), **options)
    monkeypatch.setattr(layers_mc, "_VALUES_AT_ONCE", 400)
    parts = simulate(STACKS["beetle on white"], 0.5, rng=np.random.default_rng(2), **options)
    assert parts.paths == whole.paths == 5_001
    assert_same([whole.balance["reflected"], parts.balance["reflected"]])
    # A block's error would be √13 times as large.
    assert_allclose(parts.balance["reflected"].error, whole.balance["reflected"].error, rtol=0.1)


def test_paths_that_are_given_up_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(layers_walk, "_STEPS_MAX", 1)
    options = {"paths": 2_000, "wavelength_nm": [550.0], "transmission": "facets", "spectrum": "single"}
    found = simulate(STACKS["A on grey"], 0.5, rng=np.random.default_rng(1), **options)
    assert found.balance["lost"].mean > 0.1
    assert_allclose(total(found), 1.0, atol=1e-10)


def test_seeds_decide() -> None:
    options = {"paths": 2_000, "wavelength_nm": WAVELENGTH_NM}
    first, same, other = (
        simulate(STACKS["A on grey"], 0.5, rng=np.random.default_rng(seed), **options).values.mean
        for seed in (1, 1, 2)
    )
    assert np.array_equal(first, same)
    assert not np.array_equal(first, other)


def test_what_cannot_be_simulated_is_said() -> None:
    options = {"paths": 10, "rng": np.random.default_rng(1), "wavelength_nm": WAVELENGTH_NM}
    coloured = LayerStack.of((A,), base=LayerBase.of([0.1, 0.2, 0.3]))
    with pytest.raises(UsageError, match="coloured base"):
        simulate(coloured, 0.5, **options)
    with pytest.raises(UsageError, match="One stack"):
        simulate(LayerStack.of((BraggLayer.of(1.0, 1.5, [1.0, 2.0], 3.0, 4),)), 0.5, **options)
    with pytest.raises(UsageError, match="One light"):
        simulate_brdf(LayerStack.of((A,)), Pose.of([0.5, 0.6], 0.5), **options)
    with pytest.raises(UsageError, match="at least one path"):
        simulate(LayerStack.of((A,)), 0.5, **{**options, "paths": 0})
    with pytest.raises(UsageError, match="shape"):
        simulate(LayerStack.of((A,)), 0.5, weights=np.ones((2, 3)), **options)
