"""The fibres' masking between the two columns of its fit, written out from the paper's own terms."""

from __future__ import annotations

import math

import pytest

from gltf_iri.optics.sheen import lambda_sheen

# Estevez & Kulla 2017, section 3: the parameters of L for r = 0 and for r = 1.
PRINTED = {
    "a": (25.3245, 21.5473),
    "b": (3.32435, 3.82987),
    "c": (0.16801, 0.19823),
    "d": (-1.27393, -1.97760),
    "e": (-4.85967, -4.32054),
}


@pytest.mark.parametrize("alpha", [0.04, 0.3, 0.7])
@pytest.mark.parametrize("cosine", [0.02, 0.2, 0.49, 0.8, 0.97])
def test_the_fit_runs_from_smooth_to_rough_as_the_square_of_what_is_missing_to_1(
    cosine: float, alpha: float
) -> None:
    """P = (1 − r)² P₀ + (1 − (1 − r)²) P₁ for each parameter."""
    smooth = 1.0 - 2.0 * alpha + alpha * alpha
    a, b, c, d, e = (smooth * at_0 + (1.0 - smooth) * at_1 for at_0, at_1 in PRINTED.values())

    def exponent(x: float) -> float:
        return a / (1.0 + b * math.pow(x, c)) + d * x + e

    folded = 2.0 * exponent(0.5) - exponent(1.0 - cosine)
    expected = math.exp(exponent(cosine) if cosine < 0.5 else folded)
    assert float(lambda_sheen(cosine, alpha)) == pytest.approx(expected, rel=1e-12)
