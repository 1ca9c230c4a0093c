"""GLSL's stacks of rough Bragg layers are Python's, by the same rules, up to the rounding of float32."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.layers_cases import random_case
from gltf_iri.bench.layers_fixed import (
    PROBES,
    FixedRules,
    colours_and_brdf,
    errors_of,
    glsl_colours,
    moved_by_steps,
)
from gltf_iri.colour.bands import bands_of
from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, ColourRule, colour_rule
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.rough_bragg import filter_nodes
from gltf_iri.planning.method import find_method
from gltf_iri.rendering.constants import FILTER_POINTS
from gltf_iri.rendering.optics_tables import SPECTRAL_COARSE_DEGREE, Table, optics_table
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_BLOCH_MAX_ABS, GLSL_LAYERS_MAX_ABS

Float64 = NDArray[np.float64]

SINGLE = "optics/layers_single.glsl"
CHUNK = 10_000

# Beside PROBES: what crosses each layer once, at the viewer's cosine.
CROSSED = """
vec3 crossed_1(float host, vec3 c, vec3 a, vec3 b) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    return stack_entering(host, stack, 1, c.z);
}
vec3 crossed_2(float host, vec3 c, vec3 a, vec3 b, vec3 a2, vec3 b2) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack[0] = given(a, b);
    stack[1] = given(a2, b2);
    return stack_entering(host, stack, 2, c.z);
}
""".strip().splitlines()


def three_wavelengths(g: np.random.Generator) -> tuple[ColourRule, ColourRule]:
    """A coarse rule of one wavelength a channel, which no average helps, and a fine one of nine."""
    nm = np.sort(g.uniform(380.0, 780.0, 9))
    return ColourRule(nm[::4], np.eye(3)), ColourRule(nm, np.repeat(np.eye(3), 3, axis=0) / 3.0)


def rule_table(rule: ColourRule, fine: ColourRule) -> Table:
    """Return what fills `spectral_rule` where `rule` is the coarse rule, each fourth wavelength of `fine`."""
    table = np.zeros((4, len(fine.wavelength_nm), 4), dtype=np.float32)
    wavenumber = 1.0 / fine.wavelength_nm
    leading = (wavenumber.astype(np.float32).view(np.uint32) & np.uint32(0xFFFFF000)).view(np.float32)
    table[0, :, 0], table[0, :, 1], table[1, :, :3] = leading, wavenumber - leading, fine.weights
    table[3, : len(rule.weights), :3] = rule.weights
    return table


@pytest.mark.gl
@pytest.mark.parametrize(
    ("layers", "rows", "cells_max", "settled"),
    [(1, 100_000, 30, 0.99), (1, CHUNK, 5, 0.9995), (2, CHUNK, 30, 0.99)],
    ids=["one layer", "one layer of few cells", "two layers"],
)
def test_glsl_layers_equal_python_layers(
    layers: int,
    rows: int,
    cells_max: int,
    settled: float,
    probe: Probe,
    record_property: Callable[[str, object], None],
) -> None:
    """Within GLSL_LAYERS_MAX_ABS, but where float32 steps of the row's own inputs move it as far."""
    g = np.random.default_rng(2024)
    errors, beyond = [], []
    for seed in range(rows // CHUNK):
        case, rules = random_case(CHUNK, layers, seed, cells_max=cells_max), three_wavelengths(g)
        truth = colours_and_brdf(case, FixedRules(case.stack, *rules))
        error = errors_of(glsl_colours(probe, case, SINGLE, {"spectral_rule": rule_table(*rules)}), truth)
        errors.append(error)
        chosen = np.flatnonzero((error > GLSL_LAYERS_MAX_ABS).any(axis=0))
        moved = moved_by_steps(case.rows(chosen), rules, [each[chosen] for each in truth])
        beyond.append(error[:, chosen] - moved)
    every = np.concatenate(errors, axis=1)
    names = [*(f"reflected {k}" for k in range(1, layers + 1)), "passed", "f_r"]
    for name, each in zip(names, every, strict=True):
        share = float(np.mean(each <= GLSL_LAYERS_MAX_ABS))
        numbers = f"p99 {np.quantile(each, 0.99):.1e}, max {each.max():.1e}"
        record_property("measured", f"{layers} of ≤ {cells_max} cells, {name}: {share:.3%} within; {numbers}")
        assert share >= settled
    assert np.concatenate(beyond, axis=1).max(initial=0.0) <= GLSL_LAYERS_MAX_ABS


@pytest.mark.gl
@pytest.mark.parametrize("layers", [1, 2])
def test_light_that_is_bent_behind_the_last_layer_passes_in_glsl_as_in_python(
    layers: int, probe: Probe
) -> None:
    """Also where n1 below the host's index reflects all of it."""
    case, rules = (
        random_case(2000, layers, 59, cells_max=8, bends=True),
        three_wavelengths(np.random.default_rng(1)),
    )
    truth = colours_and_brdf(case, FixedRules(case.stack, *rules))
    found = glsl_colours(probe, case, SINGLE, {"spectral_rule": rule_table(*rules)})
    errors = errors_of(found, truth)[:-1]
    assert np.quantile(errors, 0.999) <= GLSL_LAYERS_MAX_ABS
    chosen = np.flatnonzero((errors > GLSL_LAYERS_MAX_ABS).any(axis=0))
    moved = moved_by_steps(case.rows(chosen), rules, [each[chosen] for each in truth])[:-1]
    assert (errors[:, chosen] - moved).max(initial=0.0) <= GLSL_LAYERS_MAX_ABS


@pytest.mark.gl
@pytest.mark.parametrize("method", ["layers_single", "layers_bands"])
def test_the_tables_that_are_drawn_with_hold_the_rules_that_python_has(
    method: str, probe: Probe, record_property: Callable[[str, object], None]
) -> None:
    """All 129 wavelengths through two layers: were loops cut short, as llvmpipe may, colours would be off."""
    case = random_case(300, 2, 16, cells_max=30)
    rule, fine = colour_rule(SPECTRAL_COARSE_DEGREE, "D65"), colour_rule(SPECTRAL_DEGREE, "D65")
    bands = bands_of(16, "D65")
    names = ("spectral_rule", "layer_bands")[: 2 if method == "layers_bands" else 1]
    tables = {name: optics_table(name, "D65", {}) for name in names}

    def of_bands(factors: list[Float64]) -> Float64:
        means = np.prod([bands.means(each, rule) for each in factors], axis=0)
        return np.asarray(means @ bands.weights)

    python = FixedRules(case.stack, rule, fine, of_bands if method == "layers_bands" else None)
    sight = case.sight
    for name, expected in (
        ("reflected_2", python.reflected(1, sight.cos_h, sight.cos_i, sight.cos_o)),
        ("passed_2", python.passed(sight.cos_i, sight.cos_o)),
        ("crossed_2", python.entering(sight.cos_o)),
        ("reflected_1", python.reflected(0, sight.cos_h, sight.cos_i, sight.cos_o)),
    ):
        given = case.colour_arguments()[: 4 if name == "reflected_1" else None]
        lines = (*PROBES, *CROSSED)
        found = probe.call(name, f"optics/{method}.glsl", given, lines=lines, tables=tables)
        error = np.abs(found - expected).max()
        record_property("measured", f"{method}, {name}: {error:.1e}")
        assert error <= GLSL_LAYERS_MAX_ABS


@pytest.mark.gl
@pytest.mark.parametrize("method", ["bloch", "landmarks", "landmarks-sub"])
def test_glsl_layers_multiply_the_colours_of_every_mirror_method(
    method: str, probe: Probe, record_property: Callable[[str, object], None]
) -> None:
    case = random_case(1000, 1, 34, cells_max=30)
    host, (layer,) = case.stack.host_ior, case.stack.layers
    # Light that is reflected totally within the cells is none of `bloch`.
    case = case.rows(np.flatnonzero(layer.n2 > 1.05 * host))
    host, (layer,), sight = case.stack.host_ior, case.stack.layers, case.sight
    blank = evaluate(method, Mirror.of(1.0, 1.0, 1.5, 100.0, 100.0, 5))
    tables = {
        name: optics_table(name, "D65", blank.parameters)
        for name in find_method(method, "mirror").glsl_tables
    }

    def colour(cosines: Float64) -> Float64:
        cell = layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, host
        mirror = Mirror.of(cosines, *(a[:, None] for a in cell))
        return evaluate(method, mirror, backend="numba").rgb

    through = []
    for cosine in (sight.cos_i, sight.cos_o):
        nodes, weights = filter_nodes(cosine, layer.alpha, count=FILTER_POINTS)
        through.append(np.einsum("rn,rnc->rc", weights, 1.0 - colour(nodes)))
    for name, expected, bound in (
        ("reflected_1", colour(sight.cos_h[:, None])[:, 0], max(GLSL_LAYERS_MAX_ABS, GLSL_BLOCH_MAX_ABS)),
        ("passed_1", through[0] * through[1], GLSL_LAYERS_MAX_ABS),
        ("crossed_1", through[1], GLSL_LAYERS_MAX_ABS),
    ):
        found = probe.call(
            name,
            "optics/layers_rgb.glsl",
            case.colour_arguments(),
            lines=(*PROBES, *CROSSED),
            tables=tables,
            defines=(find_method(method, "mirror").define,),
        )
        error = np.abs(found - expected).max()
        record_property("measured", f"{method}, {name}: {error:.1e}")
        assert error <= bound


@pytest.mark.gl
def test_smooth_layers_pass_what_their_facets_do_not_reflect(probe: Probe) -> None:
    """α = 0 has one facet's angle, without a filter."""
    case, rules = random_case(1000, 1, 3, cells_max=5), three_wavelengths(np.random.default_rng(3))
    host, cosines, films, thicknesses = case.colour_arguments()
    films[:, 2] = 0.0
    cosines[:, 0] = cosines[:, 2] = cosines[:, 1]
    tables = {"spectral_rule": rule_table(*rules)}
    passed = probe.call("passed_1", SINGLE, [host, cosines, films, thicknesses], lines=PROBES, tables=tables)
    flat = FixedRules(case.stack, *rules)
    reflected = flat.at(0, case.sight.cos_i[:, None], rules[0])[:, 0]
    assert np.abs(passed - (1.0 - reflected) ** 2).max() <= GLSL_LAYERS_MAX_ABS
