"""Workload `layers`, Table 2 of Fourneau et al. 2024: the single-reflection model against its simulation.

Printed there: n₁ 1, n₂ 1.5, N 10; A (d₁ = d₂ = 250 nm, α 0.1), B (494 nm, α 0.05), ρ_d 0.5 where there is a
diffuse base; 40 × 40 pixels of a sphere, 3,000 samples each, a ground truth of 30,000 with all reflections.
Chosen here, because the first three columns of their Fig. 7 are not described: A on black, A over B on black,
A over B on a diffuse base; the environment is this project's studio; a fiftieth of the samples and of the
truth's a twentieth, of which the noise, and with it SMAPE, is some seven times theirs. Every way has the same
wavelengths, and the model's ways the same directions (Eq. 35).

What fills tables is not timed, as it is not there; `remark` says how long it took.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_fill import bake_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.bench.layers_rows import LayerRow, colour_errors
from gltf_iri.bench.layers_sphere import RingSampler, SpherePixels, modelled, simulated
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.colour.quadrature import ColourRule, colour_rule
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerColours, LayerStack
from gltf_iri.evaluation.layers_bands import LAYER_BANDS
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.reach import Span
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.layers_facets import StackFacets
from gltf_iri.scene.environment import studio

__all__ = ["CONFIGURATIONS", "LAYER_A", "LAYER_B", "PRINTED_2", "SIDE", "TABLE2_ROUNDS", "WAYS_2"]
__all__ += ["Costs", "YehModel", "baked_colours", "measure_table2", "smape"]

Float64 = NDArray[np.float64]

SIDE: Final = 40
TABLE2_ROUNDS: Final = 2

LAYER_A: Final = BraggLayer.of(1.0, 1.5, 250.0, 250.0, 10, 0.1)
LAYER_B: Final = BraggLayer.of(1.0, 1.5, 494.0, 494.0, 10, 0.05)
_DIFFUSE: Final = LayerBase.of(0.5)

CONFIGURATIONS: Final[Mapping[str, LayerStack]] = {
    "A on black": LayerStack.of((LAYER_A,)),
    "A over B on black": LayerStack.of((LAYER_A, LAYER_B)),
    "A over B on ρ 0.5": LayerStack.of((LAYER_A, LAYER_B), 1.0, _DIFFUSE),
}

SIMULATION: Final = "layers-mc"
MODEL: Final = "layers-single"
MODEL_TABLE: Final = "layers-single-table"
BANDS: Final = "layers-bands"
COLOURS: Final = "layers-rgb"
WAYS_2: Final = (SIMULATION, MODEL, MODEL_TABLE, BANDS, COLOURS)

# Seconds, SMAPE and efficiency for each configuration; the ground truth took 127, 317 and 317 s.
PRINTED_2: Final[Mapping[str, tuple[tuple[float, float, float], ...]]] = {
    SIMULATION: ((16.0, 0.029, 271.0), (36.0, 0.056, 156.0), (36.0, 0.049, 178.0)),
    MODEL: ((14.0, 0.016, 570.0), (15.0, 0.031, 692.0), (15.0, 0.024, 882.0)),
    MODEL_TABLE: ((8.5, 0.018, 830.0), (9.2, 0.033, 1044.0), (9.3, 0.025, 1363.0)),
}

_SEED: Final = 3
_TRUTH_SEED: Final = 4
_WHITE: Final = "D65"


@dataclass(frozen=True, slots=True)
class Costs:
    """How much is spent: pixels a side, samples a pixel, and paths a pixel of the ground truth.

    degree : of the wavelengths' rule, even; 128 resolves all fringes of B. cos_nodes : of tables.
    """

    side: int = SIDE
    samples: int = 64
    truth_samples: int = 1600
    degree: int = 128
    cos_nodes: int = 512


class YehModel:
    """`LayerColours` of the paper's model: R of every facet by Yeh's formula, T from tables over the angle.

    Cosines are numbers or (n,).
    """

    def __init__(self, facets: StackFacets, rule: ColourRule) -> None:
        self._facets, self._weights = facets, rule.weights

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (n, 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        spectra = self._facets.reflectance(layer, cos_h) * self._through(layer, cos_i, cos_o)
        return np.asarray(spectra @ self._weights)

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (n, 3), the colour of Π_k T_k(i) T_k(o)."""
        return np.asarray(self._through(self._facets.count, cos_i, cos_o) @ self._weights)

    def entering(self, cos_i: Float64) -> Float64:
        """Return (n, 3), the colour of Π_k T_k(i): of light that crosses the layers once."""
        return np.asarray(self._through(self._facets.count, cos_i) @ self._weights)

    def _through(self, layers: int, *cosines: Float64) -> Float64:
        product = np.ones(1)
        for layer in range(layers):
            for cosine in cosines:
                along = np.atleast_1d(cosine)
                g1 = g1_smith(along, self._facets.alpha(layer))
                product = product * self._facets.facet_passage(layer, along) * g1[:, None]
        return product


def baked_colours(
    stack: LayerStack, bands: int, cos_nodes: int = 512, *, is_colour: bool = False
) -> tuple[LayerLookup, float]:
    """Return the colours of `stack` out of this project's tables, and how many seconds those took to fill."""
    layers = tuple(
        PlannedLayer(
            number,
            float(each.n1),
            float(each.n2),
            (float(each.d1_nm + each.d2_nm),) * 2,
            float(each.d1_nm / (each.d1_nm + each.d2_nm)),
            int(each.cells),
            float(each.alpha),
        )
        for number, each in enumerate(stack.layers)
    )
    plan = LayersPlan(
        layers=layers,
        host_ior=float(stack.host_ior),
        under="nothing" if stack.base.is_black else "base",
        texel=Span(1.0, 1.0),
        method=COLOURS if is_colour else BANDS,
        tables=LayerTables(bands, is_colour, cos_nodes, 1, "f4", 0.0),
    )
    start = time.perf_counter()
    return LayerLookup(bake_layers(plan, _WHITE)), time.perf_counter() - start


def smape(picture: Float64, truth: Float64) -> float:
    """Return the mean of |a − b| / (½(|a| + |b|)), 0 where both are 0; Fourneau et al. 2024, §5."""
    size = 0.5 * (np.abs(picture) + np.abs(truth))
    off = np.abs(picture - truth)
    return float(np.mean(np.divide(off, size, out=np.zeros_like(off), where=size > 0.0)))


def measure_table2(
    costs: Costs | None = None,
    rounds: int = TABLE2_ROUNDS,
    after_configuration: Callable[[], None] = lambda: None,
) -> list[LayerRow]:
    """Return for each configuration the ground truth's row and one for each way.

    Times are medians of `rounds` interleaved pictures; errors are of the first.
    """
    spent = costs or Costs()
    rows: list[LayerRow] = []
    for place, (name, stack) in enumerate(CONFIGURATIONS.items()):
        rows += _configuration(place, f"table 2: {name}", stack, spent, rounds)
        after_configuration()
    return rows


def _configuration(
    place: int, workload: str, stack: LayerStack, costs: Costs, rounds: int
) -> Iterator[LayerRow]:
    rule = colour_rule(costs.degree, _WHITE)
    sphere, environment = SpherePixels(costs.side), EnvironmentMap(studio())
    covered, _ = sphere.normals
    facets = StackFacets(stack, rule.wavelength_nm)
    ways, filled_s = _ways(stack, rule, facets, environment, costs)
    first = {name: run().reshape(-1, 3)[covered] for name, run in ways.items()}
    start = time.perf_counter()
    rng = np.random.default_rng(_TRUTH_SEED)
    whole = simulated(sphere, facets, rule, environment, costs.truth_samples, rng)
    truth_ns = 1e9 * (time.perf_counter() - start)
    truth = whole.reshape(-1, 3)[covered]
    yield LayerRow(
        workload,
        f"{SIMULATION}, all reflections",
        "numpy",
        truth_ns / (len(covered) * costs.truth_samples),
        *colour_errors(truth, truth),
        {"samples": costs.truth_samples},
        smape=0.0,
        remark=f"{1e-9 * truth_ns:.1f} s",
    )
    times_ns = interleaved_ns(list(ways.values()), rounds)
    for (name, seen), time_ns in zip(first.items(), times_ns, strict=True):
        error = smape(seen, truth)
        printed = PRINTED_2[name][place] if name in PRINTED_2 else ()
        yield LayerRow(
            workload,
            name,
            "numpy",
            time_ns / (len(covered) * costs.samples),
            *colour_errors(seen, truth),
            {"samples": costs.samples},
            speedup=times_ns[0] / time_ns,
            speedup_over=SIMULATION,
            smape=error,
            efficiency=truth_ns / (time_ns * error),
            printed=dict(zip(("time_s", "smape", "efficiency"), printed, strict=False)),
            remark=f"{1e-9 * time_ns:.2f} s, tables filled in {filled_s[name]:.1f} s",
        )


def _ways(
    stack: LayerStack,
    rule: ColourRule,
    facets: StackFacets,
    environment: EnvironmentMap,
    costs: Costs,
) -> tuple[dict[str, Callable[[], Float64]], dict[str, float]]:
    """Return what draws the picture each way, and the seconds that its tables took."""
    sphere, samples = SpherePixels(costs.side), costs.samples
    start = time.perf_counter()
    facets.facet_passage(0, np.ones(1))
    passages_s = time.perf_counter() - start
    tabled = layer_colours(
        MODEL_TABLE, stack, white=_WHITE, parameters={"nodes": costs.cos_nodes, "wavelengths": costs.degree}
    )
    start = time.perf_counter()
    one = np.ones(1)
    for layer in range(len(stack.layers)):
        tabled.reflected(layer, one, one, one)
    tabled.passed(one, one)
    filled_s = {SIMULATION: passages_s, MODEL: passages_s, MODEL_TABLE: time.perf_counter() - start}
    colours: dict[str, LayerColours] = {MODEL: YehModel(facets, rule), MODEL_TABLE: tabled}
    for name, bands in ((BANDS, LAYER_BANDS), (COLOURS, 3)):
        colours[name], filled_s[name] = baked_colours(
            stack, bands, costs.cos_nodes, is_colour=name == COLOURS
        )
    sampler = RingSampler(facets)

    def simulation() -> Float64:
        rng = np.random.default_rng(_SEED)
        return simulated(sphere, facets, rule, environment, samples, rng, max_reflections=1)

    def model(name: str) -> Float64:
        rng = np.random.default_rng(_SEED)
        return modelled(sphere, stack, colours[name], environment, samples, sampler, rng)

    runs: dict[str, Callable[[], Float64]] = {SIMULATION: simulation}
    return runs | {name: partial(model, name) for name in colours}, filled_s
