"""The tolerances that reports state and that bound GLSL and truth, each with the reason for its size.

Tests and reports read them from here. A bound that belongs to one test stands in that test.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "COLOUR_CONVERGENCE",
    "GLSL_BLOCH_MAX_ABS",
    "GLSL_BLOCH_THICK_MAX_ABS",
    "GLSL_BRANCH_ULP",
    "GLSL_FILM_DELTA_E",
    "GLSL_LANDMARKS_GRAZING_MAX_ABS",
    "GLSL_LANDMARKS_HALVED_MAX_ABS",
    "GLSL_LANDMARKS_MAX_ABS",
    "GLSL_LANDMARKS_THICK_MAX_ABS",
    "GLSL_LAYERS_MAX_ABS",
    "GLSL_MIRROR_COLOUR_MAX_ABS",
    "GLSL_OPTICS_MAX_ABS",
    "GLSL_PIXEL_RELATIVE",
    "GLSL_PIXEL_ROUGHNESS_MIN",
    "GLSL_SPREAD_MAX_ABS",
    "MIXED_LOBES_DELTA_E",
    "REFERENCE_DEPTH_RELATIVE",
    "REFERENCE_EDGE_PX",
    "REFERENCE_STEP_PX",
    "SPECTRAL_COLOUR_MAX_ABS",
    "SPECTRAL_REFLECTANCE_MAX_ABS",
    "SPECTRAL_VERSUS_TMM_MAX_ABS",
    "SPREAD_TABLE_ERROR",
]

# Truth refines its wavelength nodes until no channel moves by more: far below what 8 bits or an eye resolve,
# and reachable in float64 for films of every thickness up to some tens of micrometres.
COLOUR_CONVERGENCE: Final = 1e-9

# float64 Airy reflectance against 50 digits: a few dozen roundings of 1.1e-16, magnified by sharp resonances.
SPECTRAL_REFLECTANCE_MAX_ABS: Final = 1e-14
SPECTRAL_COLOUR_MAX_ABS: Final = 1e-9

# The tmm package loses digits in its own matrix product towards grazing angles; compared at cosθ ≥ 0.01.
SPECTRAL_VERSUS_TMM_MAX_ABS: Final = 1e-12

# float32 GLSL against float64 Python on equal float32 inputs: phases reach some hundred radians, of which
# float32 keeps 1e-5; the sensitivities' Gaussians damp them first.
GLSL_OPTICS_MAX_ABS: Final = 5e-6

# Sensitivities under a spread of path differences, between the 26 spreads that are tabulated: 9e-5 of white
# at worst, half way between two of them. A film's fringes are never half as strong as all of its light.
SPREAD_TABLE_ERROR: Final = 1e-4
GLSL_SPREAD_MAX_ABS: Final = 5e-5

# A mirror's colour by the same rule in both: at one wavelength float32 errs by what a step of the wavelength
# does, up to 1e-4 at the narrow fringes of ten cells; over the spectrum such errors take turns in sign.
GLSL_MIRROR_COLOUR_MAX_ABS: Final = 5e-6

# Rows so close to one of the text's own branches (film index = base index, …) may fall on either side.
GLSL_BRANCH_ULP: Final = 8

# What single precision adds to the CIEDE2000 of a film's colour in GLSL: p95 over the sets of dielectric,
# metallic and thick films, every twin within ΔE 30 of the truth against its Python (7e-5 at most, measured by
# `bench accuracy`; rounding of 1e-6 in colour), rounded up. Budgets below it are not kept in GLSL.
GLSL_FILM_DELTA_E: Final = 1e-4

# Mirrors by landmarks: some twenty boxes, each two looked-up integrals and an envelope of float32. In cells
# of 0.1 mm the gaps lie a thousand modes up, where float32 places them to 1e-4. Where grazing light (cosθ
# below 1e-3) meets a film of 1e-6 nm, r12 differs from 1 by less than float32 sees. A halving that compares
# two equal numbers may go either way, and leaves the landmark a thousandth of a mode off.
GLSL_LANDMARKS_MAX_ABS: Final = 1e-5
GLSL_LANDMARKS_THICK_MAX_ABS: Final = 1e-4
GLSL_LANDMARKS_GRAZING_MAX_ABS: Final = 4e-3
GLSL_LANDMARKS_HALVED_MAX_ABS: Final = 6e-3

# Stacks of rough layers by the same rules in both, and a BRDF relative to max(1, f_r). At single wavelengths,
# with up to 30 cells of 1 µm, two rows in a thousand err by more, up to 7e-4: all of them where four float32
# steps of thicknesses, cosines or facets' angles do as much. By the whole rule, of 100,000 layers and 10,000
# pairs, 2 reflections, 27 of what passes and 29 of f_r err by more, up to 4e-4, again where such steps do
# (`bench layers-agreement`).
GLSL_LAYERS_MAX_ABS: Final = 1e-5

# Mirrors by bloch: a dozen samples of float32, whose weights add up to six. In cells of 0.1 mm float32 keeps
# 1e-5 of a turn of the phase; towards grazing light, 1e-4 of what a contrast of 10⁴ lets through.
GLSL_BLOCH_MAX_ABS: Final = 4e-5
GLSL_BLOCH_THICK_MAX_ABS: Final = 2e-4

# A whole shaded pixel, relative to max(1, value): the GGX lobe amplifies the rounding of N·H by 1/α².
GLSL_PIXEL_RELATIVE: Final = 2e-4

# Perceptual roughness from which a pixel is judged; below, 1/α² > 625 and the lobe is reported apart.
GLSL_PIXEL_ROUGHNESS_MIN: Final = 0.2

# How far apart two renderers may see the same surface through the same pixel: float32 positions of 1e-7, over
# the slant of what is nearly edge-on.
REFERENCE_DEPTH_RELATIVE: Final = 1e-4

# How near to an edge two renderers may see the triangles on either side of it: OpenGL rounds corners to 1/256
# pixel (eight bits below the pixel here and on graphics cards), which moves an edge by up to 0.7 of that.
REFERENCE_EDGE_PX: Final = 1.0 / 256.0

# How far from a pixel's centre OpenGL may read a texture or a normal: float32 coordinates of textures of 2048
# texels keep 1e-4 of a texel. Pixels that so small a step changes by more than the tolerance are not judged.
REFERENCE_STEP_PX: Final = 1.0 / 4096.0

# By how much the ΔE of a metal and a dielectric mixed may exceed that of either: their colours may take
# each other's chroma away, and CIEDE2000 weighs the same step more in grey. Of three methods on 60 random
# materials at seven metalnesses, one mix in fifteen exceeded it at all, and the worst by 1.68. What tables
# err by turns its sign from place to place, and mixes to less (1.02 at most, of twelve materials).
MIXED_LOBES_DELTA_E: Final = 1.7
