"""Ways of drawing directions for image light: by the sky's brightness, by facets as the viewer sees them, by
the cosine. Each knows how densely it draws any direction, so that all of them may be weighed together.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import ALPHA_MIN, alpha_ggx, anisotropic_alphas
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.facets import Axes, draw_facet, mirror_density, mirrored
from gltf_iri.reference.host_directions import in_host, out_of_host
from gltf_iri.reference.surface import Surface

__all__ = ["HostFacets", "Technique", "count_techniques", "techniques"]

Float64 = NDArray[np.float64]


class Technique(Protocol):
    """A way of drawing directions at n points."""

    def sample(self, place: Float64) -> Float64:
        """Return the directions (n, 3) that `place` (n, 2) in the unit square stands for."""
        ...

    def density(self, direction: Float64) -> Float64:
        """Return how densely (n,), per steradian, `direction` (n, 3) is drawn."""
        ...


def techniques(surface: Surface, plan: MaterialPlan, environment: EnvironmentMap) -> Iterator[Technique]:
    """Yield what draws directions for all the lobes of `surface`."""
    yield _Sky(environment)
    axes = Axes.around(surface.normal, surface.anisotropy_tangent)
    yield _Facets(
        axes, surface.view, *anisotropic_alphas(surface.alpha_roughness, surface.anisotropy_strength)
    )
    if plan.calls_for(Effect.CLEARCOAT):
        alpha = alpha_ggx(surface.clearcoat_roughness)
        yield _Facets(Axes.around(surface.clearcoat_normal), surface.view, alpha, alpha)
    if _has_wide_lobes(plan):
        yield _Cosine(axes)
    if plan.layers is None:
        return
    host = plan.layers.host_ior
    for layer in plan.layers.layers:
        yield HostFacets(axes, surface.view, np.full_like(surface.n_dot_v, layer.alpha), host)
    if host != 1.0:
        smooth = np.full_like(surface.n_dot_v, ALPHA_MIN)
        yield _Facets(axes, surface.view, smooth, smooth)


def count_techniques(plan: MaterialPlan) -> int:
    """Return how many `techniques` there are."""
    count = 2 + plan.calls_for(Effect.CLEARCOAT) + _has_wide_lobes(plan)
    if plan.layers is None:
        return count
    return count + len(plan.layers.layers) + (plan.layers.host_ior != 1.0)


class _Sky:
    def __init__(self, environment: EnvironmentMap) -> None:
        self.sample = environment.sample
        self.density = environment.density


class _Facets:
    def __init__(self, axes: Axes, view: Float64, alpha_t: Float64, alpha_b: Float64) -> None:
        self._axes, self._widths = axes, (alpha_t, alpha_b)
        self._view = axes.to_viewer(view)

    def sample(self, place: Float64) -> Float64:
        return self._axes.to_world(mirrored(self._view, draw_facet(self._view, *self._widths, place)))

    def density(self, direction: Float64) -> Float64:
        return mirror_density(self._view, self._axes.to_local(direction), *self._widths)


class HostFacets:
    """Facets that lie in a host, whose smooth surface bends light and viewer on their way."""

    def __init__(self, axes: Axes, view: Float64, alpha: Float64, host_ior: float) -> None:
        self._axes, self._alpha, self._host_ior = axes, alpha, host_ior
        self._view = in_host(axes.to_viewer(view), host_ior)

    def sample(self, place: Float64) -> Float64:
        """Return directions outside; straight down where light would not get out of the host."""
        inside = mirrored(self._view, draw_facet(self._view, self._alpha, self._alpha, place))
        outside, is_out = out_of_host(inside, self._host_ior)
        return self._axes.to_world(np.where(is_out[:, None], outside, [0.0, 0.0, -1.0]))

    def density(self, direction: Float64) -> Float64:
        """Return the density inside · dω'/dω, with dω'/dω = cosθ / (n² cosθ')."""
        outside = self._axes.to_local(direction)
        inside = in_host(outside, self._host_ior)
        bent = np.maximum(outside[:, 2], 0.0) / (self._host_ior**2 * inside[:, 2])
        return np.asarray(bent * mirror_density(self._view, inside, self._alpha, self._alpha))


class _Cosine:
    def __init__(self, axes: Axes) -> None:
        self._axes = axes

    def sample(self, place: Float64) -> Float64:
        # Even on the disc below, lifted to the hemisphere (Malley's method).
        radius, turn = np.sqrt(place[:, 0]), 2.0 * np.pi * place[:, 1]
        height = np.sqrt(1.0 - place[:, 0])
        return self._axes.to_world(np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height]))

    def density(self, direction: Float64) -> Float64:
        return np.asarray(np.maximum(np.sum(direction * self._axes.normal, axis=1), 0.0) / np.pi)


def _has_wide_lobes(plan: MaterialPlan) -> bool:
    return plan.calls_for(Effect.DIELECTRIC) or plan.calls_for(Effect.SHEEN)
