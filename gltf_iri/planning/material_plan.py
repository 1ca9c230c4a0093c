"""What the plan says about one material."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from gltf_iri.material.material import DEFAULT_MATERIAL, Material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.reach import Lobe
from gltf_iri.planning.way import Way

__all__ = ["MaterialPlan"]


@dataclass(frozen=True, slots=True)
class MaterialPlan:
    """The effects to simulate, the method for the film, and the reason for everything left out.

    `skipped` holds effects that the material does not call for; `not_drawn` holds effects that it does call
    for and that this program does not simulate, so that every report can name them. Together
    the three hold every effect of a material once; `absent` names those of `skipped` that the file does not
    mention at all, which lists for people leave out.

    `material` is what is drawn: the file's, with textures that are the same everywhere folded into factors.
    `way` is how the film is computed where a budget chose it; without a budget it is None and `method` is
    computed directly, with its default parameters.

    `grey` names the lobes under a film whose base reflects R, G and B alike wherever no vertex brings a
    colour: one channel stands for all.

    `layers` is what is simulated of its Bragg layers, None where none are drawn.
    """

    index: int  # DEFAULT_MATERIAL for glTF's default material
    name: str
    effects: tuple[Effect, ...]  # in Effect order
    method: str | None  # None where there is no film
    method_reason: str
    layering: str  # "core", "specular": which of the text's two dielectric layerings applies
    skipped: Mapping[Effect, str] = field(default_factory=dict)
    not_drawn: Mapping[str, str] = field(default_factory=dict)
    absent: frozenset[Effect] = frozenset()
    material: Material | None = None
    way: Way | None = None
    grey: frozenset[Lobe] = frozenset()
    layers: LayersPlan | None = None

    def calls_for(self, effect: Effect) -> bool:
        """True where `effect` is simulated."""
        return effect in self.effects

    def material_in(self, materials: Sequence[Material]) -> Material:
        """Return the material that is drawn, of a file with `materials`."""
        if self.material is not None:
            return self.material
        return Material() if self.index == DEFAULT_MATERIAL else materials[self.index]

    def table(self, lobe: Lobe) -> FilmTable | None:
        """Return the table of the film over `lobe`; None where it is computed directly or there is none."""
        tables = () if self.way is None else self.way.tables
        return next((table for table in tables if table.lobe == lobe), None)

    def to_json(self) -> dict[str, Any]:
        """Return the row of `plan --json`."""
        return {
            "name": self.name,
            "index": self.index,
            "effects": [effect.value for effect in self.effects],
            "method": self.method,
            "method_reason": self.method_reason,
            "layering": self.layering,
            "grey": sorted(self.grey),
            "way": None if self.way is None else self.way.to_json(),
            "layers": None if self.layers is None else self.layers.to_json(),
            "skipped": {effect.value: reason for effect, reason in self.skipped.items()},
            "not_drawn": dict(self.not_drawn),
        }
