"""Directions drawn for the single-reflection model: in their density, which the model's light goes by."""

from __future__ import annotations

from statistics import NormalDist

import numpy as np
import pytest
from layers_three_wavelengths import ROUGH, ThreeWavelengths, binned_model

from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.reference.layers_facets import StackFacets, passing_chance
from gltf_iri.reference.layers_sampling import LayerSampler
from gltf_iri.reference.layers_tally import Bins

WAVELENGTH_NM = np.array([450.0, 550.0, 640.0])
DRAWN = 60_000
Z_MAX = NormalDist().inv_cdf(1.0 - 1e-4)
# Of few fringes, so that the model is quickly had.
A = BraggLayer.of(1.0, 1.5, 130.0, 110.0, 3, 0.1)
COATED = BraggLayer.of(1.35, 1.6, 130.0, 110.0, 3, 0.1)
SMOOTH = BraggLayer.of(1.0, 1.5, 250.0, 250.0, 10)
UNDER = BraggLayer.of(1.35, 1.6, 120.0, 110.0, 5, 0.3)

CASES = {
    "one layer on black": (LayerStack.of((A,)), 0.6),
    "rough on A on metal and grey": (LayerStack.of((ROUGH, A), 1.0, LayerBase.of(0.2, 0.8, 0.5, 0.3)), 0.4),
    "two layers under a coating on grey": (LayerStack.of((COATED, UNDER), 1.35, LayerBase.of(0.5)), 0.8),
    "low light on rough": (LayerStack.of((ROUGH,), 1.0, LayerBase.of(0.5)), 0.1),
    "low light on a rough coated layer": (LayerStack.of((UNDER,), 1.35), 0.1),
}


def sampler_of(stack: LayerStack) -> LayerSampler:
    return LayerSampler(StackFacets(stack, WAVELENGTH_NM))


def light_of(cosine: float, count: int) -> np.ndarray:
    return np.tile([np.sqrt(1.0 - cosine * cosine), 0.0, cosine], (count, 1))


def binned_density(sampler: LayerSampler, cosine: float, bins: Bins, gauss: int = 16) -> np.ndarray:
    nodes, weights = gauss_unit(gauss)
    height = ((np.arange(bins.cosines)[:, None] + nodes) / bins.cosines)[:, None, :, None]
    turn = ((np.arange(bins.turns)[:, None] + nodes) / bins.turns * np.pi)[None, :, None, :]
    height, turn = np.broadcast_arrays(height, turn)
    sine = np.sqrt(1.0 - height * height)
    view = np.stack([sine * np.cos(turn), sine * np.sin(turn), height], axis=-1).reshape(-1, 3)
    density = sampler.density(light_of(cosine, len(view)), view).reshape(height.shape)
    area = 2.0 * np.pi / (bins.cosines * bins.turns)
    return area * np.einsum("stab,a,b->st", density, weights, weights)


def chi_square_z(counts: np.ndarray, expected: np.ndarray) -> float:
    """χ² as a standard normal (Wilson & Hilferty 1931); rare bins are one."""
    rare = expected < 8.0
    counts, expected = (np.append(x[~rare], x[rare].sum()) for x in (counts, expected))
    kept = expected > 8.0
    degrees = kept.sum() - 1
    chi = np.sum((counts[kept] - expected[kept]) ** 2 / expected[kept]) / degrees
    spread = 2.0 / (9.0 * degrees)
    return float((np.cbrt(chi) - (1.0 - spread)) / np.sqrt(spread))


@pytest.mark.parametrize("name", CASES)
def test_directions_are_drawn_in_their_density(name: str) -> None:
    stack, cosine = CASES[name]
    sampler, bins = sampler_of(stack), Bins(12, 8)
    view, kept = sampler.sample(light_of(cosine, DRAWN), np.random.default_rng(12))
    counts = np.bincount(bins.of(view[kept]), minlength=bins.count)
    share = binned_density(sampler, cosine, bins)
    # What is not kept is a bin of its own: the density's integral is short of 1 by it.
    counts = np.append(counts, np.sum(~kept))
    expected = DRAWN * np.append(share.ravel(), 1.0 - share.sum())
    assert share.sum() <= 1.0 + 1e-5
    assert abs(chi_square_z(counts, expected)) < Z_MAX


def test_chi_square_sees_a_coating_that_bends_nothing() -> None:
    stack, cosine = CASES["two layers under a coating on grey"]
    bins = Bins(12, 8)
    view, kept = sampler_of(stack).sample(light_of(cosine, DRAWN), np.random.default_rng(12))
    counts = np.bincount(bins.of(view[kept]), minlength=bins.count)
    unbent = LayerStack.of(
        tuple(BraggLayer.of(1.0, x.n2, x.d1_nm, x.d2_nm, x.cells, x.alpha) for x in stack.layers),
        base=stack.base,
    )
    share = binned_density(sampler_of(unbent), cosine, bins)
    assert chi_square_z(counts, kept.sum() * share.ravel() / share.sum()) > 10.0


@pytest.mark.parametrize("name", CASES)
def test_light_over_density_has_the_albedo_as_its_mean(name: str) -> None:
    stack, cosine = CASES[name]
    sampler, count = sampler_of(stack), 1_500
    light = light_of(cosine, count)
    view, kept = sampler.sample(light, np.random.default_rng(13))
    turn = np.clip(view[:, 0] / np.maximum(np.hypot(view[:, 0], view[:, 1]), 1e-12), -1.0, 1.0)
    f = brdf(stack, Pose.of(cosine, view[:, 2], turn), ThreeWavelengths(stack, WAVELENGTH_NM))
    density = np.where(kept, sampler.density(light, view), 1.0)
    value = np.where(kept[:, None], f * view[:, 2:] / density[:, None], 0.0)
    albedo = binned_model(stack, cosine, WAVELENGTH_NM, Bins(8, 6), gauss=12).sum(axis=(0, 1))
    error = value.std(axis=0) / np.sqrt(count)
    assert np.all(np.abs(value.mean(axis=0) - albedo) < 4.5 * error)
    # Importance is what it is for: a path's value varies no more than a few times its mean.
    assert np.all(value.mean(axis=1).std() < 1.5 * value.mean())


def test_layers_are_chosen_by_what_they_reflect() -> None:
    stack = LayerStack.of((ROUGH, A), base=LayerBase.of(0.5))
    sampler = sampler_of(stack)
    probability, alphas = sampler.lobes(light_of(0.7, 1))
    passing = [
        2.0 * sampler.facets.facet_passage(k, np.array([0.7])).mean() * g1 / (1.0 + g1)
        for k, g1 in ((0, masking(0.4)), (1, masking(0.1)))
    ]
    expected = [1.0 - passing[0], passing[0] * (1.0 - passing[1]), 0.0, passing[0] * passing[1]]
    np.testing.assert_allclose(probability[0], expected, rtol=1e-12)
    assert alphas == [0.4, 0.1, 1.0, None]


def masking(alpha: float) -> float:
    return float(2.0 / (1.0 + np.sqrt(1.0 + alpha**2 * (1.0 / 0.7**2 - 1.0))))


def test_what_has_no_brdf_is_not_drawn() -> None:
    light = light_of(0.7, 100)
    rng = np.random.default_rng(1)
    # A smooth mirror on black sends light into one direction only.
    smooth = sampler_of(LayerStack.of((SMOOTH,)))
    view, kept = smooth.sample(light, rng)
    assert not kept.any()
    assert np.all(smooth.density(light, view) == 0.0)
    # Over a rough layer all samples go to that.
    over = sampler_of(LayerStack.of((SMOOTH, A)))
    np.testing.assert_allclose(over.lobes(light)[0][0], [0.0, 1.0, 0.0, 0.0])
    assert np.all(smooth.density(light, -light) == 0.0)


def test_a_transmitted_path_weighs_what_eq_32_says() -> None:
    g1 = np.array([0.1, 0.5, 1.0])
    passage = np.array([0.9, 0.3, 0.7])
    np.testing.assert_allclose(passage * g1 / passing_chance(passage, g1), 0.5 * (1.0 + g1), rtol=1e-14)
