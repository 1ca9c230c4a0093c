"""One row of the map of cost and error."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.planning.costs import Device
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.settings import Settings

__all__ = ["SHADINGS", "AccuracyRow", "Errors", "errors_of"]

# What the filling of a table is spread over: the pixels of one picture of 1000 × 1000.
SHADINGS: Final = 1_000_000


@dataclass(frozen=True, slots=True)
class Errors:
    """How far colours are from the truth: linear Rec.709, and CIEDE2000 under D65.

    undefined : colours that a method leaves undefined (NaN); the figures are those of the others.
    """

    max_abs: float
    delta_e_mean: float
    delta_e_p95: float
    delta_e_max: float
    undefined: int


@dataclass(frozen=True, slots=True)
class AccuracyRow:
    """What one way to the colours of one set costs on one device, and how far it is off.

    label : the way with its sizes, "table: cos_theta 64, RGBA16F"; way : its key in planning/costs.json.
    method : None for tables, which are filled from the truth; parameters : of the method, defaults included.
    ns_per_eval : of a colour, a median of rounds that every row of its set and device shared.
    ns_per_pixel : in OpenGL with what every pixel costs, its arguments' texels and the writing of its colour.
    filling_ns : what filling the table cost, once; None for what needs none.
    errors : None where only the time was taken.
    """

    workload: str
    backend: Device
    label: str
    way: str
    method: str | None
    ns_per_eval: float
    errors: Errors | None
    parameters: Settings = field(default_factory=dict)
    ns_per_pixel: float | None = None
    filling_ns: float | None = None

    @property
    def ns(self) -> float:
        """A colour's share of the filling of its table, over `SHADINGS`, included."""
        return self.ns_per_eval + (self.filling_ns or 0.0) / SHADINGS

    @property
    def is_truth(self) -> bool:
        """True for the method that the others are judged by."""
        return self.method is not None and METHODS[self.method].is_truth

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`: flat, errors among the other figures."""
        flat = asdict(self)
        errors: Mapping[str, Any] = flat.pop("errors") or dict.fromkeys(Errors.__dataclass_fields__)
        return {**flat, "ns_with_filling": self.ns, **errors}


def errors_of(rgb: NDArray[np.floating[Any]], truth: NDArray[np.float64]) -> Errors:
    """Return the errors of colours (n, 3) against `truth` (n, 3)."""
    is_defined = np.isfinite(rgb).all(axis=-1)
    if not is_defined.any():
        return Errors(np.nan, np.nan, np.nan, np.nan, len(rgb))
    found = np.asarray(rgb, dtype=np.float64)[is_defined]
    delta_e = delta_e_2000(found, truth[is_defined])
    return Errors(
        max_abs=float(np.abs(found - truth[is_defined]).max()),
        delta_e_mean=float(delta_e.mean()),
        delta_e_p95=float(np.percentile(delta_e, 95)),
        delta_e_max=float(delta_e.max()),
        undefined=int(np.count_nonzero(~is_defined)),
    )
