"""Paths of light through a stack of rough Bragg layers, without positions: only directions and order count.

Light enters through the coating, and at each layer that it meets is either mirrored by a facet or passes
unbent; the base sends it back, the coating lets it out or mirrors it inside (Fourneau et al. 2024, §4.2).
Which of two ways a path takes is drawn, and the path's weight makes up for the draw:

    "facets"  one facet is drawn as light sees it; reflected with probability ⟨R⟩, else passed. Weights
              R/⟨R⟩ · G₁(o) and (1 − R)/(1 − ⟨R⟩) · G₁(i): Eq. 23 by sampling, the plain reference.
    "table"   passed with probability p = 2⟨T⟩/(1 + G₁), Eq. 31, weight T/p (Eq. 32 and 33), T from Eq. 28;
              else reflected at a facet drawn then, weight R/(1 − p) · G₁(o): the optimised one.

⟨·⟩ is a mean over the wavelengths that the path carries. What facets mask, or mirror down beyond the
horizon, the layer absorbs; `Walk.spent` holds where the power of each path has gone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.optics.visible_normals import draw_facet, mirrored
from gltf_iri.reference.layers_facets import StackFacets, passing_chance

__all__ = ["FATES", "Observer", "Rows", "Transmission", "Walk"]

Float64 = NDArray[np.float64]
Rows = NDArray[np.intp]
Transmission = Literal["table", "facets"]

# Where power goes: outside again (the coating's own mirror image left out), into the base, into layers that
# mask it, to paths that would reflect more often than asked, to paths given up after STEPS_MAX.
FATES: Final = ("reflected", "base", "masked", "cut", "lost")

# Paths that have been sent back so often go on with the probability of their weight.
_ROULETTE_AFTER: Final = 3
_ROULETTE_MIN: Final = 0.05
_STEPS_MAX: Final = 2000


class Observer(Protocol):
    """What looks at paths: as they come down upon something that reflects, and as they leave."""

    def meets(self, walk: Walk, layer: int, rows: Rows) -> None:
        """See paths come down to `layer`, or to the base where it is the number of layers."""

    def leaves(self, rows: Rows, direction: Float64, value: Float64) -> None:
        """See paths leave into unit directions (n, 3) outside with the power `value` (n, C)."""


class Walk:
    """A block of `count` paths of light from cos_theta_i, of unit power in each of C channels.

    The light stands over the +X axis. direction (n, 3): of travel, but z is |cosθ|; is_up says which way.
    spectrum (n, W) and base (n, C) are the path's weight; its value is (spectrum @ sensor)·base.

    sensor : (W, C), columns of sum 1; shares : (W,) of sum 1, for ⟨·⟩.
    base_channels : (C,) which of the base's three channels each of C sees.
    """

    def __init__(
        self,
        facets: StackFacets,
        cos_theta_i: float,
        count: int,
        rng: np.random.Generator,
        *,
        sensor: Float64,
        shares: Float64,
        base_channels: NDArray[np.intp],
        transmission: Transmission,
        max_reflections: int | None,
    ) -> None:
        self.facets, self.sensor, self.max_reflections = facets, sensor, max_reflections
        self.rng, self._shares, self._channels = rng, shares, base_channels
        self._by_facets = transmission == "facets"
        self._host = float(facets.stack.host_ior)
        z = float(cosine_in_host(self._host, cos_theta_i))
        # Along the surface light never comes down; it does from just above.
        z = max(z, 1e-9)
        self.direction = np.tile([-np.sqrt((1.0 - z) * (1.0 + z)), 0.0, z], (count, 1))
        entering = float(coating_transmittance(self._host, cos_theta_i))
        self.spectrum = np.full((count, len(sensor)), entering)
        self.base = np.ones((count, sensor.shape[1]))
        self.reflections = np.zeros(count, np.intp)
        self.spent = {fate: np.zeros((count, sensor.shape[1])) for fate in FATES}
        self._gap = np.zeros(count, np.intp)  # the layer below the path
        self._is_up = np.zeros(count, bool)
        self._alive = np.ones(count, bool)
        self._active = np.arange(count)

    def value(self, rows: Rows) -> Float64:
        """Return the power (n, C) that paths carry."""
        return np.asarray((self.spectrum[rows] @ self.sensor) * self.base[rows])

    def towards_light(self, rows: Rows) -> Float64:
        """Return where paths come from, as unit vectors (n, 3) on the side that they come from (z > 0)."""
        return np.asarray(self.direction[rows] * [-1.0, -1.0, 1.0])

    def run(self, observers: Sequence[Observer]) -> None:
        """Walk until every path has left, is absorbed or cut; count as lost what is then still on its way."""
        layers = self.facets.count
        for _ in range(_STEPS_MAX):
            self._active = np.flatnonzero(self._alive)
            if len(self._active) == 0:
                return
            self._leave(self._rows(0, is_up=True), observers)
            for layer in range(layers):
                self._cross(self._rows(layer + 1, is_up=True), layer, observers)
                self._cross(self._rows(layer, is_up=False), layer, observers)
            self._send_back(self._rows(layers, is_up=False), observers)
        self._end(np.flatnonzero(self._alive), "lost")

    def _rows(self, gap: int, *, is_up: bool) -> Rows:
        of = self._active
        return np.asarray(of[self._alive[of] & (self._gap[of] == gap) & (self._is_up[of] == is_up)])

    def _spend(self, rows: Rows, fate: str, value: Float64) -> None:
        self.spent[fate][rows] += value

    def _end(self, rows: Rows, fate: str) -> None:
        self._spend(rows, fate, self.value(rows))
        self._alive[rows] = False

    def _see(self, observers: Sequence[Observer], layer: int, rows: Rows) -> None:
        if self.max_reflections is not None:
            rows = rows[self.reflections[rows] < self.max_reflections]
        for observer in observers if len(rows) else ():
            observer.meets(self, layer, rows)

    def _cross(self, rows: Rows, layer: int, observers: Sequence[Observer]) -> None:
        """Reflect or pass each path at `layer`; upwards the layer is its own mirror image."""
        if len(rows) == 0:
            return
        self._see(observers, layer, rows[~self._is_up[rows]])
        view = self.towards_light(rows)
        is_reflected, light, factor = self._drawn(layer, view)
        self.spectrum[rows] *= factor
        leaving = np.where(is_reflected, light[:, 2], view[:, 2])
        seen = g1_smith(np.maximum(leaving, 0.0), self.facets.alpha(layer))
        # A smooth mirror's G₁ is 1 at the horizon too; no facet sends light below it.
        seen = np.where(leaving <= 0.0, 0.0, seen)
        self._spend(rows, "masked", self.value(rows) * (1.0 - seen)[:, None])
        self.spectrum[rows] *= seen[:, None]
        self._alive[rows[seen == 0.0]] = False
        passing = rows[~is_reflected]
        self._gap[passing] += np.where(self._is_up[passing], -1, 1)
        turned = is_reflected & (seen > 0.0)
        self._turn(rows[turned], light[turned])

    def _drawn(self, layer: int, view: Float64) -> tuple[NDArray[np.bool_], Float64, Float64]:
        """Return which paths are reflected, where to (n, 3), and the weights' gain (n, W) but masking."""
        chance = self.rng.random(len(view))
        if self._by_facets:
            light, reflectance = self.facets.drawn_facet(layer, view, self.rng)
            probability = reflectance @ self._shares
            is_reflected = chance < probability
            taken = np.where(is_reflected[:, None], reflectance, 1.0 - reflectance)
            chosen = np.where(is_reflected, probability, 1.0 - probability)
            return is_reflected, light, taken / chosen[:, None]
        passage = self.facets.facet_passage(layer, view[:, 2])
        g1 = g1_smith(view[:, 2], self.facets.alpha(layer))
        probability = passing_chance(passage @ self._shares, g1)
        is_reflected = chance >= probability
        light, taken = view.copy(), passage
        light[is_reflected], taken[is_reflected] = self.facets.drawn_facet(
            layer, view[is_reflected], self.rng
        )
        chosen = np.where(is_reflected, 1.0 - probability, probability)
        return is_reflected, light, taken / chosen[:, None]

    def _send_back(self, rows: Rows, observers: Sequence[Observer]) -> None:
        """Send paths back from the base, diffusely or by a facet of its metal; the rest it absorbs."""
        if len(rows) == 0:
            return
        base = self.facets.stack.base
        diffuse, metal_f0 = base.diffuse[self._channels], base.metal_f0[self._channels]
        share, mean = float(base.metal_share), float(np.mean(diffuse))
        if mean + share == 0.0:
            self._end(rows, "base")
            return
        self._see(observers, self.facets.count, rows)
        arrived = self.value(rows)
        is_diffuse = self.rng.random(len(rows)) * (mean + share) < mean
        place = self.rng.random((len(rows), 2))
        light, is_out = self._diffuse(place)
        factor = np.tile(diffuse * ((mean + share) / mean) if mean else diffuse, (len(rows), 1))
        view, metal = self.towards_light(rows)[~is_diffuse], ~is_diffuse
        if len(view):
            alpha = np.full(len(view), float(base.metal_alpha))
            facet = draw_facet(view, alpha, alpha, place[metal])
            light[metal], is_out[metal] = mirrored(view, facet), True
            schlick = f_schlick(metal_f0, np.clip(np.sum(view * facet, axis=1), 0.0, 1.0)[:, None])
            up = light[metal, 2]
            seen = np.where(up > 0.0, g1_smith(np.maximum(up, 0.0), alpha), 0.0)
            factor[metal] = schlick * (seen * (mean + share))[:, None]
        self.base[rows] *= factor
        self._spend(rows, "base", arrived - self.value(rows))
        is_lit = factor.max(axis=1) > 0.0
        self._alive[rows[~is_lit]] = False
        self._turn(rows[is_lit], light[is_lit])
        # Totally reflected inside: back to the base.
        self._is_up[rows[~is_out]] = False

    def _diffuse(self, place: Float64) -> tuple[Float64, NDArray[np.bool_]]:
        """Return a Lambertian base's directions (n, 3) in the host, and which get out of its medium."""
        ratio = float(self.facets.stack.exit_ior) / self._host
        turn = 2.0 * np.pi * place[:, 1]
        squared = ratio * ratio * place[:, 0]  # sin² in the host
        is_out = squared < 1.0
        sine = np.sqrt(np.where(is_out, squared, 0.0))
        cosine = np.sqrt(1.0 - sine * sine)
        return np.column_stack([sine * np.cos(turn), sine * np.sin(turn), cosine]), is_out

    def _turn(self, rows: Rows, light: Float64) -> None:
        """Send reflected paths the other way; end those over the limit, and thin those that carry little."""
        self.direction[rows] = light
        self._is_up[rows] = ~self._is_up[rows]
        self.reflections[rows] += 1
        if self.max_reflections is not None:
            self._end(rows[self.reflections[rows] > self.max_reflections], "cut")
        old = rows[self._alive[rows] & (self.reflections[rows] > _ROULETTE_AFTER)]
        if len(old):
            weight = self.spectrum[old].max(axis=1) * self.base[old].max(axis=1)
            chance = np.clip(weight, _ROULETTE_MIN, 1.0)
            self.spectrum[old] /= chance[:, None]
            self._alive[old[self.rng.random(len(old)) >= chance]] = False

    def _leave(self, rows: Rows, observers: Sequence[Observer]) -> None:
        """Let paths out through the coating, or mirror them back inside, all of them beyond its angle."""
        if len(rows) == 0:
            return
        inside = self.direction[rows]
        outside, is_out = inside[:, 2], np.ones(len(rows), bool)
        if self._host != 1.0:
            sine_squared = self._host * self._host * (1.0 - outside) * (1.0 + outside)
            outside = np.sqrt(np.maximum(1.0 - sine_squared, 0.0))
            passage = np.where(sine_squared < 1.0, coating_transmittance(self._host, outside), 0.0)
            is_out = self.rng.random(len(rows)) < passage
            self._is_up[rows[~is_out]] = False
        leaving = rows[is_out]
        level = inside[is_out, :2] * self._host
        value = self.value(leaving)
        for observer in observers:
            observer.leaves(leaving, np.column_stack([level, outside[is_out]]), value)
        self._end(leaving, "reflected")
