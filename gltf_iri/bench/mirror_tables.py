"""Baked mirrors on the map of cost and error: a few of each set, in tables over the cosine."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import look_up
from gltf_iri.baking.mirror_table import MirrorTable, bake_mirrors
from gltf_iri.bench.accuracy_tables import Tables, table_label
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.film_table import FilmTable, TableAxis, Texel
from gltf_iri.planning.reach import Span
from gltf_iri.planning.way import look_up_key

__all__ = ["mirror_tables"]

_SEED: Final = 5
_POINTS: Final = 300
_TEXELS: Final[tuple[Texel, ...]] = ("f2", "f4")

# Nodes of the finest table; of coarser ones every second, fourth, … is a node.
_FINEST: Final = 1025
_STEPS: Final = (32, 16, 8, 4, 2, 1)

# As in the sets, where grazing light is left out.
_COSINES: Final = Span(0.1, 1.0)

# How many have tables: filling takes up to ten seconds each.
_COUNTS: Final = ((5, 8), (10, 4), (50, 3))
_FEWEST: Final = 2


def mirror_tables(mirrors: Mirror) -> Iterator[Tables]:
    """Yield tables of the first of `mirrors` (n,), each at points of its own.

    The finest is filled; every coarser one holds some of its nodes, at that share of its filling.
    """
    cells = int(mirrors.cells.max())
    count = min(next((few for most, few in _COUNTS if cells <= most), _FEWEST), len(mirrors.d1_nm))
    first = _first(mirrors, count)
    g = np.random.default_rng(_SEED)
    cosine = g.uniform(_COSINES.low, _COSINES.high, (count, _POINTS // count))
    truth = evaluate("yeh-spectral", _at(first, cosine), white=WHITE, backend="numpy").rgb.reshape(-1, 3)
    start = time.perf_counter()
    finest = bake_mirrors(MirrorTable(_FINEST), first, WHITE)
    filling_ns = 1e9 * (time.perf_counter() - start) / count
    for step in _STEPS:
        for texel in _TEXELS:
            texels = finest.texels[:, ::step]
            yield _entry(texels, texel, cosine, truth, filling_ns * texels.shape[1] / _FINEST)


def _entry(
    texels: NDArray[np.floating[Any]],
    texel: Texel,
    cosine: NDArray[np.float64],
    truth: NDArray[np.float64],
    filling_ns: float,
) -> Tables:
    # A look-up along the cosine does not know what was baked: films' is compiled, and has a twin in OpenGL.
    axis = TableAxis("cos_theta", Span(0.0, 1.0), texels.shape[1])
    table = FilmTable("dielectric", 1.0, 0.0, (0.0, 0.0, 0.0), (axis,), texel, 0.0)
    baked = [
        BakedTable(table, np.asarray(each, dtype=texel), WHITE, filling_ns / 1e9, is_cached=False)
        for each in texels
    ]
    black = np.zeros(3)

    def colours(backend: str) -> NDArray[np.float64]:
        pairs = zip(baked, cosine, strict=True)
        return np.concatenate([look_up(each, at, 0.0, black, backend=backend) for each, at in pairs])

    return Tables(
        table_label(table),
        look_up_key(1),
        colours,
        lambda backend: look_up(baked[0], cosine.reshape(-1), 0.0, black, backend=backend),
        truth,
        filling_ns,
        tuple(baked),
        tuple(cosine),
    )


def _first(mirrors: Mirror, count: int) -> Mirror:
    whole = (mirrors.cos_theta_h, mirrors.n1, mirrors.n2, mirrors.d1_nm, mirrors.d2_nm, mirrors.cells)
    columns = [np.broadcast_to(each, mirrors.shape)[:count] for each in (*whole, mirrors.host_ior)]
    return Mirror.of(*columns)


def _at(mirrors: Mirror, cosine: NDArray[np.float64]) -> Mirror:
    columns = (mirrors.n1, mirrors.n2, mirrors.d1_nm, mirrors.d2_nm, mirrors.cells, mirrors.host_ior)
    return Mirror.of(cosine, *(each[:, None] for each in columns))
