"""One file of a gallery: its picture, its plan and its error, or the sentence that says why there is none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from gltf_iri.baking.fill import bake_plans
from gltf_iri.baking.layer_fill import bake_layer_plans
from gltf_iri.budgets.plans import plans_within
from gltf_iri.comparison.figures import TONEMAP
from gltf_iri.comparison.result import Comparison
from gltf_iri.comparison.run import compare
from gltf_iri.errors import GltfIriError
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.picture import display_pixels, webp_bytes
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.choose import choose_camera
from gltf_iri.scene.exposure import automatic_exposure
from gltf_iri.scene.load import Model, load
from gltf_iri.scene.model import Environment, Scene

__all__ = ["Entry", "Setup", "make_entry"]


@dataclass(frozen=True, slots=True)
class Setup:
    """How every picture of a gallery is taken."""

    size: tuple[int, int]
    environment: Environment | None
    exposure: float | None = None  # EV; None: `automatic_exposure` of each file
    method: str | None = None
    budget: float | None = None  # ΔE, instead of a method


@dataclass(frozen=True, slots=True)
class Entry:
    """What the page tells of one file; what comes after an error is missing."""

    file: Path
    error: str | None = None  # a sentence
    picture: bytes | None = None  # WebP
    exposure: float | None = None  # EV
    plans: tuple[MaterialPlan, ...] = ()  # of the materials that the scene uses
    comparison: Comparison | None = None
    notes: tuple[str, ...] = ()

    @property
    def is_sound(self) -> bool:
        """True where the file was drawn, and GLSL and Python agree."""
        return self.error is None and self.comparison is not None and self.comparison.agrees

    def to_json(self) -> dict[str, Any]:
        """Return one row of `gallery --json`; figures are null for a material that no pixel shows."""
        told = self.comparison.to_json() if self.comparison is not None else None
        errors: Mapping[int, Any] = {row["index"]: row for row in told["materials"]} if told else {}
        return {
            "file": self.file,
            "error": self.error,
            "exposure": self.exposure,
            "agrees": told and told["agrees"],
            "materials": [
                {
                    **plan.to_json(),
                    **{key: errors.get(plan.index, {}).get(key) for key in _FIGURES},
                }
                for plan in self.plans
            ],
            "picture": told and told["picture"],
            "notes": list(self.notes),
        }


_FIGURES = ("glsl_vs_python", "method_vs_truth", "picture_vs_truth")


def make_entry(renderer: Renderer, file: Path, setup: Setup) -> Entry:
    """Draw `file`, shade its pixels again, and return both; a failure is kept as its sentence.

    Programs and environments stay with `renderer`, for the next file.
    """
    entry = Entry(file)
    try:
        model = load(file)
        scene = model.scene()
        plans = _planned(model, scene, setup)
        used = {primitive.material for primitive in scene.primitives}
        exposure = setup.exposure
        if exposure is None:
            exposure = automatic_exposure(scene, setup.environment)
        entry = Entry(file, exposure=exposure, plans=tuple(p for p in plans if p.index in used))
        arguments = (model, scene, plans, choose_camera(scene, None, setup.size), setup.environment)
        tables: dict[str, Any] = {
            "tables": bake_plans(entry.plans),
            "layer_tables": bake_layer_plans(entry.plans),
        }
        frame = renderer.render(*arguments, size=setup.size, **tables)
        entry = replace(entry, picture=webp_bytes(display_pixels(frame.rgba, exposure, TONEMAP)))
        comparison = compare(renderer, *arguments, size=setup.size, exposure=exposure, **tables)
        notes = dict.fromkeys((*comparison.notes, *frame.notes))
        return replace(entry, comparison=comparison, notes=tuple(notes))
    except GltfIriError as error:
        return replace(entry, error=str(error))


def _planned(model: Model, scene: Scene, setup: Setup) -> tuple[MaterialPlan, ...]:
    if setup.budget is None:
        return plan_materials(model.materials, method=setup.method, document=model.document, scene=scene)
    light = setup.environment
    return plans_within(
        model,
        scene,
        setup.budget,
        size_pixels=setup.size[0] * setup.size[1],
        has_image_light=light is not None and bool(light.radiance.any()),
    )
