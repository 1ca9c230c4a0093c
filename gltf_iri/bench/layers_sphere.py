"""A small sphere under layers in an environment, path by path: what Table 2 of Fourneau et al. 2024 times.

Two estimators of the light ∫ L(i) f_r(i, o) cosθ_i dω that each pixel's viewer sees. A simulation follows
paths from the viewer, whichever way light runs, and sees the environment where they leave; the model draws
where light may come from and weighs it by its BRDF.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import ColourRule
from gltf_iri.evaluation.layers import LayerColours, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.layers_facets import StackFacets
from gltf_iri.reference.layers_sampling import LayerSampler
from gltf_iri.reference.layers_walk import Rows, Walk

__all__ = ["Ring", "RingSampler", "SpherePixels", "modelled", "simulated"]

Float64 = NDArray[np.float64]

_ROWS_AT_ONCE: Final = 1 << 13  # keeps spectra of as many paths within a core's cache, or near it


@dataclass(frozen=True, slots=True)
class Ring:
    """Pixels that are seen at one cosine.

    pixels : (p,) places in the picture; frames : (p, 3, 3), whose rows are the axes of each: the viewer over
        +X, the normal +Z.
    """

    cos_o: float
    pixels: NDArray[np.intp]
    frames: Float64


@dataclass(frozen=True, slots=True)
class SpherePixels:
    """A sphere seen from afar along −Z, filling a square of `side` pixels; row 0 is the top."""

    side: int

    @property
    def normals(self) -> tuple[NDArray[np.intp], Float64]:
        """Places (m,) of the pixels whose centres lie on the sphere, and its normals (m, 3) there."""
        centres = (np.arange(self.side) + 0.5) * (2.0 / self.side) - 1.0
        x, y = np.meshgrid(centres, -centres)
        squared = (x * x + y * y).ravel()
        covered = np.flatnonzero(squared < 1.0)
        normal = np.column_stack([x.ravel(), y.ravel(), np.sqrt(np.maximum(1.0 - squared, 0.0))])
        return covered, normal[covered]

    def rings(self) -> Iterator[Ring]:
        """Yield the pixels by their distance from the centre; up to eight, or some more, share one."""
        covered, normal = self.normals
        cosine, ring = np.unique(np.round(normal[:, 2], 12), return_inverse=True)
        for number, cos_o in enumerate(cosine):
            inside = ring == number
            up = normal[inside]
            level = np.array([0.0, 0.0, 1.0]) - up[:, 2:] * up
            length = np.linalg.norm(level, axis=1, keepdims=True)
            # Seen straight on every azimuth is alike.
            across = np.where(length > 0.0, level / np.maximum(length, 1e-300), [1.0, 0.0, 0.0])
            frames = np.stack([across, np.cross(up, across), up], axis=1)
            yield Ring(float(cos_o), covered[inside], frames)

    def picture(self, pixels: NDArray[np.intp], values: Float64) -> Float64:
        """Return (side, side, 3) with `values` (m, 3) at `pixels`, 0 elsewhere."""
        flat = np.zeros((self.side * self.side, 3))
        flat[pixels] = values
        return flat.reshape(self.side, self.side, 3)


class _Sky:
    """Adds up what paths of one ring see of the environment where they leave."""

    def __init__(self, ring: Ring, environment: EnvironmentMap, samples: int) -> None:
        self._ring, self._environment, self._samples = ring, environment, samples
        self.seen = np.zeros((len(ring.pixels), 3))

    def meets(self, walk: Walk, layer: int, rows: Rows) -> None:
        """What paths meet on their way does not count."""

    def leaves(self, rows: Rows, direction: Float64, value: Float64) -> None:
        """Add the light that comes down the way that paths leave by."""
        pixel = rows // self._samples
        radiance = self._environment.radiance(_in_world(self._ring, pixel, direction))
        np.add.at(self.seen, pixel, value * radiance)


class RingSampler(LayerSampler):
    """`LayerSampler` of views at one cosine: what is drawn from is computed once for all of them."""

    def lobes(self, light: Float64) -> tuple[Float64, list[float | None]]:
        """Return what `LayerSampler.lobes` does for the first of `light`, for each of them."""
        chosen, alphas = super().lobes(light[:1])
        return np.broadcast_to(chosen, (len(light), chosen.shape[1])), alphas


def simulated(
    sphere: SpherePixels,
    facets: StackFacets,
    rule: ColourRule,
    environment: EnvironmentMap,
    samples: int,
    rng: np.random.Generator,
    *,
    max_reflections: int | None = None,
) -> Float64:
    """Return the picture (side, side, 3) of `samples` multiplexed paths a pixel (Eq. 31 to 33).

    facets : of the stack at the rule's wavelengths. max_reflections : 1 keeps what the model knows of.
    """
    covered, _ = sphere.normals
    picture = sphere.picture(covered, np.zeros((len(covered), 3))).reshape(-1, 3)
    shares = _shares(rule)
    for ring in sphere.rings():
        total = np.zeros((len(ring.pixels), 3))
        for count in _portions(samples, len(ring.pixels)):
            sky = _Sky(ring, environment, count)
            walk = Walk(
                facets,
                ring.cos_o,
                count * len(ring.pixels),
                rng,
                sensor=rule.weights,
                shares=shares,
                base_channels=np.arange(3),
                transmission="table",
                max_reflections=max_reflections,
            )
            walk.run([sky])
            total += sky.seen
        picture[ring.pixels] = total / samples + _mirrored(facets.stack, ring, environment)
    return picture.reshape(sphere.side, sphere.side, 3)


def modelled(
    sphere: SpherePixels,
    stack: LayerStack,
    colours: LayerColours,
    environment: EnvironmentMap,
    samples: int,
    sampler: RingSampler,
    rng: np.random.Generator,
) -> Float64:
    """Return the picture (side, side, 3) of `samples` directions a pixel, weighed by the BRDF (Eq. 34)."""
    picture = np.zeros((sphere.side * sphere.side, 3))
    for ring in sphere.rings():
        total = np.zeros((len(ring.pixels), 3))
        for count in _portions(samples, len(ring.pixels)):
            view = np.tile([np.sqrt(1.0 - ring.cos_o**2), 0.0, ring.cos_o], (count * len(ring.pixels), 1))
            light, kept = sampler.sample(view, rng)
            density = sampler.density(view, light)
            rows = np.flatnonzero(kept & (density > 0.0))
            light, pixel = light[rows], rows // count
            cos_i = light[:, 2]
            level = np.hypot(light[:, 0], light[:, 1])
            # Straight above the surface every turn is alike; rounding may leave a cosine beyond 1.
            turn = np.divide(light[:, 0], level, out=np.ones_like(level), where=level > 0.0)
            pose = Pose.of(np.minimum(cos_i, 1.0), ring.cos_o, np.clip(turn, -1.0, 1.0))
            weight = brdf(stack, pose, colours) * (cos_i / density[rows])[:, None]
            radiance = environment.radiance(_in_world(ring, pixel, light))
            np.add.at(total, pixel, weight * radiance)
        picture[ring.pixels] = total / samples + _mirrored(stack, ring, environment)
    return picture.reshape(sphere.side, sphere.side, 3)


def _in_world(ring: Ring, pixel: NDArray[np.intp], direction: Float64) -> Float64:
    return np.asarray(np.einsum("nk,nkw->nw", direction, ring.frames[pixel]))


def _mirrored(stack: LayerStack, ring: Ring, environment: EnvironmentMap) -> Float64:
    """Return what the smooth coating mirrors (p, 3), which needs no samples."""
    share = coating_reflectance(stack.host_ior, ring.cos_o)
    sine = np.sqrt(1.0 - ring.cos_o**2)
    direction = np.tile([-sine, 0.0, ring.cos_o], (len(ring.pixels), 1))
    return np.asarray(share * environment.radiance(_in_world(ring, np.arange(len(ring.pixels)), direction)))


def _portions(samples: int, pixels: int) -> Iterator[int]:
    """Yield how many samples a pixel are taken at once."""
    most = max(1, _ROWS_AT_ONCE // pixels)
    for start in range(0, samples, most):
        yield min(most, samples - start)


def _shares(rule: ColourRule) -> Float64:
    """Return the weights (W,) of the mean that decides where a path goes: half by what colours see."""
    seen = np.abs(rule.weights).sum(axis=1)
    return np.asarray(0.5 / len(seen) + 0.5 * seen / seen.sum())
