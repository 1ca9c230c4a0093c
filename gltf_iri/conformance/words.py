"""What the heads of the vector files say: conventions, and tolerances with their reasons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

__all__ = ["BRAGG_WORDS", "COLOURS", "KHR_WORDS", "Words"]

# Quantities that are colours, of which CIEDE2000 says something.
COLOURS: Final = frozenset(
    {"layer_colours", "base_colour", "entering", "transmitted", "truth", "khr", "khr_guarded"}
)


@dataclass(frozen=True, slots=True)
class Words:
    """One file's head. tolerances : quantity → absolute, relative, reason; an error may be a + r·|value|."""

    what: str
    colours: str
    conventions: Mapping[str, str]
    tolerances: Mapping[str, tuple[float, float, str]]


_COLOURS: Final = (
    "linear Rec.709, M ∫ S D65 (x̄, ȳ, z̄) dλ / ∫ D65 ȳ dλ, each row of M scaled so that S = 1 gives (1, 1, 1);"
    " not clamped: a channel may be negative"
)

_OF_R: Final = (
    "a closed form; decimals kept end at 5e-10, and sharp bands magnify last bits of phases to 1e-11"
)
_OF_COLOUR: Final = (
    "wavelengths 0.1 nm apart reach it in 97 of 100 rows, and sharp bands of many cells want panels that are"
    " halved until nothing moves; reading a rule differently moves colours by more than 1e-3"
)
_OF_BRDF: Final = "a colour's, times a lobe of up to some ten"

BRAGG_WORDS: Final = Words(
    what="Test vectors of EXT_materials_bragg: what the single-reflection model gives, converged to 1e-9",
    colours=_COLOURS,
    conventions=MappingProxyType(
        {
            "material": "a glTF material",
            "bragg_texture": "r of braggTexture",
            "period_texture": "g of braggPeriodTexture",
            "cos_theta_i": "of the light's angle outside",
            "cos_theta_o": "of the viewer's angle outside",
            "cos_phi": "of the turn between light and viewer about the normal: at -1 the viewer stands in the"
            " light's plane on the side of its mirror image, at 1 on the light's own side",
            "reflectance": "per layer and wavelength: mean of s and p of a facet that is met at the angle"
            " between light and half vector, both in the host; a step from it to another ior1 belongs to it",
            "transmittance": "per layer and wavelength: T of light at cos_theta_i, bent into the host",
            "layer_colours": "per layer: C_l, the colour of R_l times T_k(i) T_k(o) of all layers above it",
            "base_colour": "C_b, the colour of T_k(i) T_k(o) of all layers",
            "entering": "the colour of T_k(o) of all layers, without the smooth surface of the host",
            "transmitted": "T_c(o) (1 - metallic) transmission baseColor entering, the factor of the specular"
            " BTDF where bragg is 1",
            "coating_reflectance": "1 - T_c of the host's smooth surface at cos_theta_i; 0 in air (a"
            " mirror image seen at cos_theta_o takes the same function of that cosine)",
            "stack_brdf": "f_r in 1/sr where bragg is 1, without the host's mirror image; null where a layer"
            " has roughness 0: its mirror image is no number",
            "brdf": "(1 - bragg) core + bragg stack_brdf; core is glTF 2.0 Appendix B: a metal and, of index"
            " 1.5, fresnel_mix(diffuse (1 - transmission), specular), both lobes GGX with height-correlated"
            " Smith masking and alpha = roughnessFactor squared, light and viewer outside. What a BTDF sends"
            " is no part of either; null where stack_brdf is and bragg is above 0",
            "no effect": "where no layer has an effect (none are there, or a rule about ior1 is broken) lists"
            " are empty, the rest null, and brdf is the core's; where bragg is 0 brdf is the core's too, and"
            " the layers' quantities are told as if it were not",
        }
    ),
    tolerances=MappingProxyType(
        {
            "reflectance": (1e-8, 0.0, _OF_R),
            "transmittance": (
                1e-5,
                0.0,
                "a sum over facets' angles: some hundred Gauss points for few cells, thousands for many, and"
                " for few of ior2 below the host's index, where panels should end at the critical angle",
            ),
            "layer_colours": (1e-5, 0.0, _OF_COLOUR),
            "base_colour": (1e-5, 0.0, _OF_COLOUR),
            "entering": (1e-5, 0.0, _OF_COLOUR),
            "transmitted": (1e-5, 0.0, _OF_COLOUR),
            "coating_reflectance": (1e-8, 0.0, "a closed form"),
            "stack_brdf": (1e-5, 1e-5, _OF_BRDF),
            "brdf": (1e-5, 1e-5, _OF_BRDF),
        }
    ),
)

KHR_WORDS: Final = Words(
    what="Test vectors of KHR_materials_iridescence: what its text gives, and what is true",
    colours=_COLOURS + "; khr and khr_guarded as their formulas give them",
    conventions=MappingProxyType(
        {
            "base_f0": "a metal's RGB reflectance along the normal under air; in truth each channel's base"
            " has the real index (1 + √F0)/(1 - √F0), its own",
            "base_ior": "a dielectric's index; the text gets ((n - 1)/(n + 1))² in all channels",
            "cos_theta_1": "of the outside angle",
            "reflectance": "per wavelength, of the base of each channel: mean of s and p of all"
            " inter-reflections, exact",
            "truth": "the colour of those spectra, each channel from its own base's",
            "khr": "iridescent_fresnel of the extension's implementation notes, factor 1, x·x for its"
            " pow(x, 2.0); null where it divides by zero or its base index turns negative, and why",
            "khr_guarded": "the same with its undefined and discontinuous cases closed",
            "khr_delta_e": "CIEDE2000 between khr and truth, negative channels cut to 0",
        }
    ),
    tolerances=MappingProxyType(
        {
            "reflectance": (1e-8, 0.0, "a closed form; decimals kept end at 5e-10"),
            "truth": (
                1e-5,
                0.0,
                "wavelengths 0.5 nm apart reach it in every row, 1 nm apart in 96 of 100",
            ),
            "khr": (
                1e-7,
                0.0,
                "closed forms, magnified where R123 is cut at 0.9999 and where Gaussians cancel",
            ),
            "khr_guarded": (1e-7, 0.0, "closed forms, as khr"),
            "khr_delta_e": (1e-3, 0.0, "what a step of 1e-5 does to dark colours, of the truth's tolerance"),
        }
    ),
)
