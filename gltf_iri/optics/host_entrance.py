"""Light from all around as it enters a stack's host through the smooth surface of it."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.quadrature import gauss_unit

__all__ = ["cosine_outside", "entering_irradiance", "entering_nodes"]

Float64 = NDArray[np.float64]

_NODES = 64


def cosine_outside(host_ior: float, cos_theta: ArrayLike) -> Float64:
    """Return the cosine outside of a direction in the host; 0 for one that its surface mirrors totally."""
    c = np.asarray(cos_theta, np.float64)
    squared = 1.0 - host_ior**2 * (1.0 - c) * (1.0 + c)
    return np.asarray(c if host_ior == 1.0 else np.sqrt(np.maximum(squared, 0.0)))


def entering_nodes(host_ior: float) -> tuple[Float64, Float64]:
    """Return cosines in the host and weights (s,) of ∫ f T cosθ dω/π over the directions of light in it.

    Of a white sky. T is the surface's transmittance. cosθ dω = cosθ₀ dω₀/n_h² of directions outside.
    """
    outside, weights = gauss_unit(_NODES)
    entering = 2.0 * outside * weights * coating_transmittance(host_ior, outside) / host_ior**2
    return cosine_in_host(host_ior, outside), np.asarray(entering)


@cache
def entering_irradiance(host_ior: float) -> float:
    """Return ∫ T cosθ dω/π in the host, a share of the irradiance outside."""
    return float(np.sum(entering_nodes(host_ior)[1]))
