"""What a rough Bragg layer sends of a white sky: its reflectance at the angles that its facets are met at.

The layer's facets mask light and viewer apart, G = G₁(i) G₁(o) (Fourneau et al. 2024, Eq. 19), so that its
albedo is not that of the other lobes of glTF, whose masking knows of both (`optics/facet_mean.py`).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.facet_mean import facet_directions

__all__ = ["layer_lobe"]

Float64 = NDArray[np.float64]

# Gauss points over the slope of the facets, for each of two panels, and over half a turn: 1e-6 of the sum.
_SLOPES: Final = 32
_TURNS: Final = 12


def layer_lobe(
    cos_theta_o: ArrayLike, alpha: ArrayLike, *, slopes: int = _SLOPES, turns: int = _TURNS
) -> tuple[Float64, Float64]:
    """Return cosines cosθ_h and weights (..., 2·slopes·turns): ∫ R(θ_h) w cosθ_i dω_i = Σ weights R(cosines).

    w is `rough_bragg.facet_weight`, D G₁(i) G₁(o) / (4 cosθ_i cosθ_o); with R = 1 the sum is at most 1.

    cos_theta_o : of the viewer in the host, in (0, 1]; alpha : in (0, 1]; both broadcast.
    """
    cos_h, cos_i, share = facet_directions(cos_theta_o, alpha, slopes=slopes, turns=turns)
    cos_o, a = (np.asarray(x, np.float64)[..., None] for x in (cos_theta_o, alpha))
    a2 = a * a
    # G₁/(2c) = 1/(c + √…), of light and of viewer.
    roots = (cos_i + np.sqrt(a2 + (1.0 - a2) * cos_i**2)) * (cos_o + np.sqrt(a2 + (1.0 - a2) * cos_o**2))
    return cos_h, np.asarray(share / roots)
