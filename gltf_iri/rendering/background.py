"""What lies behind the scene: a colour, or the environment softly out of focus. It covers nothing."""

from __future__ import annotations

from collections.abc import Mapping
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

    def draw(self, uniforms: Mapping[str, Any], textures: Mapping[str, moderngl.Texture]) -> None:
        """Fill what the scene leaves open in the framebuffer in use: under everything that was drawn.

        Drawn last, so that what is captured for transmissive surfaces holds nothing but the scene.
        """
        context = self._context
        context.enable_only(context.BLEND | context.DEPTH_TEST)
        context.blend_func = context.ONE_MINUS_DST_ALPHA, context.ONE
        context.depth_func = "<="  # the background lies at the farthest depth: what is opaque hides it
        context.fbo.depth_mask = False
        bind(self._program, uniforms, textures)
        self._triangle.render(vertices=3)
        context.fbo.depth_mask = True
        context.depth_func = "<"

    def release(self) -> None:
        """Give everything back to OpenGL."""
        self._triangle.release()
        self._program.release()
