"""Random stacks of rough Bragg layers, and their colours by the fixed rules that GLSL takes."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from single_precision import rounded

from gltf_iri.colour.quadrature import ColourRule
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.layer_stack import Sight, sight_of
from gltf_iri.optics.rough_bragg import filter_nodes
from gltf_iri.rendering.constants import FILTER_POINTS
from gltf_iri.rendering.optics_tables import Table

__all__ = ["PROBES", "Case", "FixedRules", "Known", "random_case", "rule_table"]

Float64 = NDArray[np.float64]
Fields = TypeVar("Fields", BraggLayer, LayerBase, Pose)

# Layers come as (n1, n2, α) and (d1, d2, cells), a pose as (cosθ_i, cosθ_o, cosφ), a base as its diffuse
# colour and (share, F0, α) of its metal: OpenGL takes 16 arguments.
PROBES = """
BraggLayer given(vec3 a, vec3 b) { return BraggLayer(a.x, a.y, b.x, b.y, b.z, a.z); }
vec3 reflected_1(float host, vec3 c, vec3 a, vec3 b) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    return stack_reflected(host, stack, 0, c.x, c.y, c.z);
}
vec3 passed_1(float host, vec3 c, vec3 a, vec3 b) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    return stack_passed(host, stack, 1, c.y, c.z);
}
vec3 reflected_2(float host, vec3 c, vec3 a, vec3 b, vec3 a2, vec3 b2) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    stack[1] = given(a2, b2);
    return stack_reflected(host, stack, 1, c.x, c.y, c.z);
}
vec3 passed_2(float host, vec3 c, vec3 a, vec3 b, vec3 a2, vec3 b2) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    stack[1] = given(a2, b2);
    return stack_passed(host, stack, 2, c.y, c.z);
}
vec3 summed(float host, vec3 pose, vec3 diffuse, vec3 metal, BraggLayer stack[BRAGG_LAYERS_MAX], int count) {
    Sight seen = sight_of(host, pose.x, pose.y, pose.z);
    float facets = facet_weight(seen.n_cross_h_squared, seen.cos_i, seen.cos_o, metal.z);
    vec3 base = diffuse / PI + metal.x * facets * f_schlick(vec3(metal.y), seen.cos_h);
    vec3 sent = base * stack_passed(host, stack, count, seen.cos_i, seen.cos_o);
    for (int layer = 0; layer < count; ++layer) {
        sent += facet_weight(seen.n_cross_h_squared, seen.cos_i, seen.cos_o, stack[layer].alpha) *
                stack_reflected(host, stack, layer, seen.cos_h, seen.cos_i, seen.cos_o);
    }
    return seen.passage * sent;
}
vec3 brdf_1(float host, vec3 pose, vec3 diffuse, vec3 metal, vec3 a, vec3 b) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    return summed(host, pose, diffuse, metal, stack, 1);
}
vec3 brdf_2(float host, vec3 pose, vec3 diffuse, vec3 metal, vec3 a, vec3 b, vec3 a2, vec3 b2) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    stack[1] = given(a2, b2);
    return summed(host, pose, diffuse, metal, stack, 2);
}
""".strip().splitlines()


@dataclass(frozen=True, slots=True)
class Case:
    """Stacks of a number of layers, and where they are seen from; arrays of rows, as float32 has them."""

    stack: LayerStack
    pose: Pose

    @property
    def sight(self) -> Sight:
        pose = self.pose
        return sight_of(self.stack.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)

    def rows(self, chosen: NDArray[np.intp]) -> Case:
        """Return the case of some rows."""
        stack, base, pose = self.stack, self.stack.base, self.pose
        return Case(
            LayerStack(
                tuple(_rows_of(layer, chosen) for layer in stack.layers),
                stack.host_ior[chosen],
                _rows_of(base, chosen),
            ),
            _rows_of(pose, chosen),
        )

    def steps(self) -> Iterator[Case]:
        """Yield the case with each thickness and each cosine up to four float32 steps off."""
        for ulp in (-4.0, -2.0, -1.0, 1.0, 2.0, 4.0):
            for number, layer in enumerate(self.stack.layers):
                for name in ("d1_nm", "d2_nm"):
                    moved = replace(layer, **{name: _stepped(getattr(layer, name), ulp)})
                    layers = (*self.stack.layers[:number], moved, *self.stack.layers[number + 1 :])
                    yield Case(replace(self.stack, layers=layers), self.pose)
            for name in ("cos_theta_i", "cos_theta_o"):
                cosine = np.minimum(_stepped(getattr(self.pose, name), ulp), 1.0)
                yield Case(self.stack, replace(self.pose, **{name: cosine}))

    def arguments(self) -> list[Float64]:
        """Return host, pose, base and layers as the probes of whole BRDFs take them."""
        base, pose = self.stack.base, self.pose
        return [
            self.stack.host_ior,
            _columns(pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi),
            base.diffuse,
            _columns(base.metal_share, base.metal_f0[..., 0], base.metal_alpha),
            *self._layers(),
        ]

    def colour_arguments(self) -> list[Float64]:
        """Return host, cosines of h, i and o there, and layers, as the probes of colours take them."""
        sight = self.sight
        return [self.stack.host_ior, _columns(sight.cos_h, sight.cos_i, sight.cos_o), *self._layers()]

    def _layers(self) -> list[Float64]:
        given = []
        for layer in self.stack.layers:
            given.append(_columns(layer.n1, layer.n2, layer.alpha))
            given.append(_columns(layer.d1_nm, layer.d2_nm, layer.cells))
        return given


class FixedRules:
    """`LayerColours` by rules that do not refine: FILTER_POINTS a panel, `rule` for what passes layers.

    fine : the rule of what is reflected; means : instead, colours of factors (rows, wavelengths of `rule`);
    node_step_rad : by how much the angles of the filter's facets are off.
    """

    def __init__(
        self,
        stack: LayerStack,
        rule: ColourRule,
        fine: ColourRule,
        means: Callable[[list[Float64]], Float64] | None = None,
        node_step_rad: float = 0.0,
    ) -> None:
        self._stack, self._rule, self._fine, self._step_rad = stack, rule, fine, node_step_rad
        self._means = means

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        if layer == 0:
            return self.at(0, cos_h[:, None], self._fine)[:, 0] @ self._fine.weights
        through = self._through(layer, cos_i, cos_o)
        if self._means is not None:
            return self._means([self.at(layer, cos_h[:, None], self._rule)[:, 0], *through])
        # Of each fourth wavelength, straight between them.
        passed, place = np.prod(through, axis=0), np.arange(len(self._fine.wavelength_nm))
        before, after = place // 4, np.minimum(place // 4 + 1, passed.shape[1] - 1)
        passed = passed[:, before] + 0.25 * (place % 4) * (passed[:, after] - passed[:, before])
        return (self.at(layer, cos_h[:, None], self._fine)[:, 0] * passed) @ self._fine.weights

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        through = self._through(len(self._stack.layers), cos_i, cos_o)
        return np.prod(through, axis=0) @ self._rule.weights if self._means is None else self._means(through)

    def _through(self, above: int, cos_i: Float64, cos_o: Float64) -> list[Float64]:
        factors = []
        for number, cosine in itertools.product(range(above), (cos_i, cos_o)):
            nodes, weights = filter_nodes(cosine, self._stack.layers[number].alpha, count=FILTER_POINTS)
            moved = np.cos(np.clip(np.arccos(nodes) + self._step_rad, 0.0, 0.5 * np.pi))
            passed = 1.0 - self.at(number, moved, self._rule)
            factors.append(np.matmul(weights[:, None, :], passed)[:, 0])
        return factors

    def at(self, number: int, cosines: Float64, rule: ColourRule) -> Float64:
        """Return R (rows, cosines, wavelengths) at `cosines` (rows, cosines)."""
        layer = self._stack.layers[number]
        films = layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells
        host, *cell = (a[:, None, None] for a in (self._stack.host_ior, *films))
        return bragg_reflectance(host, *cell, rule.wavelength_nm, cosines[..., None], backend="numba")


class Known:
    """`LayerColours` that are known already: of each layer, and what passes all."""

    def __init__(self, reflected: list[Float64], passed: Float64) -> None:
        self._reflected, self._passed = reflected, passed

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        return self._reflected[layer]

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        return self._passed


def random_case(rows: int, layers: int, seed: int, *, cells_max: int, bends: bool = False) -> Case:
    """n2 1.3–2.2, periods 100–1000 nm, fills 0.2–0.8, α 0.01–0.6, cosines 0.05–1; half of all rows in air.

    The others lie in a host of 1 to 1.7, and every fourth row is seen close to the mirror direction. n1 is
    the host's index, but the last layer's is 1 to 1.7 where it `bends`. Bases are coloured, and metals of α
    0.01–0.6 by half of them, where nothing bends.
    """
    g = np.random.default_rng(seed)
    host = rounded(np.where(g.random(rows) < 0.5, 1.0, g.uniform(1.0, 1.7, rows)))
    made = []
    for number in range(layers):
        period_nm, fill = g.uniform(100.0, 1000.0, rows), g.uniform(0.2, 0.8, rows)
        given = g.uniform(1.3, 2.2, rows), fill * period_nm, (1.0 - fill) * period_nm
        cells, alpha = g.integers(1, cells_max + 1, rows), g.uniform(0.01, 0.6, rows)
        n1 = rounded(g.uniform(1.0, 1.7, rows)) if bends and number == layers - 1 else host
        made.append(BraggLayer.of(n1, *(rounded(a) for a in given), cells, rounded(alpha)))
    metal = np.where(g.random(rows) < (1.0 if bends else 0.5), 0.0, g.random(rows))
    base = LayerBase.of(
        diffuse=rounded(g.random((rows, 3))),
        metal_f0=np.repeat(rounded(g.random(rows))[:, None], 3, axis=1),
        metal_share=rounded(metal),
        metal_alpha=rounded(g.uniform(0.01, 0.6, rows)),
    )
    i, o, phi = g.uniform(0.05, 1.0, rows), g.uniform(0.05, 1.0, rows), g.uniform(-1.0, 1.0, rows)
    near = np.arange(rows) % 4 == 0
    o = np.where(near, np.clip(i + 0.05 * g.normal(size=rows), 0.05, 1.0), o)
    phi = np.where(near, -1.0 + g.random(rows) ** 4, phi)
    return Case(LayerStack.of(tuple(made), host, base), Pose.of(rounded(i), rounded(o), rounded(phi)))


def rule_table(rule: ColourRule, fine: ColourRule) -> Table:
    """Return what fills `spectral_rule` where `rule` is the coarse rule, each fourth wavelength of `fine`."""
    table = np.zeros((4, len(fine.wavelength_nm), 4), dtype=np.float32)
    wavenumber = 1.0 / fine.wavelength_nm
    leading = (wavenumber.astype(np.float32).view(np.uint32) & np.uint32(0xFFFFF000)).view(np.float32)
    table[0, :, 0], table[0, :, 1], table[1, :, :3] = leading, wavenumber - leading, fine.weights
    table[3, : len(rule.weights), :3] = rule.weights
    return table


def _rows_of(given: Fields, chosen: NDArray[np.intp]) -> Fields:
    return type(given)(*(getattr(given, field.name)[chosen] for field in fields(given)))


def _stepped(values: Float64, ulp: float) -> Float64:
    return values * (1.0 + ulp * float(np.finfo(np.float32).eps))


def _columns(*columns: Float64 | NDArray[np.int64]) -> Float64:
    return np.stack(np.broadcast_arrays(*columns), axis=-1).astype(np.float64)
