"""What a frame holds: the picture, and beside it everything that its pixels were shaded with.

`INPUT_TARGETS` is the one statement of that layout; the shader's outputs and the reader both follow it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

__all__ = ["BRAGG_INPUT_TARGETS", "INPUT_TARGETS", "LAYER_INPUT_TARGETS", "Frame", "ShadingInputs"]

Float32 = NDArray[np.float32]

# One RGBA32F target a row: (colour in rgb, scalar in a). OpenGL 3.3 promises eight, and these are eight.
INPUT_TARGETS: tuple[tuple[str, str], ...] = (
    ("colour", "material"),  # final linear colour; material index + 1, so that 0 is "nothing drawn here"
    ("normal", "metallic"),  # shading normal in world space, unit, turned towards the viewer
    ("position", "perceptual_roughness"),  # world space, metres
    ("base_color", "iridescence_factor"),  # after texture and vertex colour
    ("dielectric_f0", "specular_weight"),  # min(F0(ior) · specular colour, 1), before the weight
    ("reflected_radiance", "dfg_a"),  # prefiltered image light along the mirror direction, occlusion included
    ("irradiance", "dfg_b"),  # of image light / π, occlusion included; a white environment gives 1
    ("emission", "iridescence_thickness_nm"),
)

# A second set, drawn only where a plan calls for transmission, clearcoat, sheen, anisotropy, a spread of
# thickness or a film over image light's facets. Image light with occlusion, as above.
LAYER_INPUT_TARGETS: tuple[tuple[str, str], ...] = (
    ("transmitted_radiance", "transmission"),  # along the refracted direction, after absorption inside
    ("clearcoat_normal", "clearcoat"),  # unit, turned towards the viewer
    ("clearcoat_radiance", "clearcoat_roughness"),  # prefiltered, along the coat's mirror direction
    ("sheen_color", "sheen_roughness"),
    # Prefiltered with the fibres' lobe; the film's, within the pixel, 0 where the plan has no spread.
    ("sheen_radiance", "iridescence_thickness_std_nm"),
    ("anisotropy_tangent", "anisotropy_strength"),  # world space, unit, in the surface; 0 where there is none
    # Clearcoat: A and B at Nc·V; sheen: directional albedo at N·V. The mean V·H of the facets that send image
    # light, 0 where no film asks for it.
    ("layer_albedos", "facet_cosine"),
)

# A third set, drawn only where a plan has Bragg layers. Image light as the lobe of each sees it, outermost
# first; as the metal below them does, and as a mirror does where their host is not air. The value along which
# the periods of all layers run.
BRAGG_INPUT_TARGETS: tuple[tuple[str, str], ...] = (
    ("bragg_radiance_0", "bragg_factor"),
    ("bragg_radiance_1", "bragg_period_texel"),
    ("bragg_radiance_2", ""),
    ("bragg_radiance_3", ""),
    ("bragg_metal_radiance", ""),
    ("bragg_coating_radiance", ""),
)


@dataclass(frozen=True, slots=True)
class ShadingInputs:
    """One array a quantity, float32, shape (height, width, 3) or (height, width); row 0 is the top.

    Quantities of `LAYER_INPUT_TARGETS` and `BRAGG_INPUT_TARGETS` are 0 where no plan calls for their effect.
    """

    colour: Float32
    material: NDArray[np.int32]  # index into the plan's materials, −1 where nothing was drawn
    normal: Float32
    metallic: Float32
    position: Float32
    perceptual_roughness: Float32
    base_color: Float32
    iridescence_factor: Float32
    dielectric_f0: Float32
    specular_weight: Float32
    reflected_radiance: Float32
    dfg_a: Float32
    irradiance: Float32
    dfg_b: Float32
    emission: Float32
    iridescence_thickness_nm: Float32
    transmitted_radiance: Float32
    transmission: Float32
    clearcoat_normal: Float32
    clearcoat: Float32
    clearcoat_radiance: Float32
    clearcoat_roughness: Float32
    sheen_color: Float32
    sheen_roughness: Float32
    sheen_radiance: Float32
    iridescence_thickness_std_nm: Float32
    anisotropy_tangent: Float32
    anisotropy_strength: Float32
    layer_albedos: Float32
    facet_cosine: Float32
    bragg_radiance_0: Float32
    bragg_factor: Float32
    bragg_radiance_1: Float32
    bragg_period_texel: Float32
    bragg_radiance_2: Float32
    bragg_radiance_3: Float32
    bragg_metal_radiance: Float32
    bragg_coating_radiance: Float32


@dataclass(frozen=True, slots=True)
class Frame:
    """A finished picture: linear Rec.709 radiance before exposure and tone mapping, row 0 at the top."""

    rgba: Float32  # (height, width, 4)
    renderer: str  # OpenGL's own name for what drew it
    milliseconds: float
    notes: tuple[str, ...] = ()
    inputs: ShadingInputs | None = None
    # Milliseconds of each part: image light, uploads (and compiling), opaque, captures, see-through, …
    passes: Mapping[str, float] = field(default_factory=dict)
