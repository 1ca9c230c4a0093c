"""EXT_materials_bragg: mirrors that do nothing, cannot be drawn, or look different everywhere."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
