"""Which axes a material's table needs, and how finely each is divided, so that it keeps a budget.

Measured, not guessed: what each axis errs at a first guess from the fringes, scaled by the square of its
cells, says which smallest table keeps four fifths of the budget; measured anew there, until it stays. Then
the whole interpolation is held against the truth at other places.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.table_errors import AxisErrors, Judged, p95_below
from gltf_iri.baking.table_values import Places, TableValues
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.facet_mean import mean_cosine
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.planning.film_table import FilmTable, TableAxis, Texel, texel_bytes
from gltf_iri.planning.reach import Lobe, Reach, Span

__all__ = ["BYTES_MAX", "fit_table"]

Float64 = NDArray[np.float64]

BYTES_MAX: Final = 16 << 20
_AXES_MAX: Final = 4

_AIMED_AT: Final = 0.8  # of the budget
_ROUNDING_SHARE: Final = 0.2  # of the budget, that half precision may take
_LEFT_OUT_SHARE: Final = 0.3  # of the budget, below which an axis is not worth its texels

# Random places: films, and for means over facets sides from which each is seen.
_MEASURED: Final = {False: (384, 1), True: (16, 24)}
_CHECKED: Final = {False: (1024, 1), True: (32, 24)}
_SERIES_BUDGET: Final = 0.003  # from which the series stands for the truth, which it keeps to 5e-5
_FACTORS: Final = (1.5, 1.2, 1.05)
_ROUNDS: Final = 4
_CHECKS: Final = 5

_NODES_MAX: Final = 4096
_DOUBTFUL: Final = 2.0  # a first guess may ask for more than is wanted in the end

_ZERO: Final = Span.at(0.0)


def fit_table(
    reach: Reach,
    lobe: Lobe,
    budget: float,
    *,
    white: White = "D65",
    has_image_light: bool,
    has_spread: bool,
    bare_at_grazing: float = 1.0,
) -> FilmTable | None:
    """Return the smallest table found that keeps `budget`; None where none up to BYTES_MAX does.

    `delta_e` of the table is a number that the p95 of CIEDE2000 against the truth lies below, as 1024 random
    places tell: of light from one direction, of its mean over facets, and with a spread.

    Parameters
    ----------
    budget : CIEDE2000, > 0; raises UsageError for others.
    has_image_light : whether means over facets count.
    has_spread : whether the thickness is averaged within a pixel.
    bare_at_grazing : what the dielectric without its film reflects at grazing angles: its specular weight.
    """
    if not budget > 0.0:
        raise UsageError("A table errs: its budget must be greater than 0.")
    fit = _Fit(reach, lobe, budget, white, has_image_light, has_spread, bare_at_grazing)
    axes = fit.axes()
    return None if axes is None else fit.checked(*axes)


@dataclass(slots=True)
class _Fit:
    """The search for one lobe's table."""

    reach: Reach
    lobe: Lobe
    budget: float
    white: White
    has_image_light: bool
    has_spread: bool
    bare_at_grazing: float

    def axes(self) -> tuple[tuple[TableAxis, ...], Texel] | None:
        """Return the axes that the places of the first kind ask for; None where the table is too large."""
        values = self._values()
        axes = self._quantities(values)
        judged = self._judged(axes, values, _MEASURED, seed=1)
        rounding = judged[0].rounding()
        texel: Texel = "f2" if rounding <= _ROUNDING_SHARE * self.budget else "f4"
        target = _AIMED_AT * self.budget - (rounding if texel == "f2" else 0.0)
        for _ in range(_ROUNDS):
            errors = [each.axis_errors(axes) for each in judged]
            nodes = _smallest(errors, [axis.nodes for axis in axes], target)
            if nodes is None:
                return None
            before, axes = axes, tuple(replace(a, nodes=n) for a, n in zip(axes, nodes, strict=True))
            if all(abs(a.nodes - b.nodes) <= 1 + b.nodes // 12 for a, b in zip(axes, before, strict=True)):
                break
        return axes, texel

    def checked(self, axes: tuple[TableAxis, ...], texel: Texel) -> FilmTable | None:
        """Return the table, finer where other places ask for it; None where it would be too large."""
        judged = self._judged(axes, self._values(), _CHECKED, seed=2)
        for _ in range(_CHECKS):
            table = self._table(axes, texel)
            if table.bytes > BYTES_MAX:
                return None
            delta_e = max(p95_below(each.whole_errors(axes, texel)) for each in judged)
            if delta_e <= self.budget:
                return replace(table, delta_e=delta_e)
            finer = 1.05 * math.sqrt(delta_e / (_AIMED_AT * self.budget))
            axes = tuple(replace(a, nodes=1 + math.ceil((a.nodes - 1) * finer)) for a in axes)
        return None

    def _values(self) -> TableValues:
        # A channel's 1e-5 is CIEDE2000 of about 0.01 in dark colours.
        is_exact = self.budget < _SERIES_BUDGET
        max_error = min(1e-4, 1e-4 * self.budget)
        return TableValues(self.reach.film_ior, self.white, is_exact=is_exact, facet_max_error=max_error)

    def _table(self, axes: tuple[TableAxis, ...], texel: Texel) -> FilmTable:
        bases = self.reach.base(self.lobe)
        r, g, b = (span.low for span in bases)
        return FilmTable(
            self.lobe, self.reach.film_ior, self.reach.thickness_nm.low, (r, g, b), axes, texel, 0.0
        )

    def _quantities(self, values: TableValues) -> tuple[TableAxis, ...]:
        """Return the axes that the table needs, with first guesses of their nodes."""
        reach, bases = self.reach, self.reach.base(self.lobe)
        # Half a fringe at 550 nm is worth some cells; errors go with their square.
        cells = 4.0 * math.sqrt(0.5 / self.budget)
        paths = (
            2.0 * reach.film_ior * nm / 550.0 for nm in (reach.thickness_nm.low, reach.thickness_nm.high)
        )
        thin, thick = paths
        turned = 1.0 - math.sqrt(max(0.0, 1.0 - 1.0 / max(reach.film_ior, 1.0) ** 2))
        axes = [TableAxis("cos_theta", Span(0.0, 1.0), _nodes(cells * (2.0 + 2.0 * thick * turned)))]
        if not reach.thickness_nm.is_point:
            axes.append(TableAxis("thickness_nm", reach.thickness_nm, _nodes(2.0 * cells * (thick - thin))))
        if not all(span.is_point for span in bases):
            base = Span(min(span.low for span in bases), max(span.high for span in bases))
            axes.append(TableAxis("base_f0", base, _nodes(cells)))
        spread = self._spread_axis(values, cells) if self._has_spread() else ()
        rough = self._roughness_axis(values, cells) if self._sees_facets() else ()
        if len(axes) + len(rough) + len(spread) > _AXES_MAX:
            # Textures rarely spread far within a pixel; facets do wherever there is roughness.
            spread = ()
        return (*axes, *rough, *spread)

    def _has_spread(self) -> bool:
        return self.has_spread and self.reach.spread_nm.high > 0.0

    def _sees_facets(self) -> bool:
        return self.has_image_light and self.reach.roughness.high > 0.0

    def _roughness_axis(self, values: TableValues, cells: float) -> tuple[TableAxis, ...]:
        _, facets, *_ = self._judged((), values, _MEASURED, seed=1)
        if p95_below(facets.delta_e(facets.at_best)) <= _LEFT_OUT_SHARE * self.budget:
            return ()
        return (TableAxis("roughness", Span(0.0, self.reach.roughness.high), _nodes(cells)),)

    def _spread_axis(self, values: TableValues, cells: float) -> tuple[TableAxis, ...]:
        changed = self._judged_spread(values, _MEASURED[False], np.random.default_rng(3), has_axis=False)
        if p95_below(changed.delta_e(changed.at_best)) <= _LEFT_OUT_SHARE * self.budget:
            return ()
        return (TableAxis("spread_nm", Span(0.0, self.reach.spread_nm.high), _nodes(cells)),)

    def _judged_spread(
        self, values: TableValues, size: tuple[int, int], g: np.random.Generator, *, has_axis: bool
    ) -> Judged:
        """Return places with a spread: up to the greatest along an axis of it, else up to what is usual."""
        span = self.reach.spread_nm
        places = self._places(size, g, spread_nm=span.high if has_axis else span.low)
        read = places if has_axis else places.moved({"spread_nm": np.zeros_like(places.spread_nm)})
        return self._judge(values, read, places)

    def _judged(
        self, axes: Sequence[TableAxis], values: TableValues, sizes: dict[bool, tuple[int, int]], seed: int
    ) -> list[Judged]:
        """Return places of every light that counts: one direction first, all around, with a spread."""
        g = np.random.default_rng(seed)
        quantities = {axis.quantity for axis in axes}
        one_way = self._places(sizes[False], g)
        judged = [self._judge(values, one_way, one_way)]
        if self._sees_facets():
            seen = read = self._places(sizes[True], g, roughness=self.reach.roughness)
            if "roughness" not in quantities:
                mean = mean_cosine(seen.cos_theta, seen.roughness)
                read = seen.moved({"cos_theta": mean, "roughness": np.zeros_like(mean)})
            judged.append(self._judge(values, read, seen))
        if self._has_spread():
            judged.append(self._judged_spread(values, sizes[False], g, has_axis="spread_nm" in quantities))
        return judged

    def _judge(self, values: TableValues, read: Places, true: Places) -> Judged:
        return Judged(values, read, values(true), self._bare(true), self.reach.factor.high)

    def _bare(self, places: Places) -> Float64:
        """Return what the surface without a film reflects, (n, m, 3): where there are facets, their mean."""
        grazing = f_schlick(0.0, places.cos_theta)
        if places.roughness.any():
            a, b = dfg_terms(places.cos_theta, places.roughness)
            grazing = np.where(places.roughness > 0.0, b / (a + b), grazing)
        # base_f0 has the weight in it: weight · Schlick(F0) reaches the weight.
        most = self.bare_at_grazing if self.lobe == "dielectric" else 1.0
        base, grazing = places.base_f0[:, None], grazing[..., None]
        return np.asarray(base + (most - base) * grazing)

    def _places(
        self,
        size: tuple[int, int],
        g: np.random.Generator,
        *,
        roughness: Span = _ZERO,
        spread_nm: float = 0.0,
    ) -> Places:
        films = (size[0], 1)
        bases = self.reach.base(self.lobe)
        drawn = g.uniform(size=(size[0], 1 if self.reach.is_grey(self.lobe) else 3))
        low, high = (np.array([getattr(span, end) for span in bases]) for end in ("low", "high"))
        return Places(
            cos_theta=g.uniform(size=size),
            thickness_nm=_within(self.reach.thickness_nm, g.uniform(size=films)),
            base_f0=low + (high - low) * drawn,
            roughness=_within(roughness, g.uniform(size=size)),
            spread_nm=spread_nm * g.uniform(size=films),
        )


def _within(span: Span, share: Float64) -> Float64:
    return span.low + (span.high - span.low) * share


def _nodes(cells: float) -> int:
    return min(max(2, 1 + math.ceil(cells)), 512)


def _smallest(errors: Sequence[AxisErrors], nodes: Sequence[int], target: float) -> list[int] | None:
    """Return the nodes of the smallest table whose p95 is `target`; None where no table below BYTES_MAX is.

    Errors of several axes may cancel, so that one axis made finer alone makes them worse: all grow together
    first, then each shrinks as far as the others allow, and trades its cells for fewer of another.
    """

    def keeps(cells: Sequence[float]) -> bool:
        finer = [(n - 1) / c for n, c in zip(nodes, cells, strict=True)]
        return max(each.p95_below(finer) for each in errors) <= target

    cells: list[float] = [n - 1.0 for n in nodes]
    while not keeps(cells):
        if math.prod(c + 1.0 for c in cells) * texel_bytes("f2") > BYTES_MAX * _DOUBTFUL:
            return None
        cells = [1.1 * c for c in cells]
    for factor in _FACTORS:
        is_shrinking = True
        while is_shrinking:
            is_shrinking = False
            for changes in _changes(len(cells), factor):
                fewer = [max(1.0, c * change) for c, change in zip(cells, changes, strict=True)]
                if math.prod(fewer) < 0.99 * math.prod(cells) and keeps(fewer):
                    cells, is_shrinking = fewer, True
    return [min(1 + math.ceil(c), _NODES_MAX) for c in cells]


def _changes(axes: int, factor: float) -> list[list[float]]:
    """Return factors of the cells: fewer of one axis, or more of one for yet fewer of another."""
    changes = [[1.0 / factor if k == i else 1.0 for k in range(axes)] for i in range(axes)]
    for more, less in permutations(range(axes), 2):
        changes.append([1.0] * axes)
        changes[-1][more], changes[-1][less] = factor, factor**-1.5
    return changes
