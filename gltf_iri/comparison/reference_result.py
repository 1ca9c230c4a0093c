"""What holding the rasteriser's picture against the CPU reference's found, and how it is written as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.metric import Agreement, ColourError
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

__all__ = ["NoisyError", "ReferenceMaterial", "ReferenceResult", "SameProblem"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class NoisyError:
    """How far a picture is from one that is itself an estimate, and how far that may be from its own mean.

    noise_mean, noise_p95 : ΔE2000 between the estimate and the estimate moved by one standard error.
    """

    error: ColourError
    noise_mean: float | None
    noise_p95: float | None

    def to_json(self) -> dict[str, Any]:
        """Return the contract's ``noisy_error``."""
        return {
            **asdict(self.error),
            "noise_delta_e_mean": self.noise_mean,
            "noise_delta_e_p95": self.noise_p95,
        }


@dataclass(frozen=True, slots=True)
class SameProblem:
    """Punctual light and emission on opaque pixels, which both solve exactly.

    edges : pixels left out because an edge runs so near that the two may see either side of it.
    steep : pixels left out because REFERENCE_STEP_PX changes them by more than the tolerance.
    """

    rough: Agreement  # judged
    smooth: Agreement  # reported only
    edges: int
    steep: int

    @property
    def agrees(self) -> bool:
        """True where every judged pixel keeps to the tolerance."""
        return self.rough.within(GLSL_PIXEL_RELATIVE)

    def to_json(self) -> dict[str, Any]:
        """Return the contract's ``same_problem``."""
        return {
            "rough": asdict(self.rough),
            "smooth": asdict(self.smooth),
            "edges": self.edges,
            "steep": self.steep,
        }


@dataclass(frozen=True, slots=True)
class ReferenceMaterial:
    """One material on the picture."""

    index: int
    name: str
    is_see_through: bool
    same_problem: SameProblem
    picture: NoisyError

    def to_json(self) -> dict[str, Any]:
        """Return one row of the report's ``reference.materials``."""
        return {
            "index": self.index,
            "name": self.name,
            "see_through": self.is_see_through,
            "same_problem": self.same_problem.to_json(),
            "picture": self.picture.to_json(),
        }


@dataclass(frozen=True, slots=True)
class ReferenceResult:
    """The whole of it; pictures are linear Rec.709 (height, width, 3).

    lights : what lit the pixels of `same_problem`, in words.
    samples : a pixel of the reference, by kind.
    """

    lights: str
    samples: Mapping[str, int]
    seconds: float
    same_problem: SameProblem
    opaque: NoisyError
    see_through: NoisyError
    whole: NoisyError
    materials: tuple[ReferenceMaterial, ...]
    glsl: Float64
    picture: Float64
    drawn: NDArray[np.bool_]
    delta_e: Float64  # (height, width), after exposure

    @property
    def agrees(self) -> bool:
        """True where the two agree on the problem that both solve."""
        return self.same_problem.agrees

    def to_json(self) -> dict[str, Any]:
        """Return the report's ``reference``."""
        return {
            "agrees": self.agrees,
            "lights": self.lights,
            "samples": dict(self.samples),
            "seconds": round(self.seconds, 1),
            "same_problem": self.same_problem.to_json(),
            "opaque": self.opaque.to_json(),
            "see_through": self.see_through.to_json(),
            "whole": self.whole.to_json(),
            "materials": [material.to_json() for material in self.materials],
        }
