"""Meshes and primitives: attributes, indices, morph targets, and what their materials want of them."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
