"""Directions that stand for a lobe: what shaders/pass/prefilter.frag reads along."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import d_ggx
from gltf_iri.optics.sheen import d_charlie, v_sheen

__all__ = ["ggx_lobe", "lobe_rays", "sheen_lobe"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
Lobe = Callable[[Float64], Float64]

# Each ray averages over more than its share: neighbours overlap, or a small bright lamp would show as a group
# of separate images of itself.
_SHARE_AVERAGED: Final = 1.4
_SHARE_MAX_SR: Final = 0.5  # where the lobe ends, a ray's share of it grows without bound

_GOLDEN_SECTION: Final = (1.0 + 5.0**0.5) / 2.0

# sin²(θ/2) of a lobe's profile, from far inside the narrowest lobe to the horizon.
_PROFILE: Final = np.concatenate([[0.0], np.geomspace(1e-10, 0.5, 1 << 15)])


def ggx_lobe(alpha: float) -> Lobe:
    """Return D (N·L) for N = V over sin²(θ/2) = |N×H|²: how a rough mirror sees its surroundings."""
    return lambda half_sine_squared: d_ggx(half_sine_squared, alpha) * (1.0 - 2.0 * half_sine_squared)


def sheen_lobe(alpha: float) -> Lobe:
    """Return D V (N·L) for N = V over sin²(θ/2), of fibres."""

    def lobe(half_sine_squared: Float64) -> Float64:
        n_dot_l = np.maximum(1.0 - 2.0 * half_sine_squared, 1e-9)  # V has N·L below the line
        return d_charlie(np.sqrt(1.0 - half_sine_squared), alpha) * v_sheen(n_dot_l, 1.0, alpha) * n_dot_l

    return lobe


def lobe_rays(lobe: Lobe, count: int, *, share_min_sr: float = 0.0) -> Float32:
    """Return (count, 4): directions about +Z, as dense as `lobe`, and the solid angles to average over.

    All weigh alike. Three at a time stand around the axis, so that few rays do not pull the lobe aside, and
    from three to three they turn by the golden section: the seeds of a sunflower leave no gaps. `count` must
    be a multiple of 3.
    """
    values = lobe(_PROFILE)
    # dω = 4π d sin²(θ/2)
    steps = np.diff(_PROFILE) * (values[1:] + values[:-1]) * (2.0 * np.pi)
    total = np.concatenate([[0.0], np.cumsum(steps)])
    rings = count // 3
    at = np.repeat(np.interp((np.arange(rings) + 0.5) / rings, total / total[-1], _PROFILE), 3)
    thirds = np.repeat(np.arange(rings) / _GOLDEN_SECTION, 3) + np.tile(np.arange(3), rings)
    turn = thirds * (2.0 * np.pi / 3.0)
    share = total[-1] / (count * np.maximum(lobe(at), 1e-30))
    solid_angle = np.clip(_SHARE_AVERAGED * share, share_min_sr, _SHARE_MAX_SR)
    sine = 2.0 * np.sqrt(at * (1.0 - at))
    rays = [sine * np.cos(turn), sine * np.sin(turn), 1.0 - 2.0 * at, solid_angle]
    return np.stack(rays, axis=-1).astype(np.float32)
