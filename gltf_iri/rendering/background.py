"""The environment behind the scene, softly out of focus, with coverage 0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from gltf_iri.rendering.source import compile_program
from gltf_iri.rendering.uniforms import bind

if TYPE_CHECKING:
    import moderngl

__all__ = ["BLUR", "Background"]

# As a mirror's perceptual roughness: the surroundings' shapes stay, edges that compete with the model go.
BLUR: Final = 0.35


class Background:
    """The background pass of one context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._program = compile_program(context, "pass/fullscreen.vert", "pass/background.frag")
        self._triangle = context.vertex_array(self._program, [])

    def draw(self, uniforms: dict[str, Any], textures: dict[str, moderngl.Texture]) -> None:
        """Fill the framebuffer in use; depth stays as it is."""
        self._context.enable_only(self._context.NOTHING)
        bind(self._program, uniforms | {"u_blur": BLUR}, textures)
        self._triangle.render(vertices=3)

    def release(self) -> None:
        """Give everything back to OpenGL."""
        self._triangle.release()
        self._program.release()
