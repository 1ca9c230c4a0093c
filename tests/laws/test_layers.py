"""Laws of rough Bragg layers by name: of the filter, of a layer's shares, and of stacks by every method."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.layer_energy import layer_shares, stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.layer_lobe import lobe_nodes
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.rough_bragg import g1_smith, transmission_filter
from gltf_iri.planning.method import method_names

Float64 = NDArray[np.float64]

METHODS = method_names("layers")
COARSE: dict[str, dict[str, float | str]] = {"layers-single-table": {"nodes": 129}}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
VISIBLE_NM = np.linspace(365.0, 825.0, 8)

ALPHAS = (0.001, 0.005, 0.01, 0.05, 0.1, 0.4, 1.0)
COSINES = (0.02, 0.05, 0.2, 0.5, 0.9, 1.0)


def coated(alpha: float = 0.2, base: LayerBase | None = None) -> LayerStack:
    layers = tuple(BraggLayer.of(1.4, n2, d, 120.0, 2, alpha) for n2, d in ((1.7, 90.0), (1.6, 130.0)))
    return LayerStack.of(layers, 1.4, base)


def graded(low: float, high: float, points: int = 12, halvings: int = 26) -> tuple[Float64, Float64]:
    """Return Gauss points on [low, high], of panels that shrink by 0.4 towards both ends."""
    shrunk = 0.5 * 0.4 ** np.arange(halvings, -1, -1.0)
    edges = low + (high - low) * np.concatenate([[0.0], shrunk, 1.0 - shrunk[-2::-1], [1.0]])
    nodes, weights = np.polynomial.legendre.leggauss(points)
    half = 0.5 * np.diff(edges)[:, None]
    return (edges[:-1, None] + half * (nodes + 1.0)).reshape(-1), (half * weights).reshape(-1)


def over_visible_normals(cosine: float, alpha: float, received: Callable[[Float64], Float64], least: float):
    """Return ∫ D_v G₁(o) received(c_o) dω_m over facets whose mirror direction has c_o ≥ `least`.

    By facets' own slope and turn, c_o = s_i sin 2θ_m cos φ + c_i cos 2θ_m; D_v as Heitz 2018, Eq. 1, has it.
    """
    theta_i, reach = np.arccos(cosine), np.arccos(least)
    sine, split = np.sin(theta_i), 0.5 * max(reach - theta_i, 0.0)
    parts = [graded(0.0, split), graded(split, 0.5 * (reach + theta_i))]
    slope, slope_weights = (np.concatenate(a)[:, None] for a in zip(*parts, strict=True))
    with np.errstate(divide="ignore", invalid="ignore"):
        limit = (least - cosine * np.cos(2.0 * slope)) / (sine * np.sin(2.0 * slope))
    most = np.arccos(np.clip(np.nan_to_num(limit, nan=-1.0), -1.0, 1.0))
    share, share_weights = graded(0.0, 1.0)
    turn = np.cos(most * share)
    sent_at = np.maximum(sine * np.sin(2.0 * slope) * turn + cosine * np.cos(2.0 * slope), least)
    met_at = sine * np.sin(slope) * turn + cosine * np.cos(slope)
    density = alpha**2 / (np.pi * (np.sin(slope) ** 2 + (alpha * np.cos(slope)) ** 2) ** 2)
    visible = density * float(g1_smith(cosine, alpha)) * met_at / cosine
    sent = visible * g1_smith(sent_at, alpha) * received(sent_at) * np.sin(slope)
    return float(2.0 * np.sum(sent * slope_weights * most * share_weights))


def adaptive(function: Callable[[Float64], Float64], edges: list[float]) -> float:
    """Return ∫ function by Gauss points, of panels halved until no half differs by 1e-14 from its whole."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    low, high = (np.array(ends) for ends in zip(*pairwise(edges), strict=True))
    total = 0.0

    def panels(start: Float64, stop: Float64) -> Float64:
        half = 0.5 * (stop - start)
        return half * (function(start[:, None] + half[:, None] * (nodes + 1.0)) @ weights)

    while len(low) > 0:
        middle = 0.5 * (low + high)
        halves = panels(low, middle) + panels(middle, high)
        is_open = (np.abs(panels(low, high) - halves) > 1e-14) & (high - low > 1e-12)
        total += float(halves[~is_open].sum())
        low, high = (
            np.concatenate([low[is_open], middle[is_open]]),
            np.concatenate([middle[is_open], high[is_open]]),
        )
    return total


@pytest.mark.parametrize("alpha", ALPHAS)
def test_the_filter_integrates_to_the_masking(alpha: float) -> None:
    """∫ F_α dθ_d = G₁ to 1e-10, Fourneau et al. 2024, Appendix C, by panels that know nothing of the peak."""
    for cosine in COSINES:
        found = adaptive(
            lambda d, c=cosine: transmission_filter(c, d, alpha), list(np.linspace(0.0, 0.5 * np.pi, 257))
        )
        assert abs(found - float(g1_smith(cosine, alpha))) <= 1e-10


@pytest.mark.parametrize("alpha", ALPHAS)
def test_facets_that_let_all_pass_transmit_the_masking(alpha: float) -> None:
    """T with T_λ ≡ 1 is G₁, by what the truth samples T with, for few fringes and many."""
    for cells, d_nm in ((1, 100.0), (20, 400.0)):
        nothing = LayerSpectra(BraggLayer.of(1.3, 1.3, d_nm, d_nm, cells, alpha), 1.3)
        found = nothing.transmissivity(np.array(COSINES), VISIBLE_NM)
        assert np.abs(found - g1_smith(COSINES, alpha)[:, None]).max() <= 1e-10


@pytest.mark.parametrize("alpha", [0.01, 0.05, 0.1, 0.4, 1.0])
@pytest.mark.parametrize("cosine", [0.05, 0.2, 0.5, 0.9, 1.0])
def test_facets_that_mirror_all_send_what_visible_normals_do(alpha: float, cosine: float) -> None:
    """∫ f_r cosθ_o dω_o over directions is ∫ D_v G₁(o) dω_m over facets, to 1e-9, at the points of shares."""
    over_facets = over_visible_normals(cosine, alpha, np.ones_like, 0.0)
    assert abs(lobe_nodes(cosine, alpha, angles=32, turns=32).weights.sum() - over_facets) <= 1e-9


@pytest.mark.parametrize("alpha", [0.01, 0.4])
@pytest.mark.parametrize("cosine", [0.05, 0.7])
@pytest.mark.parametrize("host", [1.01, 1.5])
def test_what_leaves_a_coating_is_what_visible_normals_send_out(
    host: float, cosine: float, alpha: float
) -> None:
    nodes = lobe_nodes(cosine, alpha, host, angles=32, turns=32)
    found = float((nodes.weights * coating_transmittance(host, nodes.cos_outside)).sum())

    def let_out(inside: Float64) -> Float64:
        return coating_transmittance(host, np.sqrt(np.maximum(1.0 - host**2 * (1.0 - inside**2), 0.0)))

    inside, critical = float(cosine_in_host(host, cosine)), float(np.sqrt(1.0 - 1.0 / host**2))
    assert abs(found - over_visible_normals(inside, alpha, let_out, critical)) <= 1e-9


def test_no_cosine_in_a_host_exceeds_one() -> None:
    hosts = np.arange(1.0, 3.0, 1e-3)
    assert np.all(cosine_in_host(hosts, 1.0) <= 1.0)


@given(
    host=st.sampled_from([1.0, 1.4]),
    n1=st.sampled_from([None, 1.0, 1.59]),
    n2=st.floats(1.0, 2.6),
    d_nm=st.tuples(st.floats(20.0, 300.0), st.floats(20.0, 300.0)),
    cells=st.integers(1, 8),
    alpha=st.floats(0.005, 1.0),
    cosine=st.floats(0.01, 1.0),
)
@settings(max_examples=20, deadline=None)
def test_reflected_and_transmitted_are_never_more_than_all(
    host: float,
    n1: float | None,
    n2: float,
    d_nm: tuple[float, float],
    cells: int,
    alpha: float,
    cosine: float,
) -> None:
    """R + T ≤ 1, and R, T ≥ 0, at every wavelength; 1e-9 is what quadrature and rounding may add."""
    layer = BraggLayer.of(host if n1 is None else n1, n2, *d_nm, cells, alpha)
    shares = layer_shares(layer, host, [cosine], VISIBLE_NM)
    assert min(float(each.min()) for each in shares) >= -1e-9
    np.testing.assert_allclose(sum(shares), 1.0, rtol=0, atol=1e-15)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("host", [1.0, 1.4])
def test_light_and_viewer_may_change_places(method: str, host: float) -> None:
    """Helmholtz reciprocity, under a coating too."""
    layer = BraggLayer.of(host, 1.7, 100.0, 130.0, 3, 0.2)
    stack = LayerStack.of((layer, layer), host, LayerBase.of(0.5, 0.8, 0.3, 0.2))
    colours = layer_colours(method, stack, parameters=COARSE.get(method, {}))
    there, back = (brdf(stack, Pose.of(*pose), colours) for pose in ((0.9, 0.3, -0.4), (0.3, 0.9, -0.4)))
    assert np.abs(there - back).max() <= 1e-12 * np.abs(there).max()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("host", [1.0, 1.4])
def test_a_white_furnace_is_not_left_brighter(method: str, host: float) -> None:
    """Over a white base, in luminance: no light comes of none, and from the base none that is not let in."""
    layers = tuple(BraggLayer.of(host, 1.7, d, 120.0, 2, 0.3) for d in (90.0, 130.0))
    stack = LayerStack.of(layers, host, LayerBase.of(1.0))
    colours = layer_colours(method, stack, parameters=COARSE.get(method, {}))
    energy = stack_energy(stack, [0.1, 0.7], colours)
    assert np.all(energy.reflected @ LUMINANCE <= 1.0)
    assert np.all(energy.absorbed @ LUMINANCE >= 0.0)
    assert np.all(energy.from_base @ LUMINANCE <= energy.transmitted @ LUMINANCE)


@pytest.mark.parametrize("method", METHODS)
def test_the_smooth_limit_is_the_smooth_mirror(method: str) -> None:
    """What passes tends to 1 − R at the light's own angle, faster than α."""
    i, o = np.array([0.9, 0.5]), np.array([0.4, 0.7])

    def passed(alpha: float) -> Float64:
        stack = LayerStack.of((BraggLayer.of(1.0, 1.5, 120.0, 120.0, 3, alpha),), 1.0)
        return layer_colours(method, stack, parameters=COARSE.get(method, {})).passed(i, o)

    errors = [float(np.abs(passed(alpha) - passed(0.0)).max()) for alpha in (0.1, 0.01, 0.001)]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 2e-4


@pytest.mark.parametrize("method", METHODS)
def test_one_cell_in_its_own_host_is_a_film(method: str) -> None:
    cosines = np.array([0.2, 0.6, 1.0])
    stack = LayerStack.of((BraggLayer.of(1.2, 1.8, 77.0, 260.0, 1, 0.1),), 1.2)
    found = layer_colours(method, stack).reflected(0, cosines, cosines, cosines)
    film = evaluate("spectral", Film.of(cosines, 260.0, 1.8, base_from_ior(1.2), 1.2)).rgb
    # Tables are linear between 512 cosines, of a fixed rule of wavelengths; Bloch's colours are a table too.
    bounds = {"layers-single-table": 2e-4, "layers-rgb": 1e-3}
    assert np.abs(found - film).max() <= bounds.get(method, 1e-8)


@pytest.mark.parametrize("method", METHODS)
def test_a_black_base_sends_nothing(method: str) -> None:
    """A stack on black sends what its layers do, and on white as much more as passes them and comes back."""
    pose = Pose.of(0.8, 0.6, -0.2)
    stacks = [coated(base=LayerBase.of(rho)) for rho in (0.0, 1.0)]
    colours = layer_colours(method, stacks[1], parameters=COARSE.get(method, {}))
    black, white = (brdf(stack, pose, colours) for stack in stacks)
    i, o = (cosine_in_host(1.4, c) for c in (0.8, 0.6))
    passage = coating_transmittance(1.4, 0.8) * coating_transmittance(1.4, 0.6) / 1.4**2
    assert np.abs(white - black - passage * colours.passed(i, o) / np.pi).max() <= 1e-12
    assert stack_energy(stacks[0], 0.8, colours).from_base.max() == 0.0
