"""Workload `layers-agreement`: colours of rough Bragg layers, GLSL's against Python's by the same rules.

The rules are those that shaders of `layers-single` sum by: all wavelengths for what is reflected, each
fourth for what passes, FILTER_POINTS angles a panel of the filter. Python has them in float64.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.layers_cases import random_case
from gltf_iri.bench.layers_fixed import FixedRules, colours_and_brdf, errors_of, glsl_colours, moved_by_steps
from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, colour_rule
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.optics_tables import SPECTRAL_COARSE_DEGREE, optics_table
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_LAYERS_MAX_ABS

if TYPE_CHECKING:
    import moderngl

__all__ = ["AGREEMENT_COUNTS", "AgreementRow", "agreement_steps", "measure_agreement"]

# Stacks of one and of two layers; those of tests/agreement, where each channel has one wavelength.
AGREEMENT_COUNTS: Final = {1: 100_000, 2: 10_000}

_CELLS_MAX: Final = 30
_DRAWN: Final = 10_000  # of a seed
_ROWS: Final = 1000  # at once: Python holds spectra at 72 angles of each


@dataclass(frozen=True, slots=True)
class AgreementRow:
    """How far one colour of stacks of so many layers is off in GLSL; f_r relative to max(1, f_r).

    beyond : stacks that are further off than `tolerance`; beyond_steps : also by more than that beyond what
    four float32 steps of thicknesses, cosines or facets' angles move the colour by in float64.
    """

    workload: str
    method: str
    backend: str
    layers: int
    colour: str
    count: int
    max_abs: float
    p9999: float
    p99: float
    tolerance: float
    beyond: int
    beyond_steps: int

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return {**asdict(self), "ns_per_eval": None, "delta_e_mean": None, "delta_e_p95": None}


def agreement_steps(counts: dict[int, int] = AGREEMENT_COUNTS) -> int:
    """Return how often `measure_agreement` tells of its progress."""
    return sum(-(-count // _ROWS) for count in counts.values())


def measure_agreement(
    context: moderngl.Context,
    counts: dict[int, int] = AGREEMENT_COUNTS,
    after_chunk: Callable[[], None] = lambda: None,
) -> list[AgreementRow]:
    """Return a row for each colour of stacks of one layer and of two: reflected, passed, and f_r.

    counts : number of layers → how many stacks, of 1 to 30 cells.
    """
    probe = Probe(context)
    rules = colour_rule(SPECTRAL_COARSE_DEGREE, WHITE), colour_rule(SPECTRAL_DEGREE, WHITE)
    tables = {"spectral_rule": optics_table("spectral_rule", WHITE, {})}
    rows = []
    for layers, count in counts.items():
        errors, unexplained = [], []
        for start in range(0, count, _ROWS):
            drawn = random_case(_DRAWN, layers, start // _DRAWN, cells_max=_CELLS_MAX)
            first = start % _DRAWN
            case = drawn.rows(np.arange(first, first + min(_ROWS, count - start)))
            truth = colours_and_brdf(case, FixedRules(case.stack, *rules))
            error = errors_of(glsl_colours(probe, case, "optics/layers_single.glsl", tables), truth)
            chosen = np.flatnonzero((error > GLSL_LAYERS_MAX_ABS).any(axis=0))
            moved = moved_by_steps(case.rows(chosen), rules, [each[chosen] for each in truth])
            errors.append(error)
            unexplained.append(error[:, chosen] - moved > GLSL_LAYERS_MAX_ABS)
            after_chunk()
        names = [*(f"reflected by layer {k + 1}" for k in range(layers)), "passed", "f_r"]
        every, left = np.concatenate(errors, axis=1), np.concatenate(unexplained, axis=1)
        for name, of_name, beyond_steps in zip(names, every, left, strict=True):
            rows.append(
                AgreementRow(
                    "layers-agreement",
                    "layers-single",
                    renderer_name(context),
                    layers,
                    name,
                    count,
                    float(of_name.max()),
                    float(np.quantile(of_name, 0.9999)),
                    float(np.quantile(of_name, 0.99)),
                    GLSL_LAYERS_MAX_ABS,
                    int(np.count_nonzero(of_name > GLSL_LAYERS_MAX_ABS)),
                    int(np.count_nonzero(beyond_steps)),
                )
            )
    return rows
