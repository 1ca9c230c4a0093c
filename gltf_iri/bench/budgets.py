"""Workload `budgets`: whether what a budget chooses keeps it, and is the cheapest way that does.

Random materials, or those of files, are planned for several budgets. What was chosen, and every method that
is cheaper, is then measured anew at other, random points; a chosen table is filled and looked up there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.fill import bake
from gltf_iri.baking.lookup import look_up
from gltf_iri.budgets.candidates import Candidate, direct_candidates, reach_workload, without_film
from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.errors import FilmErrors
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.film_truth import film_truth
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.method import ParameterValue
from gltf_iri.planning.reach import Lobe, Reach, Span
from gltf_iri.planning.way import Way
from gltf_iri.tolerances import GLSL_FILM_DELTA_E

__all__ = [
    "BUDGETS",
    "MATERIALS",
    "BudgetRow",
    "BudgetSum",
    "measure_budgets",
    "random_reaches",
    "reaches_of_file",
]
__all__ += ["summary"]

Float64 = NDArray[np.float64]

BUDGETS: Final = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 1e-3)
MATERIALS: Final = 500
_SEED: Final = 7
_POINTS: Final = 4096
_COLOURS: Final = 640.0 * 480.0

# Costs that are equal but for rounding.
_AS_CHEAP: Final = 1.0 + 1e-9


@dataclass(frozen=True, slots=True)
class BudgetRow:
    """What one budget chose for one material.

    promised, measured : ΔE p95: the bound that was told, and at other points what single precision may add
        included.
    cost_ns : of 640 × 480 pixels; cheapest_ns : of the cheapest of the ways that keep the budget there.
    """

    material: str
    budget: float
    way: str
    promised: float | None
    measured: float | None
    cost_ns: float | None
    cheapest: str
    cheapest_ns: float

    @property
    def holds(self) -> bool:
        """True where the budget is kept; where no way was found, there is nothing that could break it."""
        return self.measured is None or self.measured <= self.budget

    @property
    def is_cheapest(self) -> bool:
        """True where no measured way is cheaper."""
        return self.cost_ns is not None and self.cost_ns <= self.cheapest_ns * _AS_CHEAP

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return {"workload": "budgets", **asdict(self), "holds": self.holds, "is_cheapest": self.is_cheapest}


def measure_budgets(
    reaches: Sequence[tuple[str, Reach]],
    budgets: Sequence[float] = BUDGETS,
    after_material: Callable[[], None] = lambda: None,
) -> Iterator[BudgetRow]:
    """Yield a row for each named reach and budget, for light from one direction in GLSL."""
    for number, (name, reach) in enumerate(reaches):
        truth = _Truth(reach, np.random.default_rng(number))
        errors = FilmErrors(reach, has_image_light=False)
        workloads = [reach_workload(reach, lobe) for lobe in reach.lobes]
        candidates = (without_film("glsl", workloads), *direct_candidates("film", "glsl", workloads))
        for budget in budgets:
            yield _row(name, reach, budget, errors, candidates, truth)
        after_material()


@dataclass(frozen=True, slots=True)
class BudgetSum:
    """What came of one budget: of how many materials which shares kept it, and by the cheapest way.

    worst : the greatest error over the budget.
    """

    budget: float
    materials: int
    kept: float
    cheapest: float
    worst: float


def summary(rows: Sequence[BudgetRow]) -> list[BudgetSum]:
    """Return the sums of each budget."""
    told = []
    for budget in dict.fromkeys(row.budget for row in rows):
        mine = [row for row in rows if row.budget == budget]
        kept, cheapest = (sum(row.holds for row in mine), sum(row.is_cheapest for row in mine))
        worst = max((row.measured or 0.0) for row in mine) / budget
        told.append(BudgetSum(budget, len(mine), kept / len(mine), cheapest / len(mine), worst))
    return told


def random_reaches(count: int = MATERIALS) -> Iterator[tuple[str, Reach]]:
    """Yield `count` materials, drawn one by one, so that fewer begin more of them.

    Three in five are dielectric. The film's index is 1.1–2.2; a fifth of the films is thinner than 100 nm, a
    fifth thicker than 800 nm, up to 5 µm; half have a texture of thicknesses, and of the metals a third one
    of colours.
    """
    g = np.random.default_rng(_SEED)
    for number in range(count):
        film_ior, is_metal = float(g.uniform(1.1, 2.2)), g.uniform() > 0.6
        low, high = ((100.0, 800.0), (1.0, 100.0), (800.0, 5000.0))[int(g.choice(3, p=(0.6, 0.2, 0.2)))]
        thickness = _span(g, low, high, is_point=g.uniform() < 0.5)
        factor = 1.0 if g.uniform() < 0.7 else float(g.uniform(0.05, 1.0))
        base_ior = float(g.uniform(1.3, 2.2))
        f0 = ((base_ior - 1.0) / (base_ior + 1.0)) ** 2
        is_plain = g.uniform() < 0.67
        red, green, blue = (_span(g, 0.2, 1.0, is_point=is_plain) for _ in range(3))
        kind = "metal" if is_metal else "dielectric"
        yield (
            f"random {number}, {kind}",
            Reach(
                film_ior,
                Span.at(factor),
                thickness,
                Span.at(float(is_metal)),
                Span.at(0.5),
                (red, green, blue),
                (Span.at(f0), Span.at(f0), Span.at(f0)),
                is_dielectric_grey=True,
            ),
        )


def reaches_of_file(path: Path) -> Iterator[tuple[str, Reach]]:
    """Yield the materials of a file that have a film, each reach once."""
    from gltf_iri.planning.decide import plan_material
    from gltf_iri.planning.effects import Effect
    from gltf_iri.planning.material_reach import material_reach
    from gltf_iri.planning.simplify import simplified
    from gltf_iri.scene.load import load

    model = load(path)
    seen: set[Reach] = set()
    for index, material in enumerate(model.materials):
        drawn, folded = simplified(material, model.document)
        reach = material_reach(drawn, model.document)
        plan = plan_material(drawn, index, reach=reach, folded=folded)
        if reach is not None and reach not in seen and plan.calls_for(Effect.IRIDESCENCE):
            seen.add(reach)
            yield f"{path.stem} {index} {material.name}".strip(), reach


class _Truth:
    """The truth at random points of every lobe, and what ways err there at p95, the worst lobe."""

    def __init__(self, reach: Reach, g: np.random.Generator) -> None:
        self._reach = reach
        self._films: dict[Lobe, Film] = {}
        self._bare: dict[Lobe, Float64] = {}
        self._truth: dict[Lobe, Float64] = {}
        self._known: dict[str, float] = {}
        for lobe in reach.lobes:
            base_f0 = np.stack([_drawn(g, span) for span in reach.base(lobe)], axis=-1)
            base_f0 = np.repeat(base_f0[:, :1], 3, axis=1) if reach.is_grey(lobe) else base_f0
            cosine = g.uniform(0.0, 1.0, _POINTS)
            film = Film.of(cosine, _drawn(g, reach.thickness_nm), reach.film_ior, base_from_f0(base_f0))
            self._films[lobe] = film
            self._bare[lobe] = f_schlick(base_f0, cosine[:, None])
            # The truth itself where it takes no minutes.
            is_fast = bool(np.all(base_f0 == base_f0[:, :1])) and reach.thickness_nm.high < 1000.0
            self._truth[lobe] = self._on(lobe, film_truth(film, "D65", is_exact=is_fast))

    def of_method(self, method: str | None, parameters: Mapping[str, ParameterValue]) -> float:
        """Return the ΔE of a method, or of no film."""
        key = Way(method, parameters).label
        if key not in self._known and method is None:
            self._known[key] = self._p95(lambda lobe, film: self._bare[lobe])
        elif key not in self._known:
            self._known[key] = self._p95(
                lambda lobe, film: evaluate(str(method), film, parameters=parameters).rgb
            )
        return self._known[key]

    def of_tables(self, tables: Sequence[FilmTable]) -> float:
        """Return the ΔE of colours that are looked up in filled tables."""
        baked = {table.lobe: bake(table) for table in tables}
        return self._p95(
            lambda lobe, film: look_up(
                baked[lobe], film.cos_theta_1, film.thickness_nm, film.base.f0, backend="numpy"
            )
        )

    def _p95(self, colours: Callable[[Lobe, Film], Float64]) -> float:
        worst = 0.0
        for lobe, film in self._films.items():
            found = delta_e_2000(self._on(lobe, colours(lobe, film)), self._truth[lobe])
            worst = max(worst, float(np.percentile(np.where(np.isnan(found), np.inf, found), 95)))
        return worst + GLSL_FILM_DELTA_E

    def _on(self, lobe: Lobe, film: Float64) -> Float64:
        strength = self._reach.factor.high
        return np.asarray((1.0 - strength) * self._bare[lobe] + strength * film)


def _row(
    name: str,
    reach: Reach,
    budget: float,
    errors: FilmErrors,
    candidates: Sequence[Candidate],
    truth: _Truth,
) -> BudgetRow:
    try:
        way = choose_way(reach, Asked(budget, _COLOURS, "glsl"), name, errors).way
    except UsageError:
        best = _cheapest(candidates, truth, budget, np.inf)
        cost = np.inf if best is None else best.ns_per_colour * _COLOURS
        return BudgetRow(name, budget, "none", None, None, None, "none" if best is None else best.label, cost)
    own = way.ns_per_colour * _COLOURS + way.filling_ns
    measured = truth.of_tables(way.tables) if way.tables else truth.of_method(way.method, way.parameters)
    best = _cheapest(candidates, truth, budget, own)
    label, cost = (way.label, own) if best is None else (best.label, best.ns_per_colour * _COLOURS)
    return BudgetRow(name, budget, way.label, way.delta_e, measured, own, label, cost)


def _cheapest(
    candidates: Sequence[Candidate], truth: _Truth, budget: float, below_ns: float
) -> Candidate | None:
    """Return the cheapest that keeps the budget, of those that cost less than `below_ns`."""
    for each in candidates:
        if each.ns_per_colour * _COLOURS * _AS_CHEAP >= below_ns:
            return None
        if truth.of_method(each.method, each.parameters) <= budget:
            return each
    return None


def _span(g: np.random.Generator, low: float, high: float, *, is_point: bool) -> Span:
    ends = sorted(float(end) for end in g.uniform(low, high, 2))
    return Span.at(ends[0]) if is_point else Span(*ends)


def _drawn(g: np.random.Generator, span: Span) -> Float64:
    return np.asarray(g.uniform(span.low, span.high, _POINTS))
