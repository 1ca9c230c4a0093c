"""Baked tables on the map of cost and error: of several sizes, filled from the truth, each film its own.

A table holds one film, a set many: some films of a set have tables, and each is asked at many points of what
the set reaches. Errors are of all points, the time of a look-up is that of the first film's table at them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.fill import bake
from gltf_iri.baking.lookup import look_up
from gltf_iri.bench.accuracy_row import Errors, errors_of
from gltf_iri.bench.accuracy_sets import METAL_F0, THICK_NM, THIN_NM
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.film_parts import FilmPart, film_of, point_parts, points_of, table_of, varied
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.film_table import FilmTable, Quantity, TableAxis, Texel
from gltf_iri.planning.reach import Lobe, Span
from gltf_iri.planning.way import look_up_key

__all__ = ["Tables", "film_entry", "film_tables", "look_ups", "set_parts", "table_label"]

Float64 = NDArray[np.float64]

_SEED: Final = 3
_POINTS: Final = 1200
_TEXELS: Final[tuple[Texel, ...]] = ("f2", "f4")

# Grazing light is left out as it is from the sets.
_COSINES: Final = Span(0.05, 1.0)

_ALONG_COSINES: Final = (16, 32, 64, 128, 256, 512, 1024)
# Nodes along cosθ, thickness and base where two or three of them vary.
_ALONG_MORE: Final = ((16, 32, 8), (32, 64, 8), (64, 128, 16), (128, 256, 32), (256, 512, 64))
_FILLING_S: Final = 8.0  # for all tables of a size; the whole map has minutes


@dataclass(frozen=True, slots=True)
class Tables:
    """Tables of one size, filled.

    colours : backend → the colours (n, 3) of all points, each out of its own table.
    timed : backend → as many colours out of the first table alone.
    truth : the true colours (n, 3) of all points; None where only the time is of interest.
    filling_ns : of one table; None where nothing filled it.
    baked, points : what OpenGL is asked, too; of each table a film, or the cosines (p,) of a mirror.
    """

    label: str
    way: str
    colours: Callable[[str], Float64]
    timed: Callable[[str], Float64]
    truth: Float64 | None
    filling_ns: float | None
    baked: tuple[BakedTable, ...] = ()
    points: tuple[Any, ...] = ()

    def errors(self, rgb: NDArray[np.floating[Any]]) -> Errors | None:
        """Return the errors of what `colours` returned, on whatever device."""
        return None if self.truth is None else errors_of(rgb, self.truth)


def film_entry(
    baked: Sequence[BakedTable], points: Sequence[Film], truth: Float64 | None, filling_ns: float | None
) -> Tables:
    """Return filled tables of one size, each film with its points."""
    everywhere = film_of(points)

    def colours(backend: str) -> Float64:
        pairs = zip(baked, points, strict=True)
        return np.concatenate([_looked_up(table, film, backend) for table, film in pairs])

    return Tables(
        table_label(baked[0].table),
        look_up_key(len(baked[0].table.axes)),
        colours,
        lambda backend: _looked_up(baked[0], everywhere, backend),
        truth,
        filling_ns,
        tuple(baked),
        tuple(points),
    )


def _looked_up(baked: BakedTable, film: Film, backend: str) -> Float64:
    """Return the colours of `film` (n, 3) out of its table."""
    return look_up(baked, film.cos_theta_1, film.thickness_nm, film.base.f0, backend=backend)


def set_parts(workload: str, film: Film) -> list[list[FilmPart]]:
    """Return the films of a set that have tables, a list for each choice of what varies beside the angle."""
    if workload == "metals":
        alone = point_parts(film, "metal", 12)
        base = [varied(part, base_f0=METAL_F0) for part in alone[:8]]
        both = [varied(part, thickness_nm=THIN_NM, base_f0=METAL_F0) for part in alone[:4]]
        return [alone, base, both]
    alone = point_parts(film, "dielectric", 8 if workload == "thick" else 24)
    spans = THICK_NM if workload == "thick" else THIN_NM
    # The fringes of all thicknesses up to 10 µm want more texels than a film's own.
    return [alone] if spans is THICK_NM else [alone, [varied(part, thickness_nm=spans) for part in alone[:8]]]


def film_tables(parts: Sequence[FilmPart]) -> Iterator[Tables]:
    """Yield tables of every size and texel for `parts`, each filled once a size, until they take too long.

    Every part's table has axes along what varies in it; the look-up that is timed is that of the widest.
    """
    g = np.random.default_rng(_SEED)
    widest_first = sorted(parts, key=lambda part: -len(part.varying))
    count = max(1, _POINTS // len(parts))
    points = [points_of(part, count, g, _COSINES) for part in widest_first]
    start = time.process_time()  # what else runs must not decide how far sizes go
    truth = evaluate("spectral", film_of(points), white=WHITE, backend="numpy").rgb
    colour_s = (time.process_time() - start) / len(truth)
    for nodes in _sizes(widest_first[0].varying):
        empty = [table_of(part, nodes, "f4") for part in widest_first]
        if colour_s * sum(math.prod(table.shape) for table in empty) > _FILLING_S:
            break
        filled = [bake(table, WHITE) for table in empty]
        filling_ns = 1e9 * float(np.mean([each.filled_in_s for each in filled]))
        for texel in _TEXELS:
            yield film_entry([_with_texel(each, texel) for each in filled], points, truth, filling_ns)


def look_ups(film: Film, lobe: Lobe) -> Iterator[Tables]:
    """Yield tables of one to four axes that nothing fills: only their look-ups are of interest."""
    g = np.random.default_rng(_SEED)
    part = varied(point_parts(film, lobe, 1)[0], thickness_nm=THIN_NM, base_f0=METAL_F0)
    nodes: dict[Quantity, int] = {"cos_theta": 64, "thickness_nm": 64, "base_f0": 16, "roughness": 8}
    whole = table_of(part, nodes, "f2")
    roughness = TableAxis("roughness", Span(0.0, 1.0), nodes["roughness"])
    spread_nm = TableAxis("spread_nm", Span(0.0, 50.0), 8)
    cos_theta, thickness_nm, base_f0 = whole.axes
    # A base is read once a channel: for films on grey bases no axis of it may be timed.
    third, fourth = (base_f0, roughness) if lobe == "metal" else (roughness, spread_nm)
    for axes in (
        (cos_theta,),
        (cos_theta, thickness_nm),
        (cos_theta, thickness_nm, third),
        (cos_theta, thickness_nm, third, fourth),
    ):
        table = replace(whole, axes=axes)
        texels = g.random((*table.shape, 3)).astype(np.float16)
        baked = BakedTable(table, texels, WHITE, 0.0, is_cached=False)
        alone = film_entry([baked], [film], None, None)
        yield replace(alone, label=alone.label.replace("table", "look-up alone", 1))


def table_label(table: FilmTable) -> str:
    """Return what people read for a table: "table: cos_theta 64, thickness_nm 128, RGBA16F"."""
    axes = ", ".join(f"{axis.quantity} {axis.nodes}" for axis in table.axes)
    return f"table: {axes}, {table.format}"


def _sizes(varying: Sequence[Quantity]) -> Iterator[Mapping[Quantity, int]]:
    if len(varying) == 1:
        for count in _ALONG_COSINES:
            yield {"cos_theta": count}
        return
    for cos_theta, thickness_nm, base_f0 in _ALONG_MORE:
        yield {"cos_theta": cos_theta, "thickness_nm": thickness_nm, "base_f0": base_f0}


def _with_texel(baked: BakedTable, texel: Texel) -> BakedTable:
    texels: NDArray[np.floating[Any]] = (
        baked.texels.astype(np.float16) if texel == "f2" else baked.texels.astype(np.float32)
    )
    return replace(baked, table=replace(baked.table, texel=texel), texels=texels)
