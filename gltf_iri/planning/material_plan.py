"""What the plan says about one material."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gltf_iri.planning.effects import Effect

__all__ = ["MaterialPlan"]


@dataclass(frozen=True, slots=True)
class MaterialPlan:
    """The effects to simulate, the method for the film, and the reason for everything left out.

    `skipped` holds effects that the material does not call for; `not_drawn` holds effects that it does call
    for and that this program does not simulate, so that every report can name them. Together
    the three hold every effect of a material once; `absent` names those of `skipped` that the file does not
    mention at all, which lists for people leave out.
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

    def calls_for(self, effect: Effect) -> bool:
        """True where `effect` is simulated."""
        return effect in self.effects

    def to_json(self) -> dict[str, Any]:
        """Return the row of `plan --json`."""
        return {
            "name": self.name,
            "index": self.index,
            "effects": [effect.value for effect in self.effects],
            "method": self.method,
            "method_reason": self.method_reason,
            "layering": self.layering,
            "skipped": {effect.value: reason for effect, reason in self.skipped.items()},
            "not_drawn": dict(self.not_drawn),
        }
