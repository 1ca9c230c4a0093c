"""Accessors and buffer views: formats, offsets, lengths, and what they are used for."""

from __future__ import annotations

from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

RULES: Rules = {}
