"""Colours of rough Bragg layers by rules that do not refine, those of GLSL, and how far GLSL is from them."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend, has_numba
from gltf_iri.bench.layers_cases import Case
from gltf_iri.colour.quadrature import ColourRule
from gltf_iri.evaluation.layers import LayerColours, LayerStack, brdf
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import filter_nodes
from gltf_iri.rendering.constants import FILTER_POINTS
from gltf_iri.rendering.optics_tables import Table
from gltf_iri.rendering.probe import Probe

__all__ = ["PROBES", "FixedRules", "colours_and_brdf", "errors_of", "glsl_colours", "moved_by_steps"]

Float64 = NDArray[np.float64]

# Layers come as (n1, n2, α) and (d1, d2, cells), a pose as (cosθ_i, cosθ_o, cosφ), a base as its diffuse
# colour and (share, F0, α) of its metal: OpenGL takes 16 arguments.
PROBES: Final = tuple(
    """
#include "optics/fresnel.glsl"
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
)


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
        self._backend: Backend = "numba" if has_numba() else "numpy"

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (rows, 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        if layer == 0:
            return self.at(0, cos_h[:, None], self._fine)[:, 0] @ self._fine.weights
        through = self._through(layer, cos_i, cos_o)
        if self._means is not None:
            return self._means([self.at(layer, cos_h[:, None], self._rule)[:, 0], *through])
        # Of each fourth wavelength, straight between them.
        passed, place = np.prod(through, axis=0), np.arange(len(self._fine.wavelength_nm))
        before, after = place // 4, np.minimum(place // 4 + 1, passed.shape[1] - 1)
        passed = passed[:, before] + 0.25 * (place % 4) * (passed[:, after] - passed[:, before])
        seen = self.at(layer, cos_h[:, None], self._fine)[:, 0] * passed
        return np.asarray(seen @ self._fine.weights)

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (rows, 3), the colour of Π_k T_k(i) T_k(o) over all layers."""
        return self._crossing(cos_i, cos_o)

    def entering(self, cos_i: Float64) -> Float64:
        """Return (rows, 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        return self._crossing(cos_i)

    def _crossing(self, *cosines: Float64) -> Float64:
        through = self._through(len(self._stack.layers), *cosines)
        if self._means is not None:
            return self._means(through)
        return np.asarray(np.prod(through, axis=0) @ self._rule.weights)

    def _through(self, above: int, *cosines: Float64) -> list[Float64]:
        factors = []
        for number, cosine in itertools.product(range(above), cosines):
            nodes, weights = filter_nodes(cosine, self._stack.layers[number].alpha, count=FILTER_POINTS)
            if self._step_rad:
                nodes = np.cos(np.clip(np.arccos(nodes) + self._step_rad, 0.0, 0.5 * np.pi))
            passed = 1.0 - self.at(number, nodes, self._rule)
            factors.append(np.matmul(weights[:, None, :], passed)[:, 0])
        return factors

    def at(self, number: int, cosines: Float64, rule: ColourRule) -> Float64:
        """Return R (rows, cosines, wavelengths) at `cosines` (rows, cosines)."""
        layer = self._stack.layers[number]
        films = self._stack.host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm
        host, n1, n2, d1_nm, d2_nm = (a[:, None, None] for a in films)
        cells, cosine = layer.cells[:, None, None], cosines[..., None]
        return bragg_reflectance(
            host, n1, n2, d1_nm, d2_nm, cells, rule.wavelength_nm, cosine, backend=self._backend
        )


def colours_and_brdf(case: Case, colours: LayerColours) -> list[Float64]:
    """Return each layer's reflected colour, what passes all, and f_r, (rows, 3) each, computed once."""
    sight = case.sight
    reflected = [
        colours.reflected(k, sight.cos_h, sight.cos_i, sight.cos_o) for k in range(len(case.stack.layers))
    ]
    passed = colours.passed(sight.cos_i, sight.cos_o)
    return [*reflected, passed, brdf(case.stack, case.pose, _Known(reflected, passed))]


def glsl_colours(probe: Probe, case: Case, include: str, tables: Mapping[str, Table]) -> list[Float64]:
    """Return the same by the GLSL of `include`, whose f_r takes its cosines and colours from itself."""
    colours, count = case.colour_arguments(), len(case.stack.layers)
    calls = [(f"reflected_{k + 1}", colours[: 4 + 2 * k]) for k in range(count)]
    calls += [(f"passed_{count}", colours), (f"brdf_{count}", case.arguments())]
    return [
        probe.call(name, include, given, lines=PROBES, tables=tables).astype(np.float64)
        for name, given in calls
    ]


def errors_of(found: Sequence[Float64], truth: Sequence[Float64]) -> Float64:
    """Return (colours, rows) of the worst channel; f_r, the last, relative to max(1, f_r)."""
    scales = [*(1.0 for _ in truth[1:]), np.maximum(1.0, np.abs(truth[-1]))]
    return np.array(
        [
            (np.abs(a - b) / scale).max(axis=-1, initial=0.0)
            for a, b, scale in zip(found, truth, scales, strict=True)
        ]
    )


def moved_by_steps(case: Case, rules: tuple[ColourRule, ColourRule], truth: Sequence[Float64]) -> Float64:
    """Return (colours, rows): the most that four float32 steps change.

    Of a thickness, a cosine, or of all angles that facets are met at.
    """
    moved = [
        errors_of(colours_and_brdf(each, FixedRules(each.stack, *rules)), truth) for each in case.steps()
    ]
    for ulp in (-4.0, -2.0, -1.0, 1.0, 2.0, 4.0):
        off = FixedRules(case.stack, *rules, node_step_rad=ulp * float(np.finfo(np.float32).eps))
        moved.append(errors_of(colours_and_brdf(case, off), truth))
    return np.asarray(np.max(moved, axis=0))


class _Known:
    """`MirroredColours` that are known already: of each layer, and what passes all."""

    def __init__(self, reflected: list[Float64], passed: Float64) -> None:
        self._reflected, self._passed = reflected, passed

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return the layer's."""
        return self._reflected[layer]

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return what passes all."""
        return self._passed
