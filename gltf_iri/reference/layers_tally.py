"""What is kept of simulated paths: means with standard errors, by outgoing direction or at given viewers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.layers import Pose
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.rough_bragg import facet_weight, g1_smith
from gltf_iri.reference.layers_facets import StackFacets
from gltf_iri.reference.layers_walk import Rows, Transmission, Walk

__all__ = ["Bins", "DirectionTally", "Moments", "Sampled", "ViewerTally"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Sampled:
    """A mean over paths and its standard error, of one shape."""

    mean: Float64
    error: Float64


class Moments:
    """Running sums over paths of values and of their squares."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self._sum, self._squares, self._paths = np.zeros(shape), np.zeros(shape), 0

    def add(self, total: Float64, squares: Float64, paths: int) -> None:
        """Add the sums over `paths` more paths."""
        self._sum += total
        self._squares += squares
        self._paths += paths

    def sampled(self) -> Sampled:
        """Return mean and standard error; of a single path the error is unknown, and infinite."""
        mean = self._sum / self._paths
        # Rounding may leave values that do not vary a hair less than no variance.
        spread = np.maximum(self._squares / self._paths - mean * mean, 0.0)
        if self._paths < 2:
            return Sampled(mean, np.full_like(mean, np.inf))
        return Sampled(mean, np.sqrt(spread / (self._paths - 1)))


@dataclass(frozen=True, slots=True)
class Bins:
    """Outgoing directions: `cosines` bins of cosθ_o even in [0, 1], `turns` of φ even in [0, π].

    φ is the turn between light and viewer, whose two senses are alike; all bins have the same solid angle.
    """

    cosines: int = 8
    turns: int = 6

    @property
    def count(self) -> int:
        """Return the number of bins."""
        return self.cosines * self.turns

    def of(self, direction: Float64) -> NDArray[np.intp]:
        """Return the bin (n,) of unit directions (n, 3) outside, light at azimuth 0."""
        turn = np.abs(np.arctan2(direction[:, 1], direction[:, 0])) / np.pi
        row = np.minimum((direction[:, 2] * self.cosines).astype(np.intp), self.cosines - 1)
        column = np.minimum((turn * self.turns).astype(np.intp), self.turns - 1)
        return row * self.turns + column


class DirectionTally:
    """Power that leaves into each bin, (cosines, turns, C); free of every BRDF's formula."""

    def __init__(self, bins: Bins, channels: int) -> None:
        self._bins = bins
        self.moments = Moments((bins.cosines, bins.turns, channels))
        self._sums = [np.zeros((bins.count, channels)) for _ in range(2)]

    def begin(self, paths: int) -> None:
        """Begin a block of so many paths."""
        self._sums = [np.zeros_like(total) for total in self._sums]

    def meets(self, walk: Walk, layer: int, rows: Rows) -> None:
        """Only paths that leave count."""

    def leaves(self, rows: Rows, direction: Float64, value: Float64) -> None:
        """Add the power of leaving paths; each leaves once."""
        bins = self._bins.of(direction)
        for total, added in zip(self._sums, (value, value * value), strict=True):
            for channel in range(total.shape[1]):
                total[:, channel] += np.bincount(bins, added[:, channel], minlength=len(total))

    def end(self, paths: int) -> None:
        """Count the block's paths."""
        shape = (self._bins.cosines, self._bins.turns, -1)
        self.moments.add(self._sums[0].reshape(shape), self._sums[1].reshape(shape), paths)


class ViewerTally:
    """f_r (M, C), 1/sr, towards M viewers: at everything that a path comes down upon, what it sends to each.

    Each is reached by f of the layer or base times what the layers above and the coating let through to it.
    Smooth layers have no f. Whether the path then reflects does not matter: the mean over both ways is taken.
    """

    def __init__(
        self, facets: StackFacets, pose: Pose, channels: NDArray[np.intp], transmission: Transmission
    ) -> None:
        self._facets, self._channels, self._by_facets = facets, channels, transmission == "facets"
        host = float(facets.stack.host_ior)
        cosine, turn = np.broadcast_arrays(pose.cos_theta_o, pose.cos_phi)
        cosine, turn = cosine.ravel(), turn.ravel()
        z = cosine_in_host(host, cosine)
        sine = np.sqrt((1.0 - z) * (1.0 + z))
        self._view = np.column_stack([sine * turn, sine * np.sqrt((1.0 - turn) * (1.0 + turn)), z])
        self._passage = coating_transmittance(host, cosine) / (host * host)
        self.viewers = len(z)
        self.moments = Moments((self.viewers, len(channels)))
        self._sum = np.zeros((0, self.viewers, len(channels)))

    def begin(self, paths: int) -> None:
        """Begin a block of so many paths."""
        self._sum = np.zeros((paths, self.viewers, len(self._channels)))

    def meets(self, walk: Walk, layer: int, rows: Rows) -> None:
        """Add what each path sends to each viewer from here."""
        is_base = layer == self._facets.count
        if not is_base and self._facets.alpha(layer) == 0.0:
            return
        light = walk.towards_light(rows)
        half = light[:, None, :] + self._view
        level, squared = np.sum(half[..., :2] ** 2, axis=-1), np.sum(half * half, axis=-1)
        # Light and viewer on opposite horizons meet no facet: 0/0.
        sine_squared = np.divide(level, squared, out=np.zeros(level.shape), where=squared > 0.0)
        cos_h = 0.5 * np.sqrt(squared)
        weight = self._weight(layer, sine_squared, light[:, 2:])
        if is_base:
            spectrum, sent = walk.spectrum[rows][:, None, :], self._base(weight, cos_h)
        else:
            reflectance = self._facets.reflectance(layer, cos_h.ravel()).reshape(*cos_h.shape, -1)
            spectrum, sent = walk.spectrum[rows][:, None, :] * reflectance, weight[..., None]
        for above in range(layer):
            spectrum = spectrum * self._way_out(above, len(rows), walk)
        seen = (spectrum @ walk.sensor) * walk.base[rows][:, None, :]
        self._sum[rows] += seen * sent * self._passage[:, None]

    def leaves(self, rows: Rows, direction: Float64, value: Float64) -> None:
        """Where paths happen to leave does not count."""

    def end(self, paths: int) -> None:
        """Count the block's paths."""
        self.moments.add(self._sum.sum(axis=0), (self._sum**2).sum(axis=0), paths)

    def _weight(self, layer: int, sine_squared: Float64, cos_light: Float64) -> Float64:
        stack = self._facets.stack
        is_base = layer == self._facets.count
        alpha = float(stack.base.metal_alpha) if is_base else self._facets.alpha(layer)
        return facet_weight(sine_squared, cos_light, self._view[:, 2], alpha)

    def _base(self, weight: Float64, cos_h: Float64) -> Float64:
        """Return the base's own f (n, M, C) in the host."""
        stack, channels = self._facets.stack, self._channels
        bent = float(stack.host_ior / stack.exit_ior) ** 2
        diffuse = stack.base.diffuse[channels] * (bent / np.pi)
        metal = float(stack.base.metal_share) * f_schlick(
            stack.base.metal_f0[channels], np.clip(cos_h, 0.0, 1.0)[..., None]
        )
        return np.asarray(diffuse + weight[..., None] * metal)

    def _way_out(self, layer: int, paths: int, walk: Walk) -> Float64:
        """Return T (M, W) towards the viewers; by one drawn facet each, (n, M, W), in the plain reference."""
        g1 = g1_smith(self._view[:, 2], self._facets.alpha(layer))[:, None]
        if not self._by_facets:
            return np.asarray(g1 * self._facets.facet_passage(layer, self._view[:, 2]))
        views = np.tile(self._view, (paths, 1))
        passed = 1.0 - self._facets.drawn_facet(layer, views, walk.rng)[1]
        return np.asarray(g1 * passed.reshape(paths, len(self._view), -1))
