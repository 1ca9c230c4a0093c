"""The ways to a film's colour that a budget chooses among, and what each costs by the map of costs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, resolved_opd_nm
from gltf_iri.planning.costs import Costs, Device, shipped_costs
from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.method import METHODS, Domain, ParameterValue
from gltf_iri.planning.reach import Lobe, Reach
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import AVERAGED, NO_FILM, Way

__all__ = ["Candidate", "direct_candidates", "film_workload", "mirror_workload", "ns_by", "reach_workload"]
__all__ += ["resolves_in_glsl", "table_ns", "without_film"]

# From here on fringes are so narrow that films cost what the set "thick" of the map does.
_THICK_NM: Final = 3000.0

# What the names of its sets of mirrors begin with; the number of cells follows.
_MIRRORS: Final = "mirrors-"

# The twin of the truth in GLSL has a rule of fixed length, which does not resolve longer path differences.
_GLSL_TRUTH_OPD_NM: Final = resolved_opd_nm(SPECTRAL_DEGREE)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A method with its parameters that computes each colour, or no film at all (method None).

    ns_per_colour : by the map of costs, of one colour of the surface: the sum over its lobes.
    """

    method: str | None
    parameters: Mapping[str, ParameterValue]
    ns_per_colour: float

    @property
    def label(self) -> str:
        """What the map of costs calls it."""
        return Way(self.method, self.parameters).label


def direct_candidates(
    domain: Domain, device: Device, workloads: Sequence[str], *, has_spread: bool = False
) -> tuple[Candidate, ...]:
    """Return the methods for films or mirrors with their settings, cheapest first.

    In GLSL those with a twin. Settings that the map of costs does not know are not offered.

    workloads : the sets of the map that the colours are like, one for each lobe.
    has_spread : methods that can average over the thickness within a pixel do so, for what that costs.
    """
    costs = shipped_costs()
    found = (
        Candidate(name, parameters, ns)
        for name, parameters in _settings(domain, device)
        if (
            ns := _sum(
                ns_by(costs, device, each, _priced(name, parameters, has_spread)) for each in workloads
            )
        )
        is not None
    )
    return tuple(sorted(found, key=lambda candidate: candidate.ns_per_colour))


def without_film(device: Device, workloads: Sequence[str]) -> Candidate:
    """Return the surface without its film."""
    ns = _sum(ns_by(shipped_costs(), device, each, NO_FILM) for each in workloads)
    return Candidate(None, {}, ns or 0.0)


def film_workload(thickest_nm: float, *, is_grey: bool) -> str:
    """Return the set of the map of costs whose films are like these; `is_grey` : their base."""
    return "thick" if thickest_nm > _THICK_NM else "films" if is_grey else "metals"


def reach_workload(reach: Reach, lobe: Lobe) -> str:
    """Return the set of the map of costs whose films are like those over `lobe`."""
    base = reach.base(lobe)
    is_grey = reach.is_grey(lobe) or (base[0].is_point and base[0] == base[1] == base[2])
    return film_workload(reach.thickness_nm.high, is_grey=is_grey)


def mirror_workload(cells: float) -> str:
    """Return the set of the map of costs whose mirrors have about as many cells."""
    named = {name: name.removeprefix(_MIRRORS) for name in shipped_costs().ns["numpy"]}
    known = {name: int(number) for name, number in named.items() if number != name}
    return min(known, key=lambda name: abs(math.log(known[name] / cells)))


def resolves_in_glsl(reach: Reach) -> bool:
    """Return whether the truth's twin in GLSL resolves the fringes of every film."""
    return 2.0 * reach.film_ior * reach.thickness_nm.high <= _GLSL_TRUTH_OPD_NM


def table_ns(device: Device, table: FilmTable) -> float:
    """Return what one colour out of `table` costs by the map of costs; UsageError where it does not know."""
    # A base along an axis is read once a channel, as the set "metals" does.
    workload = "films" if table.axis("base_f0") is None else "metals"
    return shipped_costs().ns_of(device, workload, Way("spectral", tables=(table,)).label)


def ns_by(costs: Costs, device: Device, workload: str, label: str) -> float | None:
    """Return what one colour costs, by numpy where compiled loops do not have the method."""
    found = costs.ns_per_colour(device, workload, label)
    return costs.ns_per_colour("numpy", workload, label) if found is None and device == "numba" else found


def _settings(domain: Domain, device: Device) -> Iterator[tuple[str, Mapping[str, ParameterValue]]]:
    for name, method in METHODS.items():
        if method.domain == domain and (device != "glsl" or method.glsl_function is not None):
            for chosen in settings_of(name, ACCURACY_SETTINGS):
                yield name, with_defaults(name, chosen)


def _priced(name: str, parameters: Mapping[str, ParameterValue], has_spread: bool) -> str:
    label = Way(name, parameters).label
    return label + AVERAGED if has_spread and METHODS[name].glsl_spread_function is not None else label


def _sum(costs: Iterable[float | None]) -> float | None:
    known = list(costs)
    return None if None in known else sum(cost for cost in known if cost is not None)
