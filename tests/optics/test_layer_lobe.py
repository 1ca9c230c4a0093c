"""The lobe's quadrature against the BRDF summed over light directions, and the bounds of its sum."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.layer_lobe import layer_lobe
from gltf_iri.optics.rough_bragg import facet_weight


@pytest.mark.parametrize("alpha", [0.1, 0.4, 1.0])
@pytest.mark.parametrize("cos_o", [0.3, 0.7, 1.0])
def test_the_lobe_is_the_brdf_summed_over_all_light(alpha: float, cos_o: float) -> None:
    cosines, weights = layer_lobe(cos_o, alpha)
    found = np.sum(weights * np.cos(5.0 * cosines) ** 2)

    # Facets drawn evenly from D cosθ over strata; i = 2(o·h)h − o, dω_i = 4(o·h) dω_h.
    share, turn = np.meshgrid((np.arange(600) + 0.5) / 600, (np.arange(240) + 0.5) / 240)
    tangent = alpha * np.sqrt(share / (1.0 - share))
    cos_m = 1.0 / np.sqrt(1.0 + tangent**2)
    sin_m, sin_o = tangent * cos_m, np.sqrt(1.0 - cos_o**2)
    o_dot_h = sin_o * sin_m * np.cos(2.0 * np.pi * turn) + cos_o * cos_m
    cos_i = 2.0 * o_dot_h * cos_m - cos_o
    seen = (cos_i > 0.0) & (o_dot_h > 0.0)
    spread = sin_m**2 + alpha**2 * cos_m**2
    density = alpha**2 / (np.pi * spread**2) * cos_m
    brdf = facet_weight(sin_m**2, np.clip(cos_i, 1e-9, 1.0), cos_o, alpha)
    summed = np.mean(np.where(seen, brdf * cos_i * 4.0 * o_dot_h / density * np.cos(5.0 * o_dot_h) ** 2, 0.0))
    assert abs(found - summed) < 3e-4


def test_a_perfect_layer_sends_no_more_than_comes() -> None:
    cos_o, alpha = np.linspace(1e-3, 1.0, 30)[:, None], np.array([2e-3, 0.01, 0.1, 0.5, 1.0])
    _, weights = layer_lobe(cos_o, alpha)
    albedo = weights.sum(axis=-1)
    assert np.all(weights >= 0.0)
    assert np.all(albedo <= 1.0 + 1e-5)
    # A smooth one sends all but what grazes.
    assert np.all(albedo[3:, 0] > 0.95)
