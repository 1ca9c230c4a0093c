"""Reference implementation of KHR_materials_iridescence: evaluator, renderer and spectral truth for glTF."""

from __future__ import annotations

__all__ = ["__version__"]

__version__ = "0.1.0"
