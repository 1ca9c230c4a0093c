"""Draws primitives in the right order with the right culling, depth and blending (glTF 2.0 §3.9.4-5)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.uniforms import bind
from gltf_iri.scene.model import Camera, Primitive

if TYPE_CHECKING:
    import moderngl

__all__ = ["Draw", "draw_primitives"]


@dataclass(frozen=True, slots=True)
class Draw:
    """One primitive, ready to be drawn."""

    primitive: Primitive
    plan: MaterialPlan
    program: moderngl.Program
    vertex_array: moderngl.VertexArray
    uniforms: dict[str, Any]
    textures: dict[str, moderngl.Texture]

    @property
    def is_blended(self) -> bool:
        """True where the surface lets what is behind it through."""
        return self.plan.calls_for(Effect.ALPHA_BLEND)


def draw_primitives(
    framebuffer: moderngl.Framebuffer, draws: Iterable[Draw], camera: Camera, *, is_blending: bool
) -> None:
    """Draw opaque primitives, then blended ones from the farthest centroid to the nearest.

    Without `is_blending` every primitive is drawn as if it were opaque.
    """
    context = framebuffer.ctx
    in_order = list(draws)
    blended = [draw for draw in in_order if is_blending and draw.is_blended]
    context.enable_only(context.DEPTH_TEST)
    for draw in in_order:
        if not (is_blending and draw.is_blended):
            _draw(context, draw, [None if draw.plan.calls_for(Effect.DOUBLE_SIDED) else "back"])
    context.enable(context.BLEND)
    context.blend_func = context.ONE, context.ONE_MINUS_SRC_ALPHA  # the shader writes premultiplied light
    framebuffer.depth_mask = False
    for draw in sorted(blended, key=lambda draw: _depth(draw.primitive, camera), reverse=True):
        # Of a double-sided shape the far side first, then the near one.
        _draw(context, draw, ["front", "back"] if draw.plan.calls_for(Effect.DOUBLE_SIDED) else ["back"])
    framebuffer.depth_mask = True


def _draw(context: moderngl.Context, draw: Draw, culled: Sequence[str | None]) -> None:
    """Draw once for each entry of `culled`: the face that is left out, or None for neither."""
    bind(draw.program, draw.uniforms, draw.textures)
    # A mirrored primitive's triangles turn the other way round (glTF 2.0 §3.7.4).
    context.front_face = "cw" if draw.primitive.is_mirrored else "ccw"
    for face in culled:
        if face is None:
            context.disable(context.CULL_FACE)
        else:
            context.enable(context.CULL_FACE)
            context.cull_face = face
        draw.vertex_array.render()


def _depth(primitive: Primitive, camera: Camera) -> float:
    """Return how far the mean of the vertices lies in front of the camera."""
    mean = primitive.world @ np.append(primitive.positions.mean(axis=0, dtype=np.float64), 1.0)
    return float(-(camera.view[2] @ mean))
