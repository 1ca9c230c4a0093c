"""Draws primitives with the right culling, depth and blending (glTF 2.0 §3.9.4-5)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.uniforms import Sampled, bind
from gltf_iri.scene.model import Primitive

if TYPE_CHECKING:
    import moderngl

__all__ = ["Draw", "Shader", "draw_faces", "draw_opaque"]


@dataclass(frozen=True, slots=True)
class Shader:
    """A program, and the vertices as it reads them."""

    program: moderngl.Program
    vertex_array: moderngl.VertexArray


@dataclass(frozen=True, slots=True)
class Draw:
    """One primitive, ready to be drawn into any of the targets that `shaders` names."""

    primitive: Primitive
    plan: MaterialPlan
    shaders: Mapping[str, Shader]
    uniforms: Mapping[str, Any]
    textures: Mapping[str, Sampled]

    @property
    def is_blended(self) -> bool:
        """True where alpha lets what is behind the surface through: it is drawn over that."""
        return self.plan.calls_for(Effect.ALPHA_BLEND)

    @property
    def is_transmissive(self) -> bool:
        """True where the surface itself reads what is behind it."""
        return self.plan.calls_for(Effect.TRANSMISSION)

    @property
    def is_see_through(self) -> bool:
        """True where it matters what was drawn before."""
        return self.is_blended or self.is_transmissive


def draw_opaque(context: moderngl.Context, draws: Iterable[Draw], target: str) -> None:
    """Draw into the framebuffer in use what is not see-through; depth decides what is seen."""
    context.enable_only(context.DEPTH_TEST)
    for draw in draws:
        if not draw.is_see_through:
            culled = None if draw.plan.calls_for(Effect.DOUBLE_SIDED) else "back"
            _draw(context, draw, target, culled, {})


def draw_faces(
    framebuffer: moderngl.Framebuffer,
    draw: Draw,
    culled: str | None,
    captured: Mapping[str, moderngl.Texture],
    *,
    target: str,
    is_blending: bool,
) -> None:
    """Draw a see-through primitive into `framebuffer`, which is in use.

    culled : the face that is left out.
    captured : what a transmissive surface sees.
    is_blending : False draws blended surfaces as if opaque.
    """
    context = framebuffer.ctx
    context.enable_only(context.DEPTH_TEST)
    is_blended = is_blending and draw.is_blended
    if is_blended:
        context.enable(context.BLEND)
        context.blend_func = context.ONE, context.ONE_MINUS_SRC_ALPHA  # the shader writes premultiplied light
    framebuffer.depth_mask = not is_blended
    _draw(context, draw, target, culled, captured)
    framebuffer.depth_mask = True


def _draw(
    context: moderngl.Context,
    draw: Draw,
    target: str,
    culled: str | None,
    captured: Mapping[str, moderngl.Texture],
) -> None:
    shader = draw.shaders[target]
    bind(shader.program, draw.uniforms, {**draw.textures, **captured})
    # A mirrored primitive's triangles turn the other way round (glTF 2.0 §3.7.4).
    context.front_face = "cw" if draw.primitive.is_mirrored else "ccw"
    if culled is None:
        context.disable(context.CULL_FACE)
    else:
        context.enable(context.CULL_FACE)
        context.cull_face = culled
    shader.vertex_array.render()
