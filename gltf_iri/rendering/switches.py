"""Every preprocessor symbol that may switch shader code on or off.

A symbol outside this set is an error wherever it appears, in a list of defines or in a shader's condition:
a misspelt switch would otherwise only make its feature vanish.
"""

from __future__ import annotations

from typing import Final

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_switches import LAYER_SWITCHES
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.permutation import FILM_SWITCHES, LAYERING_SPECULAR

__all__ = ["BRAGG_INPUTS", "LAYER_INPUTS", "SHADING_INPUTS", "SWITCHES"]

# In place of the picture: what each pixel was shaded with, in the first, second or third set of targets
# (rendering/frame.py). One of the three, never two.
SHADING_INPUTS: Final = "SHADING_INPUTS"
LAYER_INPUTS: Final = "LAYER_INPUTS"
BRAGG_INPUTS: Final = "BRAGG_INPUTS"

SWITCHES: Final = frozenset(
    {effect.define for effect in Effect}
    | {m.define for m in METHODS.values() if m.glsl_function}
    | FILM_SWITCHES
    | LAYER_SWITCHES
    | {LAYERING_SPECULAR, SHADING_INPUTS, LAYER_INPUTS, BRAGG_INPUTS}
)
