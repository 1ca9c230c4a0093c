"""Workload `layers`, Table 1 of Fourneau et al. 2024: RGB approximations of one rough layer over its spectra.

Printed there: n₁ 1, n₂ 1.5, d₁ = d₂ = Λ/2, and the speed-ups of the basic and the subdivided approximation
for three Λ, "roughly independent of α". Chosen here, because nothing is printed: N 20, as in their Fig. 4;
three α; and the reference's wavelengths, one a nanometre from 360 to 830 nm: the observer's own steps, at
which sharp fringes of 20 cells still err by the ΔE that the reference's own row shows.

What is timed is the whole BRDF (Eq. 17 to 19), masking and facets included, at facets as GGX has them.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend, has_numba
from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import look_up
from gltf_iri.baking.mirror_table import MirrorTable, bake_mirrors
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.layers_rows import LayerRow, colour_errors
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.colour.wavelength_grid import GRID_SAMPLES_MAX, integrate_on_grid
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import facet_weight
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.reach import Span
from gltf_iri.planning.settings import Settings

if TYPE_CHECKING:
    import moderngl

__all__ = ["ALPHAS", "CELLS", "N1", "N2", "PERIODS_NM", "PRINTED", "TABLE", "TABLE1_ROUNDS", "Facets"]
__all__ += ["WAYS", "RoughLayer", "facets_drawn", "measure_table1", "rough_layer", "table1_name"]

Float64 = NDArray[np.float64]

PERIODS_NM: Final = (244.0, 500.0, 988.0)
ALPHAS: Final = (0.025, 0.1, 0.4)
N1: Final = 1.0
N2: Final = 1.5
CELLS: Final = 20
TABLE1_ROUNDS: Final = 5

# Λ → how many times faster than the spectral reference: basic, then s = 2 to 5.
PRINTED: Final = {
    244.0: (10.6, 8.8, 5.5, 4.5, 3.8),
    500.0: (6.8, 5.0, 3.5, 2.6, 2.1),
    988.0: (4.2, 3.8, 3.1, 2.4, 1.7),
}

REFERENCE: Final = "yeh-grid"
TABLE: Final = "table"
COLOUR_TABLE_NODES: Final = 257

# Every way with its parameters, the reference first; the coarse grids are what its speed could be traded for.
WAYS: Final[tuple[tuple[str, Settings], ...]] = (
    (REFERENCE, {"samples": GRID_SAMPLES_MAX}),
    (REFERENCE, {"samples": 121}),
    (REFERENCE, {"samples": 61}),
    ("landmarks", {}),
    *(("landmarks-sub", {"subdivisions": s}) for s in (2, 3, 4, 5)),
    ("bloch", {}),
    (TABLE, {"nodes": COLOUR_TABLE_NODES}),
)

_COUNT: Final = 2048
_SEED: Final = 7


@dataclass(frozen=True, slots=True)
class Facets:
    """Lights, viewers and the facets between them, each (n,), above the horizon."""

    cos_i: Float64
    cos_o: Float64
    cos_h: Float64
    n_cross_h_squared: Float64


@dataclass(frozen=True, slots=True)
class RoughLayer:
    """One layer of Table 1 at its facets, with its true colours (n, 3), and filled as a table."""

    period_nm: float
    alpha: float
    facets: Facets
    mirror: Mirror
    truth: Float64
    table: BakedTable

    def colour(self, method: str, parameters: Settings, backend: Backend) -> Float64:
        """Return the reflectance colours (n, 3) of the facets."""
        if method == TABLE:
            return look_up(self.table, self.facets.cos_h, 0.0, np.zeros(3), backend=backend)
        if method == REFERENCE and backend == "numba":
            return self._compiled_grid(int(parameters["samples"]))
        return evaluate(method, self.mirror, white=WHITE, backend=backend, parameters=parameters).rgb

    def _compiled_grid(self, samples: int) -> Float64:
        half = np.array([[0.5 * self.period_nm]])

        def reflectance(rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
            cosine = self.facets.cos_h[rows, None]
            arguments = (N1, N1, N2, half, half, CELLS, wavelength_nm, cosine)
            return bragg_reflectance(*arguments, backend="numba")

        return integrate_on_grid(reflectance, len(self.facets.cos_h), samples, white=WHITE)

    def brdf(self, method: str, parameters: Settings, backend: Backend) -> Float64:
        """Return f_r (n, 3), 1/sr, of Eq. 17."""
        at = self.facets
        weight = facet_weight(at.n_cross_h_squared, at.cos_i, at.cos_o, self.alpha)
        return np.asarray(weight[:, None] * self.colour(method, parameters, backend))


def table1_name(period_nm: float, alpha: float) -> str:
    """Return how rows call a layer: "table 1: 244 nm, α 0.1"."""
    return f"table 1: {period_nm:g} nm, α {alpha:g}"


def facets_drawn(alpha: float, count: int) -> Facets:
    """Return facets drawn by D(h) cosθ_h, tan²θ_h = α²u/(1 − u), seen from uniform cosθ_o, that mirror light.

    Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", Eq. 35 and 36.
    """
    g = np.random.default_rng(_SEED)
    columns: list[Float64] = []
    while sum(part.shape[1] for part in columns) < count:
        cos_o, u, phi = g.uniform(0.05, 1.0, count), g.random(count), g.uniform(0.0, 2.0 * np.pi, count)
        tangent_squared = alpha * alpha * u / (1.0 - u)
        cos_n = 1.0 / np.sqrt(1.0 + tangent_squared)
        sine_squared = tangent_squared / (1.0 + tangent_squared)
        cos_h = cos_o * cos_n + np.sqrt((1.0 - cos_o**2) * sine_squared) * np.cos(phi)
        cos_i = 2.0 * cos_h * cos_n - cos_o
        seen = (cos_h > 0.0) & (cos_i > 0.0)
        columns.append(np.stack([cos_i, cos_o, np.minimum(cos_h, 1.0), sine_squared])[:, seen])
    return Facets(*np.concatenate(columns, axis=1)[:, :count])


def rough_layer(period_nm: float, alpha: float, count: int = _COUNT) -> RoughLayer:
    """Return the layer of period Λ at `count` facets, its truth and its table."""
    half = 0.5 * period_nm
    facets = facets_drawn(alpha, count)
    mirror = Mirror.of(facets.cos_h, N1, N2, half, half, CELLS)
    return RoughLayer(
        period_nm,
        alpha,
        facets,
        mirror,
        evaluate("yeh-spectral", mirror, white=WHITE, backend="numpy").rgb,
        _table(period_nm),
    )


@functools.cache
def _table(period_nm: float) -> BakedTable:
    half = np.array([0.5 * period_nm])
    mirrors = Mirror.of(1.0, N1, N2, half, half, CELLS)
    texels = bake_mirrors(MirrorTable(COLOUR_TABLE_NODES), mirrors, WHITE).texels[0]
    axis = TableAxis("cos_theta", Span(0.0, 1.0), COLOUR_TABLE_NODES)
    # A look-up along the cosine does not know what was baked: films' is compiled, and has a twin in OpenGL.
    shape = FilmTable("dielectric", 1.0, 0.0, (0.0, 0.0, 0.0), (axis,), "f4", 0.0)
    return BakedTable(shape, texels, WHITE, 0.0, is_cached=False)


def measure_table1(
    context: moderngl.Context | None,
    rounds: int = TABLE1_ROUNDS,
    after_layer: Callable[[], None] = lambda: None,
    *,
    alphas: Sequence[float] = ALPHAS,
    count: int = _COUNT,
    side: int = 256,
) -> list[LayerRow]:
    """Return a row for each Λ, α, backend and way; OpenGL's where there is a context.

    count : facets of each layer; side : OpenGL draws side² of them at once.
    """
    rows: list[LayerRow] = []
    for period_nm in PERIODS_NM:
        for alpha in alphas:
            layer = rough_layer(period_nm, alpha, count)
            for backend in ("numpy", "numba") if has_numba() else ("numpy",):
                rows += _with_speedups(_rows(layer, backend, rounds))
            if context is not None:
                from gltf_iri.bench.layers_table1_glsl import glsl_rows

                rows += _with_speedups(glsl_rows(context, layer, rounds, side))
            after_layer()
    return rows


def _rows(layer: RoughLayer, backend: Backend, rounds: int) -> Iterator[LayerRow]:
    ways = [(name, chosen) for name, chosen in WAYS if _has(name, backend)]
    colours = [layer.colour(name, chosen, backend) for name, chosen in ways]  # compiles
    runs = [functools.partial(layer.brdf, name, chosen, backend) for name, chosen in ways]
    times_ns = interleaved_ns(runs, rounds)
    for (name, chosen), rgb, time_ns in zip(ways, colours, times_ns, strict=True):
        errors = colour_errors(rgb, layer.truth)
        workload = table1_name(layer.period_nm, layer.alpha)
        yield LayerRow(workload, name, backend, time_ns / len(rgb), *errors, chosen)


def _has(method: str, backend: Backend) -> bool:
    return method in (TABLE, REFERENCE) or backend in METHODS[method].backends


def _with_speedups(rows: Iterator[LayerRow]) -> Iterator[LayerRow]:
    """Yield rows of one layer and backend, of which the first is the reference, with their speed-ups."""
    reference: LayerRow | None = None
    for row in rows:
        reference = reference or row
        yield replace(
            row,
            speedup=reference.ns_per_eval / row.ns_per_eval,
            speedup_over=reference.label,
            printed=_printed(row),
        )


def _printed(row: LayerRow) -> dict[str, float]:
    if row.method not in ("landmarks", "landmarks-sub"):
        return {}
    period_nm = next(each for each in PERIODS_NM if row.workload.startswith(f"table 1: {each:g} nm"))
    s = row.parameters.get("subdivisions", 1)
    return {"speedup": PRINTED[period_nm][int(s) - 1]}
