"""Tables of what a lobe reflects of a white sky, over the viewer's angle and roughness."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.optics.sheen import SHEEN_ALPHA_MIN, sheen_albedo
from gltf_iri.rendering.fullscreen import compute_texture

if TYPE_CHECKING:
    import moderngl

__all__ = ["compute_dfg_table", "compute_sheen_table"]

# Filtering is off by 7e-5 at roughness above 0.2, and by up to 3e-4 below; the quadrature by 2e-5.
_DFG_SIZE: Final = (256, 128)
_DFG_SLOPES: Final = 24
_DFG_TURNS: Final = 8

# Filtering is off by 3e-5 at sheen roughness above 0.3, and below by up to 4e-3 beside albedos held at 1.
_SHEEN_SIZE: Final = (512, 256)


def compute_dfg_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table of A, B and the facets' mean V·H over N·V and perceptual roughness, RGBA32F.

    The caller releases it.

    Where texels lie is said in shaders/lighting/dfg.glsl.
    """
    points = {
        "u_slopes": np.column_stack(gauss_unit(_DFG_SLOPES)).tolist(),
        "u_turns": np.column_stack(gauss_unit(_DFG_TURNS)).tolist(),
    }
    table = compute_texture(context, "pass/dfg.frag", _DFG_SIZE, 4, {"u_size": _DFG_SIZE, **points}, {})
    return _filtered(context, table)


def compute_sheen_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table of E_s over ⁴√(N·V) and sheen roughness; the caller releases it.

    Where texels lie is said in shaders/lighting/sheen_albedo.glsl.
    """
    n_dot_v, row = (np.linspace(0.0, 1.0, count) for count in _SHEEN_SIZE)
    roughness_min = SHEEN_ALPHA_MIN**0.5
    albedo = sheen_albedo(n_dot_v**4, (roughness_min + (1.0 - roughness_min) * row)[:, None])
    return _filtered(
        context, context.texture(_SHEEN_SIZE, 1, albedo.astype(np.float32).tobytes(), dtype="f4")
    )


def _filtered(context: moderngl.Context, table: moderngl.Texture) -> moderngl.Texture:
    table.repeat_x = table.repeat_y = False
    table.filter = (context.LINEAR, context.LINEAR)
    return table
