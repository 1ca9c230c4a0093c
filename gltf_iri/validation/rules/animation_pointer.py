"""KHR_animation_pointer: where pointers lead, and what they may be set to."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
