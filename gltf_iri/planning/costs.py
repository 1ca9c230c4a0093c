"""The map of costs that decisions read: measured by `gltf-iri bench accuracy`, shipped as costs.json."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

from gltf_iri.errors import UsageError

__all__ = ["Costs", "Device", "shipped_costs"]

Device = Literal["numpy", "numba", "glsl"]


@dataclass(frozen=True, slots=True)
class Costs:
    """Nanoseconds by device, set of films or mirrors, and label of the way (`Way.label`).

    machine : what they were measured on, the OpenGL renderer among it.
    """

    machine: Mapping[str, Any]
    ns: Mapping[str, Mapping[str, Mapping[str, float]]]

    def ns_per_colour(self, device: Device, workload: str, label: str) -> float | None:
        """Return what one colour costs, None where that was not measured."""
        return self.ns.get(device, {}).get(workload, {}).get(label)

    def ns_of(self, device: Device, workload: str, label: str) -> float:
        """Return what one colour costs; UsageError where that was not measured."""
        found = self.ns_per_colour(device, workload, label)
        if found is None:
            raise UsageError(f"The map of costs has no '{label}' of '{workload}' by {device}.")
        return found


@cache
def shipped_costs() -> Costs:
    """Return the map that ships with the program."""
    read = json.loads(files("gltf_iri.planning").joinpath("costs.json").read_text(encoding="utf-8"))
    return Costs(read["machine"], read["ns"])
