"""Colour from evenly spaced wavelengths: what spectral renderers and tools commonly compute.

Trapezoidal sums over 360–830 nm, whatever lies between two wavelengths:

    X = Σ′ R P x̄ / Σ′ P x̄,  and so for Y and Z;  RGB = M (X, Y, Z)

with the first and last term of Σ′ halved, and M scaled to the white's own X, Y and Z, so that R ≡ 1 is
(1, 1, 1) on every grid. Nothing is refined: narrow features and fine fringes alias.
"""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.integrate import Reflectance
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM, colour_matching, illuminant
from gltf_iri.colour.quadrature import ColourRule
from gltf_iri.colour.spaces import White, rgb_matrix
from gltf_iri.errors import UsageError

__all__ = ["GRID_SAMPLES_MAX", "GRID_SAMPLES_MIN", "grid_rule", "integrate_on_grid"]

Float64 = NDArray[np.float64]

GRID_SAMPLES_MIN: Final = 3  # with fewer all lie where the observer sees nothing
GRID_SAMPLES_MAX: Final = 471  # steps of 1 nm, those of the observer's table

_VALUES_AT_ONCE: Final = 1 << 16  # keeps temporaries inside a core's cache


def integrate_on_grid(reflectance: Reflectance, count: int, samples: int, *, white: White) -> Float64:
    """Return linear Rec.709 (count, 3) of `count` reflectance spectra, from `samples` wavelengths each."""
    rule = grid_rule(samples, white)
    rgb = np.zeros((count, 3))
    step = _VALUES_AT_ONCE // samples
    for start in range(0, count, step):
        rows = np.arange(start, min(start + step, count))
        values = reflectance(rows, rule.wavelength_nm)
        by_channel = values.ndim == 3
        rgb[rows] = np.einsum("rkc,kc->rc", values, rule.weights) if by_channel else values @ rule.weights
    return rgb


@cache
def grid_rule(samples: int, white: White) -> ColourRule:
    """Return the rule of `samples` wavelengths; UsageError where they see nothing of the light."""
    wavelength_nm, seen = _seen(samples, white)
    _, finest = _seen(GRID_SAMPLES_MAX, white)
    total, white_xyz = seen.sum(axis=0), finest.sum(axis=0)
    if not np.all(total > 0.0):
        raise UsageError(f"At {samples} wavelengths this light has no white; ask for more.")
    to_rgb = rgb_matrix(white) * white_xyz
    to_rgb /= to_rgb.sum(axis=1, keepdims=True)
    weights = (seen / total) @ to_rgb.T
    for array in (wavelength_nm, weights):
        array.setflags(write=False)
    return ColourRule(wavelength_nm, weights)


def _seen(samples: int, white: White) -> tuple[Float64, Float64]:
    """Return the wavelengths (k,), and x̄, ȳ, z̄ times the light's power and the rule's weights (k, 3)."""
    wavelength_nm = np.linspace(*WAVELENGTH_RANGE_NM, samples)
    seen = colour_matching(wavelength_nm) * illuminant(wavelength_nm, white)[:, None]
    seen[[0, -1]] *= 0.5
    return wavelength_nm, seen
