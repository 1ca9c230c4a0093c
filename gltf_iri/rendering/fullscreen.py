"""Passes that compute a texture: one triangle over all of its texels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gltf_iri.rendering.source import compile_program

if TYPE_CHECKING:
    import moderngl

__all__ = ["compute_texture", "release_framebuffer", "set_uniforms"]


def set_uniforms(program: moderngl.Program, values: Mapping[str, Any]) -> None:
    """Set those uniforms that the compiler kept; one that no pixel depends on is gone from the program."""
    for name, value in values.items():
        if name in program:
            program[name] = value


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
        set_uniforms(program, uniforms)
        for unit, (name, texture) in enumerate(textures.items()):
            texture.use(unit)
            set_uniforms(program, {name: unit})
        context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        framebuffer.use()
        triangle.render(vertices=3)
    finally:
        triangle.release()
        program.release()
        release_framebuffer(context, framebuffer)
    return target
