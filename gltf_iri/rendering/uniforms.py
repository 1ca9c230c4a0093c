"""Numbers and textures into a program."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import moderngl

__all__ = ["Sampled", "bind"]

# Textures of two and of three dimensions and arrays of them, which are bound alike.
Sampled: TypeAlias = "moderngl.Texture | moderngl.Texture3D | moderngl.TextureArray"


def bind(program: moderngl.Program, uniforms: Mapping[str, Any], textures: Mapping[str, Sampled]) -> None:
    """Set the uniforms, and bind each texture that the program samples to a unit.

    Names that the program does not have are passed over: a compiler removes what no pixel depends on.
    """
    for name, value in uniforms.items():
        if name in program:
            program[name] = value
    sampled = {name: texture for name, texture in textures.items() if name in program}
    for unit, (name, texture) in enumerate(sampled.items()):
        texture.use(unit)
        program[name] = unit
