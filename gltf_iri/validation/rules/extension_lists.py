"""extensionsUsed and extensionsRequired."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
