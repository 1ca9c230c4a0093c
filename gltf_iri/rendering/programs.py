"""Surface shaders, compiled once for every permutation; the key is the ordered tuple of defines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.errors import UsageError
from gltf_iri.planning.method import METHODS, find_method
from gltf_iri.rendering.source import ShaderSource, assemble, build_program

if TYPE_CHECKING:
    import moderngl

__all__ = ["ProgramStore", "check_method", "surface_sources"]


def surface_sources(defines: tuple[str, ...]) -> tuple[ShaderSource, ShaderSource]:
    """Return the vertex and the fragment shader of one permutation, as the compiler sees them."""
    return assemble("pass/surface.vert", defines), assemble("pass/surface.frag", defines)


def check_method(name: str | None) -> None:
    """Raise UsageError where the film method `name` has no GLSL twin; None stands for no film."""
    if name is not None and find_method(name).glsl_function is None:
        drawable = ", ".join(name for name, method in METHODS.items() if method.glsl_function)
        raise UsageError(f"The method '{name}' cannot be drawn; methods that can are: {drawable}.")


class ProgramStore:
    """The compiled permutations of one context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._programs: dict[tuple[str, ...], moderngl.Program] = {}

    def get(self, defines: tuple[str, ...]) -> moderngl.Program:
        """Return the program of one permutation."""
        if defines not in self._programs:
            self._programs[defines] = build_program(self._context, *surface_sources(defines))
        return self._programs[defines]

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for program in self._programs.values():
            program.release()
        self._programs.clear()
