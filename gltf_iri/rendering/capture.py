"""What was drawn so far, as textures that surfaces in front of it can look through."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from gltf_iri.rendering.fullscreen import release_framebuffer
from gltf_iri.rendering.source import compile_program
from gltf_iri.rendering.targets import out_of_room
from gltf_iri.rendering.uniforms import bind
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

if TYPE_CHECKING:
    import moderngl

__all__ = ["Capturing"]


@dataclass(frozen=True, slots=True)
class _Textures:
    """A capture, and the framebuffers through which it is written."""

    light: moderngl.Texture
    depth: moderngl.Texture  # as the depth buffer has it
    depth_m: moderngl.Texture  # along the view's axis
    drawn: moderngl.Framebuffer
    linear: moderngl.Framebuffer


class Capturing:
    """Makes captures in one context; their textures live until `end`, one frame long."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._program = compile_program(context, "pass/fullscreen.vert", "pass/captured_depth.frag")
        self._triangle = context.vertex_array(self._program, [])
        self._textures: _Textures | None = None

    def take(
        self, drawn: moderngl.Framebuffer, camera: Camera, size: tuple[int, int]
    ) -> dict[str, moderngl.Texture]:
        """Return what the samplers of shaders/lighting/transmission.glsl read, instead of the last capture.

        drawn : a framebuffer of `size` that shows a scene through `camera`.

        Raises MissingCapabilityError where there is no room for the textures.
        """
        if self._textures is None:
            self._textures = self._allocate(size)
        made = self._textures
        self._context.copy_framebuffer(made.drawn, drawn)
        self._context.enable_only(self._context.NOTHING)
        made.linear.use()
        projection = projection_matrix(camera, size[0] / size[1])
        uniforms = {
            "u_depth_scale": tuple(map(float, projection[2, 2:])),
            "u_is_perspective": camera.kind == "perspective",
        }
        bind(self._program, uniforms, {"u_depth": made.depth})
        self._triangle.render(vertices=3)
        for texture in (made.light, made.depth_m):
            texture.build_mipmaps()
            texture.filter = (self._context.LINEAR_MIPMAP_LINEAR, self._context.LINEAR)
        return {"u_captured": made.light, "u_captured_depth": made.depth_m}

    def end(self) -> None:
        """Give the textures back to OpenGL."""
        if self._textures is not None:
            for framebuffer in (self._textures.drawn, self._textures.linear):
                release_framebuffer(self._context, framebuffer)
            for texture in (self._textures.light, self._textures.depth, self._textures.depth_m):
                texture.release()
            self._textures = None

    def _allocate(self, size: tuple[int, int]) -> _Textures:
        context = self._context
        with out_of_room(size) as held:
            light, depth = held(context.texture(size, 4, dtype="f4")), held(context.depth_texture(size))
            depth_m = held(context.texture(size, 2, dtype="f4"))
            depth.compare_func = ""  # read as numbers
            for texture in (light, depth_m):
                texture.repeat_x = texture.repeat_y = False
            drawn = held(context.framebuffer([light], depth))
            linear = context.framebuffer([depth_m])
        return _Textures(light, depth, depth_m, drawn, linear)

    def release(self) -> None:
        """Give everything back to OpenGL."""
        self.end()
        self._triangle.release()
        self._program.release()
