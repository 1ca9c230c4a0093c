"""Tables of what a lobe reflects of a white sky, over the viewer's angle and roughness."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from gltf_iri.rendering.fullscreen import compute_texture

if TYPE_CHECKING:
    import moderngl

__all__ = ["compute_dfg_table", "compute_sheen_table"]

_DFG_SIZE: Final = (128, 128)
_SHEEN_SIZE: Final = (128, 64)


def compute_dfg_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table of (A, B) over √(N·V) and perceptual roughness; the caller releases it."""
    return _table(context, "pass/dfg.frag", _DFG_SIZE, 2)


def compute_sheen_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table of E_s over √(N·V) and sheen roughness; the caller releases it."""
    return _table(context, "pass/sheen_albedo.frag", _SHEEN_SIZE, 1)


def _table(context: moderngl.Context, entry: str, size: tuple[int, int], components: int) -> moderngl.Texture:
    table = compute_texture(context, entry, size, components, {"u_size": size}, {})
    table.repeat_x = table.repeat_y = False
    table.filter = (context.LINEAR, context.LINEAR)
    return table
