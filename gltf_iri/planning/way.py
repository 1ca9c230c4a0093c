"""How a film's colour is computed: by which method, directly or out of tables, and what that costs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Final

from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.method import ParameterValue, parameters_text

__all__ = ["AVERAGED", "NO_FILM", "ONE_CHANNEL", "Way", "look_up_key"]

# Stands in the map of costs and in `Way.label` for a film that is left out.
NO_FILM: Final = "no film"

# Follows the label of a method in the map of costs where it averages over thicknesses within a pixel.
AVERAGED: Final = ", averaged over thickness"

# And where its base is grey, so that one channel is computed for three.
ONE_CHANNEL: Final = ", one channel"


def look_up_key(axes: int) -> str:
    """Return what the map of costs calls a look-up in a table of so many axes."""
    return f"table of {axes} axes"


@dataclass(frozen=True, slots=True)
class Way:
    """One way to a film's colour, as a budget chooses among them.

    method : the method, which also fills the tables; None leaves the film out.
    parameters : of the method, defaults included.
    tables : one a lobe that the material has; empty where each colour is computed when it is wanted.
    ns_per_colour : from the map of costs; the filling of tables not included.
    filling_ns : what the tables cost once; 0 where there are none or they lie in the cache.
    delta_e : the most that the p95 of CIEDE2000 against the truth can be over the material's reach; 0 for the
        truth itself.
    """

    method: str | None
    parameters: Mapping[str, ParameterValue] = field(default_factory=lambda: MappingProxyType({}))
    tables: tuple[FilmTable, ...] = ()
    ns_per_colour: float = 0.0
    filling_ns: float = 0.0
    delta_e: float = 0.0

    @property
    def label(self) -> str:
        """What the map of costs calls it: "fourier, tolerance 0.0001", "table of 2 axes", "no film"."""
        if self.method is None:
            return NO_FILM
        if self.tables:
            return look_up_key(max(len(table.axes) for table in self.tables))
        return ", ".join(filter(None, (self.method, parameters_text(self.parameters))))

    def to_json(self) -> dict[str, Any]:
        """Return how `plan --json` tells it."""
        return {
            "label": self.label,
            "parameters": dict(self.parameters),
            "tables": [table.to_json() for table in self.tables],
            "ns_per_colour": self.ns_per_colour,
            "filling_ns": self.filling_ns,
            "delta_e": self.delta_e,
        }
