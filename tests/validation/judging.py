"""The types of the fixtures that judge small assets."""

from __future__ import annotations

from collections.abc import Callable

from gltf_iri.validation.report import Report

__all__ = ["Codes", "Judge"]

# A glTF object, JSON text or bytes to the report, or to its codes and places.
Judge = Callable[..., Report]
Codes = Callable[..., set[tuple[str, str | int | None]]]
