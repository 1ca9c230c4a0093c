"""Passes that compute a texture: one triangle over all of its texels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gltf_iri.rendering.source import compile_program
from gltf_iri.rendering.uniforms import bind

if TYPE_CHECKING:
    import moderngl

__all__ = ["compute_texture", "release_framebuffer"]


def release_framebuffer(context: moderngl.Context, framebuffer: moderngl.Framebuffer) -> None:
    """Release `framebuffer` after leaving it: moderngl binds what was last in use again, alive or not."""
    context.detect_framebuffer(0).use()
    framebuffer.release()


def compute_texture(
    context: moderngl.Context,
    fragment_entry: str,
    size: tuple[int, int],
    components: int,
    uniforms: Mapping[str, Any],
    textures: Mapping[str, moderngl.Texture],
) -> moderngl.Texture:
    """Return a float32 texture of `size` whose texels the fragment shader `fragment_entry` computed."""
    target = context.texture(size, components, dtype="f4")
    framebuffer = context.framebuffer([target])
    program = compile_program(context, "pass/fullscreen.vert", fragment_entry)
    triangle = context.vertex_array(program, [])
    try:
        bind(program, uniforms, textures)
        context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        framebuffer.use()
        triangle.render(vertices=3)
    finally:
        triangle.release()
        program.release()
        release_framebuffer(context, framebuffer)
    return target
