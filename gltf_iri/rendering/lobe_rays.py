"""Lobes about an axis, and directions that stand for one: what shaders/pass/prefilter.frag reads along."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import d_ggx
from gltf_iri.optics.sheen import d_charlie, v_sheen

__all__ = ["Lobe", "ggx_lobe", "lobe_rays", "sheen_lobe", "softened"]

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
    return lambda half_sine_squared: (
        d_ggx(half_sine_squared, alpha) * np.maximum(1.0 - 2.0 * half_sine_squared, 0.0)
    )


def sheen_lobe(alpha: float) -> Lobe:
    """Return D V (N·L) for N = V over sin²(θ/2), of fibres."""

    def lobe(half_sine_squared: Float64) -> Float64:
        n_dot_l = np.maximum(1.0 - 2.0 * half_sine_squared, 1e-9)  # V has N·L below the line
        seen = d_charlie(np.sqrt(1.0 - half_sine_squared), alpha) * v_sheen(n_dot_l, 1.0, alpha) * n_dot_l
        return np.where(half_sine_squared <= 0.5, seen, 0.0)

    return lobe


def softened(lobe: Lobe, width_rad: float) -> Lobe:
    """Return the means of `lobe` over rings about its axis, for maps whose texels it does not span.

    They overlap by half, and their weight falls off linearly, so that the lobe keeps its mean angle.
    """
    at = np.square(np.sin(np.linspace(0.0, np.pi / 2.0, 1 << 12)))

    def ring_means(values: Float64) -> Float64:
        total = np.concatenate([[0.0], np.cumsum(np.diff(at) * (values[1:] + values[:-1]) * 0.5)])
        half_angle = np.arcsin(np.sqrt(at))
        inner, outer = (
            np.square(np.sin(np.clip(half_angle + side * width_rad / 4.0, 0.0, np.pi / 2.0)))
            for side in (-1.0, 1.0)
        )
        return np.asarray((np.interp(outer, at, total) - np.interp(inner, at, total)) / (outer - inner))

    means = ring_means(ring_means(lobe(at)))
    return lambda half_sine_squared: np.interp(half_sine_squared, at, means)


def lobe_rays(lobe: Lobe, count: int) -> Float32:
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
    solid_angle = np.minimum(_SHARE_AVERAGED * share, _SHARE_MAX_SR)
    sine = 2.0 * np.sqrt(at * (1.0 - at))
    rays = [sine * np.cos(turn), sine * np.sin(turn), 1.0 - 2.0 * at, solid_angle]
    return np.stack(rays, axis=-1).astype(np.float32)
