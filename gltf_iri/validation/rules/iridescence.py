"""KHR_materials_iridescence: films that do nothing, cannot be seen, or look different everywhere."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
