"""What a comparison found, and how it is written as JSON (spec/report.schema.json)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.metric import Agreement, ColourError
from gltf_iri.comparison.reference_result import ReferenceResult
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE, GLSL_PIXEL_ROUGHNESS_MIN

__all__ = ["Comparison", "MaterialResult", "PictureResult", "Pictures", "Split"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Split:
    """GLSL against Python: on all pixels, and apart above and below the roughness where judging starts."""

    all: Agreement
    rough: Agreement
    smooth: Agreement

    @property
    def agrees(self) -> bool:
        """True where the rough pixels keep to the tolerance; smooth ones are reported, not judged."""
        return self.rough.within(GLSL_PIXEL_RELATIVE)

    def to_json(self) -> dict[str, Any]:
        """Return the contract's ``glsl_vs_python``."""
        return {**asdict(self.all), "rough": asdict(self.rough), "smooth": asdict(self.smooth)}


@dataclass(frozen=True, slots=True)
class MaterialResult:
    """One material on the picture; errors against truth are None where it has neither film nor layers."""

    plan: MaterialPlan
    glsl_vs_python: Split
    method_white: str | None
    truth_white: str | None
    method_vs_truth: ColourError | None  # `Shading.film` alone, at the pixels' N·V
    picture_vs_truth: ColourError | None  # the shaded pixels, after exposure, before tone mapping
    eight_bit_textures: ColourError | None  # GLSL with 8-bit textures against GLSL with float ones
    undefined: Mapping[str, int]  # pixels that each undefined case of the method's text touched
    left_out: int  # pixels not compared: on a branch of the text, or undefined and no number

    def to_json(self) -> dict[str, Any]:
        """Return one row of the report's ``materials``."""
        return {
            **self.plan.to_json(),
            "white": {"method": self.method_white, "truth": self.truth_white},
            "glsl_vs_python": self.glsl_vs_python.to_json(),
            "method_vs_truth": _maybe(self.method_vs_truth),
            "picture_vs_truth": _maybe(self.picture_vs_truth),
            "eight_bit_textures": _maybe(self.eight_bit_textures),
            "undefined": dict(self.undefined),
            "left_out": self.left_out,
        }


@dataclass(frozen=True, slots=True)
class PictureResult:
    """The whole picture, all materials together."""

    glsl_vs_python: Split
    picture_vs_truth: ColourError
    eight_bit_textures: ColourError | None

    def to_json(self) -> dict[str, Any]:
        """Return the report's ``picture``."""
        return {
            "glsl_vs_python": self.glsl_vs_python.to_json(),
            "picture_vs_truth": asdict(self.picture_vs_truth),
            "eight_bit_textures": _maybe(self.eight_bit_textures),
        }


@dataclass(frozen=True, slots=True)
class Pictures:
    """Linear Rec.709 pictures (height, width, 3), all 0 where nothing was drawn."""

    glsl: Float64
    python: Float64
    truth: Float64
    drawn: NDArray[np.bool_]  # (height, width)
    deviation: Float64  # (height, width), |GLSL − Python| / max(1, |Python|)
    delta_e: Float64  # (height, width), the method's picture against truth, after exposure
    texture_delta_e: Float64 | None  # (height, width), GLSL with 8-bit textures against float ones


@dataclass(frozen=True, slots=True)
class Comparison:
    """Everything that the report shows."""

    file: str
    white: str  # of the truth; ΔE's CIELAB is always under D65
    setup: Mapping[str, Any]  # size, camera, environment, exposure: how the picture was taken
    program: Mapping[str, str]  # versions, and OpenGL's own name for what drew it
    materials: tuple[MaterialResult, ...]
    whole: PictureResult
    pictures: Pictures
    notes: tuple[str, ...]
    reference: ReferenceResult | None = None  # None: it was not asked for

    @property
    def agrees(self) -> bool:
        """True where GLSL and Python agree within tolerance on every material."""
        return all(m.glsl_vs_python.agrees for m in self.materials)

    def to_json(self) -> dict[str, Any]:
        """Return the report."""
        return {
            "file": self.file,
            "white": self.white,
            "agrees": self.agrees,
            "tolerance": {"relative": GLSL_PIXEL_RELATIVE, "roughness_min": GLSL_PIXEL_ROUGHNESS_MIN},
            "setup": dict(self.setup),
            "program": dict(self.program),
            "materials": [m.to_json() for m in self.materials],
            "picture": self.whole.to_json(),
            "reference": None if self.reference is None else self.reference.to_json(),
            "notes": list(self.notes),
        }


def _maybe(error: ColourError | None) -> dict[str, Any] | None:
    return None if error is None else asdict(error)
