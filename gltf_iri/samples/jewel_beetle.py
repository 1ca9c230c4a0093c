"""A jewel beetle: three areas of its back, each with a mirror of its own, in air."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.bragg_layer import BLACK, bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import Shape, merge
from gltf_iri.samples.wing_case import Shell

__all__ = ["AREAS", "FALLBACK_F0", "build"]

Float64 = NDArray[np.float64]

# Area → index of the denser film, met first, index of the other, period in nm, share of the first, cells.
AREAS: Final = {
    "green": (1.67, 1.59, 160.0, 0.49, 8),
    "red": (1.68, 1.60, 190.0, 0.49, 8),
    "purple": (1.68, 1.60, 205.0, 0.49, 6),
}
ALPHA: Final = 0.05

# What each mirror reflects at normal incidence, linear Rec.709 under D65, cut off at 0.
FALLBACK_F0: Final = {
    "green": (0.0, 0.208, 0.059),
    "red": (0.277, 0.059, 0.055),
    "purple": (0.1, 0.057, 0.058),
}

_CASES: Final = Shell(half_width_m=0.0060, height_m=0.0052, half_length_m=0.0130, taper=0.22)
_PRONOTUM: Final = Shell(0.0057, 0.0043, 0.0038, taper=-0.25, is_grooved=False)
_HEAD: Final = Shell(0.0036, 0.0027, 0.0026, taper=-0.05, is_grooved=False)
_PRONOTUM_AT, _HEAD_AT = (0.0, -0.0002, -0.0142), (0.0, -0.0006, -0.0182)
_SIDE_RAD: Final = 1.85  # where the back turns under
_PITS, _PIT_SLOPE, _RIBS_SLOPE = 22.0, 0.05, 0.06


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("jewel-beetle")
    relief = builder.texture("relief", encode_png(to_bytes(_relief())), repeat=True)
    materials = {
        area: builder.material(
            f"{area} cuticle",
            base_color=BLACK,
            metallic=0.0,
            roughness=round(sqrt(ALPHA), 6),
            normal_texture=relief,
            normal_repeats=_PITS,
            extensions={**tinted_surface(FALLBACK_F0[area]), "EXT_materials_bragg": _stack(area)},
        )
        for area in AREAS
    }
    for area, shape in _areas(_CASES, columns=8, rows=28).items():
        builder.mesh(f"wing cases, {area}", shape, materials[area])
    for area, shape in _areas(_PRONOTUM, columns=4, rows=12).items():
        builder.mesh(f"pronotum, {area}", shape, materials[area], translation_m=_PRONOTUM_AT)
    whole = _HEAD.band(_at(-_SIDE_RAD), _at(_SIDE_RAD), 16, 10)
    builder.mesh("head", whole, materials["green"], translation_m=_HEAD_AT)
    builder.perspective_camera((0.027, 0.040, 0.020), (0.0008, 0.0, -0.0038), 0.5)
    builder.directional_light((-0.3, -0.9, 0.2), 1.0)
    return Sample(
        name="jewel-beetle",
        title="Jewel beetle",
        shows="Three mirrors of eight and six cells on black cuticle: green wing cases with purple stripes.",
        look_for=(
            "Seen face on the back is green, its stripes purple-red between red edges; each slides "
            "towards shorter waves as the shell turns away: green to blue and violet, red to yellow and "
            "green, and the stripes from dark red through red to orange, brighter than face on, because "
            "their mirror's best wave is at 672 nm, where the eye sees little.\n\n"
            "The mirrors lie in air and their films are all denser than it, so air's own surface is part "
            "of each: of this extension only a stack's last layer may be such a one, over a base without "
            "metal and transmission. The denser film is met first: its surface reflects in step with the "
            "cells. Met in the other order the two work against each other, and 33 % at 521 nm become a "
            "grey that any wave keeps below 13 %."
        ),
        fallback=(
            "Each area has as its specular colour what its mirror reflects face on "
            "(KHR_materials_specular, which the layers stand in place of): a green "
            "beetle with red and purple stripes, which keeps its colours as it turns and pales towards the "
            "silhouette."
        ),
        sources=(
            "Indices, periods and cells: Fourneau and others, Computer Graphics Forum (2024), Table 3, "
            "with its roughness of 0.05, which is α (√0.05 in the file). The table's first film has the "
            "lower index and 0.51 of the period; which one the light meets first it does not say, and "
            "the denser one is met first here, since only then there is a band: at 521 nm for green and "
            "672 nm for purple, where Stavenga and others, Phil. Trans. R. Soc. B 366, 709 (2011), "
            "measured about 530 and 700 nm. The wing cases are 26 mm long; their shape and their pits "
            "are invented."
        ),
        files=builder.to_glb(),
    )


def _stack(area: str) -> dict[str, Any]:
    ior_1, ior_2, period_nm, fill, cells = AREAS[area]
    layer = {
        "ior1": ior_1,
        "ior2": ior_2,
        "periodMinimum": period_nm,
        "periodMaximum": period_nm,
        "fill": fill,
        "cells": cells,
        "roughness": round(sqrt(ALPHA), 6),
    }
    return bragg_stack(layer)


def _areas(shell: Shell, columns: int, rows: int) -> dict[str, Shape]:
    """Return the shell by areas: a purple stripe between red edges on either side of the middle."""
    inner_red, inner, outer, outer_red = (_edge(offset) for offset in (-0.26, -0.17, 0.17, 0.26))
    half = {
        "green": [(_at(0.0), inner_red), (outer_red, _at(_SIDE_RAD))],
        "red": [(inner_red, inner), (outer, outer_red)],
        "purple": [(inner, outer)],
    }
    shapes = {}
    for area, bands in half.items():
        count = columns if area == "green" else 4
        right = [shell.band(first, last, count, rows) for first, last in bands]
        left = [shell.band(_opposite(last), _opposite(first), count, rows) for first, last in bands]
        shapes[area] = merge(left + right)
    return shapes


def _edge(offset_rad: float) -> Callable[[Float64], Float64]:
    """Return an edge of the stripe, which narrows towards both ends of the shell."""
    return lambda psi: 0.72 + offset_rad * np.sin(psi) ** 0.5


def _at(azimuth_rad: float) -> Callable[[Float64], Float64]:
    return lambda psi: np.full_like(psi, azimuth_rad)


def _opposite(edge: Callable[[Float64], Float64]) -> Callable[[Float64], Float64]:
    return lambda psi: -edge(psi)


def _relief() -> Float64:
    """Return (64, 64, 3) tangent-space normals of one rib with a row of pits, as (n + 1)/2."""
    u, v = texel_centres(64, 64)
    across, down = 2.0 * np.pi * u, 2.0 * np.pi * v
    slope_x = _RIBS_SLOPE * np.sin(across) + _PIT_SLOPE * np.sin(2.0 * across) * np.cos(2.0 * down)
    slope_y = -_PIT_SLOPE * np.cos(2.0 * across) * np.sin(2.0 * down)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(u)], axis=-1)
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True) * 0.5 + 0.5)
