"""The cheapest of many ways that keeps a budget: asked for their errors one by one, from the cheapest on."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from gltf_iri.budgets.candidates import Candidate
from gltf_iri.budgets.errors import Measured
from gltf_iri.errors import UsageError
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.way import Way

__all__ = ["Chosen", "TableOffer", "UnkeptBudgetError", "cheapest_way", "check_budget", "figure", "the_truth"]

# Where no table keeps the budget, the least that one does is bracketed: to this ratio, and not below this
# share of what methods reach, where tables are slow to fit.
_BRACKET: Final = 1.25
_LEAST_SHARE: Final = 2.0**-12


@dataclass(frozen=True, slots=True)
class Chosen:
    """A way, and in words with numbers why it was chosen."""

    way: Way
    reason: str


@dataclass(frozen=True, slots=True)
class TableOffer:
    """Tables as one more way, whose shape is not known before it is asked for.

    ns_at_least : what a colour costs out of the smallest that could do.
    fit : maps a budget to the way by tables that keeps it, with its cost and error; None where none does.
    """

    ns_at_least: float
    fit: Callable[[float], Way | None]


class UnkeptBudgetError(UsageError):
    """Nothing keeps a budget for one subject; others may be as they are.

    delta_e : the least that its p95 is known to be by any way; None where nobody could say.
    """

    def __init__(self, what: str, subject: str, why: str, delta_e: float | None = None) -> None:
        self.what, self.why, self.delta_e = what, why, delta_e
        super().__init__(f"{what} for {subject}: {why}")

    def of(self, subject: str) -> UnkeptBudgetError:
        """Return the same of another subject."""
        return UnkeptBudgetError(self.what, subject, self.why, self.delta_e)


def check_budget(budget: float) -> float:
    """Return `budget`; UsageError where it is no finite number of 0 or more."""
    if not 0.0 <= budget < math.inf:
        raise UsageError(f"A budget is a ΔE of 0 or more, not {budget:g}; 0 asks for the truth itself.")
    return float(budget)


def cheapest_way(
    candidates: Sequence[Candidate],
    measure: Callable[[Candidate, float], Measured],
    budget: float,
    colours: float,
    *,
    subject: str,
    tables: TableOffer | None = None,
) -> Chosen:
    """Return the way of least cost for so many `colours` whose error, by `measure`, keeps `budget`.

    The cost is ns per colour times colours, and what filling tables costs. `subject` stands in the error:
    raises UnkeptBudgetError, which names the best that can be reached, where nothing keeps the budget.
    """
    # Equal costs go by the order in the list, and nothing compares ways.
    queue: list[tuple[float, int, Candidate | TableOffer | Way]] = [
        (each.ns_per_colour * colours, i, each) for i, each in enumerate(candidates)
    ]
    if tables is not None:
        queue.append((tables.ns_at_least * colours, len(queue), tables))
    heapq.heapify(queue)
    offered = len(queue)
    while queue:
        _, _, each = heapq.heappop(queue)
        way: Way | None = None
        if isinstance(each, Way):
            way = each
        elif isinstance(each, TableOffer):
            fitted = each.fit(budget)
            if fitted is not None:
                cost = fitted.ns_per_colour * colours + fitted.filling_ns
                heapq.heappush(queue, (cost, offered, fitted))
        else:
            found = measure(each, budget)
            if found.holds:
                way = Way(each.method, each.parameters, (), each.ns_per_colour, 0.0, found.delta_e)
        if way is not None:
            return Chosen(way, _reason(way, budget, offered, queue))
    best, kept = _best_reachable(candidates, measure, tables, budget)
    raise UnkeptBudgetError(
        f"No way keeps ΔE {budget:g}",
        subject,
        f"the best is {best.label} with ΔE ≤ {figure(best.delta_e)}."
        f" Ask for {figure(kept)} or more, or for 0, the truth itself.",
        best.delta_e,
    )


def the_truth(candidates: Sequence[Candidate]) -> Chosen:
    """Return the truth's own way, which a budget of 0 asks for."""
    found = next(each for each in candidates if each.method is not None and METHODS[each.method].is_truth)
    way = Way(found.method, found.parameters, (), found.ns_per_colour)
    return Chosen(way, "the truth itself, as a budget of 0 asks")


def _reason(
    way: Way, budget: float, offered: int, dearer: Sequence[tuple[float, int, Candidate | TableOffer | Way]]
) -> str:
    cost = f"{figure(way.ns_per_colour)} ns a colour"
    if way.tables:
        cost += f" and {figure(1e-6 * way.filling_ns)} ms once"
    text = f"of {offered} ways the cheapest within ΔE {budget:g}: ΔE ≤ {figure(way.delta_e)} for {cost}"
    left = sorted(dearer, key=lambda entry: entry[:2])
    following = next((each for _, _, each in left if isinstance(each, Candidate)), None)
    if following is None:
        return text
    return f"{text}; the next dearer, not measured: {following.label}, {figure(following.ns_per_colour)} ns"


def _best_reachable(
    candidates: Sequence[Candidate],
    measure: Callable[[Candidate, float], Measured],
    tables: TableOffer | None,
    budget: float,
) -> tuple[Way, float]:
    """Return the way of the least error, and a budget that it is known to keep.

    A table does not always keep what it errs: one that is asked for so much aims at less.
    """
    ways = [
        Way(each.method, each.parameters, (), each.ns_per_colour, 0.0, measure(each, math.inf).delta_e)
        for each in candidates
    ]
    best = min(ways, key=lambda way: way.delta_e)
    kept = best.delta_e
    fails = max(budget, kept * _LEAST_SHARE)
    while tables is not None and kept > _BRACKET * fails:
        # As it is printed, so that it holds for whoever asks for it.
        between = float(figure(math.sqrt(fails * kept)))
        fitted = tables.fit(between)
        if fitted is None:
            fails = between
        else:
            best, kept = fitted, between
    return best, kept


def figure(value: float) -> str:
    """Return two digits of `value`, rounded up: what bounds an error must not be told too small."""
    if not 0.0 < value < math.inf:
        return f"{value:g}"
    last = 10.0 ** (math.floor(math.log10(value)) - 1)
    # A hair below, so that 0.30 does not become 0.31 by rounding.
    return f"{math.ceil(value / last - 1e-9) * last:.2g}" if value < 100.0 else f"{value:.0f}"
