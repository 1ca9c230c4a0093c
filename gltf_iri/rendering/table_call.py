"""A look-up in a film's table, by the GLSL that surfaces are drawn with, as a call of a film's arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.evaluation.film import Film
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import permutation
from gltf_iri.planning.way import Way
from gltf_iri.rendering.film_tables import film_table_texture, film_table_uniforms
from gltf_iri.rendering.timed_calls import TimedCall
from gltf_iri.rendering.twins import FILM_TYPES, MIRROR_TYPES, film_arguments

if TYPE_CHECKING:
    import moderngl

__all__ = ["table_call", "texture_call"]

_TEXTURE: Final = 512
_FILLED_BY: Final = "spectral"

# The film's arguments a0 to a4: outside, film index, base, thickness, cosine. The roughness axis, where there
# is one, is read at the cosine: somewhere, and elsewhere at each pixel.
_LOOK_UP: Final = """
vec3 timed_table(vec3 base_f0, float thickness_nm, float cos_theta) {{
    Surface s;
    s.iridescence_thickness_nm = thickness_nm;
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
    s.iridescence_thickness_std_nm = 0.05 * thickness_nm;
#endif
    return {lobe}_table(s, base_f0, Lobe(cos_theta, cos_theta, cos_theta, 1.0, 0.0));
}}"""


def table_call(context: moderngl.Context, baked: BakedTable, at: Film | NDArray[np.float64]) -> TimedCall:
    """Return the look-up of every row of a film in its table; its arguments are the film twins'.

    at : a film, or of a table of one axis the cosines (n,), which then stand among arguments of mirrors.
    The texture is the caller's to release. Raises MissingCapabilityError where OpenGL takes none so large.
    """
    table = baked.table
    if isinstance(at, Film):
        look_up, types, arguments = "timed_table(a2, a3, a4)", FILM_TYPES, film_arguments(at)
    else:
        look_up, types = "timed_table(vec3(a0), a1, a6)", MIRROR_TYPES
        arguments = (*(np.zeros(1),) * (len(MIRROR_TYPES) - 1), at)
    return TimedCall(
        f"a table of {len(table.axes)} axes",
        ('#include "lighting/film_table.glsl"', *_LOOK_UP.format(lobe=table.lobe).splitlines()),
        look_up,
        types,
        arguments,
        textures={f"u_{table.lobe}_table": film_table_texture(context, baked)},
        uniforms=film_table_uniforms(table),
        defines=_defines(table),
    )


def texture_call(context: moderngl.Context, beside: TimedCall) -> TimedCall:
    """Return one sample of a texture of 8 bits with mip levels, as materials have them.

    Its arguments are those of `beside`, which it does not read; the texture is the caller's to release.
    """
    texels = np.random.default_rng(0).integers(0, 256, (_TEXTURE, _TEXTURE, 4), dtype=np.uint8)
    texture = context.texture((_TEXTURE, _TEXTURE), 4, texels.tobytes())
    texture.build_mipmaps()
    texture.filter = (context.LINEAR_MIPMAP_LINEAR, context.LINEAR)
    return TimedCall(
        "a texture",
        ("uniform highp sampler2D timed_texture;",),
        f"texture(timed_texture, gl_FragCoord.xy * {1.5 / _TEXTURE}).rgb",
        beside.types,
        beside.arguments,
        textures={"timed_texture": texture},
    )


def _defines(table: FilmTable) -> tuple[str, ...]:
    """Return what a material with this table alone is drawn with."""
    lobe = Effect.DIELECTRIC if table.lobe == "dielectric" else Effect.METAL
    effects = [lobe, Effect.IRIDESCENCE]
    if table.axis("spread_nm") is not None:
        effects += [Effect.IRIDESCENCE_THICKNESS_TEXTURE, Effect.IRIDESCENCE_THICKNESS_SPREAD]
    way = Way(_FILLED_BY, tables=(table,))
    return permutation(MaterialPlan(0, "", tuple(effects), _FILLED_BY, "", "core", way=way), (), ())
