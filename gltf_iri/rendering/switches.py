"""Every preprocessor symbol that may switch shader code on or off.

A symbol outside this set is an error wherever it appears, in a list of defines or in a shader's condition:
a misspelt switch would otherwise only make its feature vanish.
"""

from __future__ import annotations

from typing import Final

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import METHODS

__all__ = ["LAYERING_SPECULAR", "SHADING_INPUTS", "SWITCHES", "method_define"]

# The dielectric layering of the text's KHR_materials_specular section; without it, the core section's.
LAYERING_SPECULAR: Final = "LAYERING_SPECULAR"

# The frame also receives what each pixel was shaded with (rendering/frame.py).
SHADING_INPUTS: Final = "SHADING_INPUTS"


def method_define(name: str) -> str:
    """Return the symbol of the film or mirror method `name`: "khr-guarded" → METHOD_KHR_GUARDED."""
    return "METHOD_" + name.upper().replace("-", "_")


SWITCHES: Final = frozenset(
    {effect.define for effect in Effect}
    | {method_define(name) for name, method in METHODS.items() if method.glsl_function}
    | {LAYERING_SPECULAR, SHADING_INPUTS}
)
