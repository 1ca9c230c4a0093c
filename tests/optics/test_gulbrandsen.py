"""A metal from its colour and its edge tint: the colour comes back, and the ends are what they say."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.fresnel import interface_power
from gltf_iri.optics.gulbrandsen import index_from_edge_tint
from gltf_iri.optics.refraction import normal_index, normal_index_squared

R = np.linspace(0.0, 0.999, 51)[:, None]
G = np.linspace(0.0, 1.0, 21)


def test_metal_reflects_the_colour_that_was_asked_for() -> None:
    index = index_from_edge_tint(R, G)
    assert np.abs(np.abs((index - 1.0) / (index + 1.0)) ** 2 - R).max() <= 1e-14
    assert np.all((index.real > 0.0) & (index.imag >= 0.0))


def test_extinction_is_the_papers() -> None:
    """k² as the paper prints it, where its difference keeps digits."""
    index = index_from_edge_tint(R[10:], G[4:])
    n = index.real
    printed = (R[10:] * (n + 1.0) ** 2 - (n - 1.0) ** 2) / (1.0 - R[10:])
    assert np.abs(printed / index.imag**2 - 1.0).max() <= 1e-12


def test_no_tint_is_a_dielectric_and_full_tint_the_smallest_index() -> None:
    root = np.sqrt(R[:, 0])
    assert np.array_equal(index_from_edge_tint(R[:, 0], 0.0), (1.0 + root) / (1.0 - root))
    full = index_from_edge_tint(R[:, 0], 1.0)
    assert np.abs(full.real - (1.0 - R[:, 0]) / (1.0 + R[:, 0])).max() <= 1e-15


def test_more_tint_reflects_more_light_at_the_dip_before_grazing() -> None:
    cosine = np.linspace(0.05, 1.0, 96)[:, None]
    index = index_from_edge_tint(0.6, G)
    power = interface_power(1.0, cosine, index, normal_index(normal_index_squared(index, 1.0, cosine)))
    lowest = (0.5 * (power.R_s + power.R_p)).min(axis=0)
    assert np.all(np.diff(lowest) >= 0.0)
    assert lowest[-1] > lowest[0] + 0.01


@pytest.mark.parametrize("tint", [0.0, 0.5, 1.0])
def test_full_reflectivity_is_the_perfect_mirror_and_none_is_air(tint: float) -> None:
    assert np.isinf(index_from_edge_tint(1.0, tint))
    assert index_from_edge_tint(0.0, tint) == 1.0


def test_nan_in_is_nan_out() -> None:
    assert np.isnan(index_from_edge_tint(np.nan, 0.5))
    assert np.isnan(index_from_edge_tint(0.5, np.nan))
