"""Rows of the workload `layers`: what a way to a layered surface costs, its error, and what is printed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.planning.method import parameters_text
from gltf_iri.planning.settings import Settings

__all__ = ["LayerRow", "colour_errors"]


@dataclass(frozen=True, slots=True)
class LayerRow:
    """One way on one backend; ΔE is CIEDE2000 under D65, against the truth.

    ns_per_eval : a median, taken in the same rounds as those of all rows of its workload and backend.
    speedup : the time of `speedup_over` on the same backend over this one's.
    printed : the paper's own figures by name: "speedup", or "time_s", "smape" and "efficiency".
    smape : mean of |a − b| / (½(|a| + |b|)) over pixels and channels; efficiency : time of the ground truth
        over time × SMAPE. Fourneau et al. 2024, Table 2; None where a row is no picture.
    """

    workload: str
    method: str
    backend: str
    ns_per_eval: float
    max_abs: float
    delta_e_mean: float
    delta_e_p95: float
    delta_e_max: float
    parameters: Settings = field(default_factory=dict)
    speedup: float | None = None
    speedup_over: str = ""
    smape: float | None = None
    efficiency: float | None = None
    printed: Mapping[str, float] = field(default_factory=dict)
    remark: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)

    @property
    def label(self) -> str:
        """The method with its parameters."""
        chosen = parameters_text(self.parameters)
        return f"{self.method} ({chosen})" if chosen else self.method


def colour_errors(
    rgb: NDArray[np.floating[Any]], truth: NDArray[np.float64]
) -> tuple[float, float, float, float]:
    """Return max_abs, and mean, p95 and largest ΔE of colours (..., 3), linear Rec.709."""
    given = np.asarray(rgb, np.float64)
    delta_e = delta_e_2000(given, truth)
    return (
        float(np.abs(given - truth).max()),
        float(delta_e.mean()),
        float(np.percentile(delta_e, 95)),
        float(delta_e.max()),
    )
