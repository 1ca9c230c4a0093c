"""What is said of KHR_materials_iridescence beyond the Khronos codes: severity, sentence, and why.

An error is what the extension's text forbids ("must not"); a warning, a material that cannot look as its
values ask; information, what is legal and looks different from what one may expect; a hint, what only some
readers stumble over. Sections are those of the extension's README; versions of renderers are those whose
source was read: three.js 0.187, Babylon.js 9.34, the Khronos sample renderer 1.1.0, PlayCanvas 2.23.
"""

from __future__ import annotations

from gltf_iri.validation.issue import ERROR, HINT, INFORMATION, WARNING

__all__ = ["IRIDESCENCE_CODES", "IRIDESCENCE_REASONS", "NAME"]

NAME = "KHR_materials_iridescence"

_STATED: dict[str, tuple[int, str, str]] = {
    "IRI_IRIDESCENCE_EXCLUDED": (
        ERROR,
        "{other} must not stand on a material with KHR_materials_iridescence.",
        "Exclusions: it must not share a material with either, unlit or pbrSpecularGlossiness.",
    ),
    "IRI_IRIDESCENCE_UNUSED": (
        INFORMATION,
        "No material uses KHR_materials_iridescence.",
        "Extending Materials: the extension stands on materials only; readers prepare for it in vain.",
    ),
    "IRI_IRIDESCENCE_FACTOR_ZERO": (
        WARNING,
        "iridescenceFactor is {given}, so there is no film; without effect: {settings}.",
        "Properties: at factor 0, the default, the extension has no effect; nobody sets a film to hide it.",
    ),
    "IRI_IRIDESCENCE_IDLE": (
        INFORMATION,
        "iridescenceFactor is {given}: the extension has no effect on this material.",
        "Properties: at factor 0, the default, the extension has no effect; it can be left out.",
    ),
    "IRI_IRIDESCENCE_FILM_IS_AIR": (
        WARNING,
        "The film's index is the outside's, 1: the extension's formula draws a film that is not there.",
        "Material Interfaces: Schlick's term at F0 = 0 still reflects all grazing light, and the floor of "
        "R123 draws fringes; three.js, Babylon.js and the Khronos sample renderer follow the text in it.",
    ),
    "IRI_IRIDESCENCE_FILM_IS_BASE": (
        WARNING,
        "The film's index {ior:g} is that of its base, {lobe}: there is no film to see.",
        "Properties, iridescenceIor: the more it differs from the base's, the stronger; equal means none. "
        "The floor of R123 still draws fringes, but in Babylon.js, which leaves such a film out.",
    ),
    "IRI_IRIDESCENCE_FILM_IS_DIELECTRIC": (
        INFORMATION,
        "The film's index {ior:g} is that of the dielectric base: a film is only where there is metal.",
        "Properties, iridescenceIor: the more it differs from the base's, the stronger; equal means none.",
    ),
    "IRI_IRIDESCENCE_IOR_ABSURD": (
        WARNING,
        "No transparent matter has an index of {ior:g}.",
        "Properties: the schema has no upper bound. Germanium, in the infrared, has 4; in visible light "
        "gallium phosphide, the densest of the clear crystals, has 3.3 to 4.1, and films of oxides up to 3.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_ZERO": (
        WARNING,
        "The film is 0 nm thick everywhere: there is none, and renderers draw different things.",
        "Phase Shift: at thickness 0 the text's series is not the bare base. three.js in WebGL and the "
        "Khronos sample renderer set the factor to 0 there; Babylon.js and three.js in WebGPU take the "
        "index 1.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_TINY": (
        WARNING,
        "A film of {nm:g} nm at most is a few atoms thick; thicknesses are in nanometres.",
        "Properties: in nanometres. Other formats count micrometres (OpenPBR) or metres (all else in glTF).",
    ),
    "IRI_IRIDESCENCE_THICKNESS_ABSURD": (
        WARNING,
        "A film of {mm:g} mm is no thin film; thicknesses are in nanometres.",
        "Properties: in nanometres, without an upper bound. No colours are left four orders below this.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_INCOHERENT": (
        INFORMATION,
        "From {nm:.0f} nm on, this film's fringes are too fine to be seen: it is grey, or as its base is.",
        "Properties: more thickness, more pastel. Straight on, 1,500 random films (index up to 4) are within "
        "ΔE 1 of their mean over all phases from a path difference of 6.5 µm on.",
    ),
    "IRI_IRIDESCENCE_MINIMUM_ABOVE_MAXIMUM": (
        INFORMATION,
        "The minimum, {minimum:g} nm, is above the maximum, {maximum:g} nm: white texels are the thin ones.",
        "Properties: the minimum MAY be greater. Legal since 2024 (KhronosGroup/glTF 2442); validators of "
        "before that call it an error.",
    ),
    "IRI_IRIDESCENCE_BASE_REFLECTS_ALL": (
        WARNING,
        "The base, {lobe}, reflects all light: no film can be seen on it, and the formula, which PlayCanvas "
        "follows, is undefined.",
        "Material Interfaces: baseF0 + 0.0001 divides by zero at 0.9999 and makes the base's index negative "
        "above. PlayCanvas does so; three.js, Babylon.js and the Khronos sample renderer cut F0 to 0.9999.",
    ),
    "IRI_IRIDESCENCE_BASE_F0_UNDEFINED": (
        INFORMATION,
        "The base, {lobe}, reflects all of {channels}: the formula, which PlayCanvas follows, is undefined "
        "there.",
        "Material Interfaces: baseF0 + 0.0001 divides by zero at 0.9999 and makes the base's index negative "
        "above, which turns the phase; red's is that of X, so that all channels change (gold by ΔE 6). "
        "PlayCanvas does so; three.js, Babylon.js and the Khronos sample renderer cut F0 to 0.9999.",
    ),
    "IRI_IRIDESCENCE_INDEX_ORDER": (
        HINT,
        "The film's index {ior:g} is above its base's, {lobe}: the formula, which PlayCanvas follows, takes "
        "pow() of a negative number.",
        "Material Interfaces: IorToFresnel0 squares by pow(x, 2.0), which GLSL leaves undefined below 0. "
        "PlayCanvas has it so; three.js, Babylon.js and the Khronos sample renderer multiply x by x.",
    ),
    "IRI_IRIDESCENCE_UNDER_CLEARCOAT": (
        INFORMATION,
        "The clearcoat's interface with the film is ignored; Babylon.js takes the coat for the film's "
        "outside{reflected}.",
        "Clearcoat: the additional interface is ignored, and outside_ior stays 1. Babylon.js sets it to the "
        "coat's 1.5; a film of a lower index is then under total reflection towards grazing light.",
    ),
    "IRI_IRIDESCENCE_TEXCOORD_OVERRIDDEN": (
        INFORMATION,
        "texCoord is {given} here and {winner} in KHR_texture_transform, which wins where it is known.",
        "KHR_texture_transform, texCoord: overrides the textureInfo's if the extension is supported.",
    ),
    "IRI_IRIDESCENCE_COLOUR_SPACE": (
        WARNING,
        "The image holds linear data here and an sRGB colour for {other}: one of both is not what is meant.",
        "Properties: all textures are in linear space. The same bytes cannot be a well-chosen colour and a "
        "well-chosen thickness, and readers that decode an image once are wrong in one of both.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_BANDING": (
        INFORMATION,
        "A step of the 8-bit texture is {step:.2g} nm and up to ΔE {delta_e:.2g}: ramps show bands.",
        "Properties: texels choose between minimum and maximum in 255 steps. Told from ΔE 1 on, straight on; "
        "of a base colour with a texture, half the factor is taken.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_16_BITS": (
        INFORMATION,
        "Readers that keep 8 of the 16 bits, as browsers do, make steps of {step:.2g} nm, up to ΔE "
        "{delta_e:.2g}.",
        "glTF 2.0, 3.8.3: PNG may have 16 bits, and most loaders decode into 8. Told where those would band.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_LOSSY": (
        INFORMATION,
        "Thickness in a {format}: compression made for colours adds waves and blocks to the film.",
        "Properties: G is data. JPEG and lossy WebP round frequencies of brightness and colour in blocks, "
        "which comes back as waves in G.",
    ),
    "IRI_IRIDESCENCE_THICKNESS_GREY": (
        HINT,
        "The image is grey, and its one channel serves as G; tools that pack it into R leave no thickness.",
        "Properties, iridescenceThicknessTexture: sampled from G. PNG readers repeat grey in R, G and B; "
        "one-channel textures of graphics APIs have R only.",
    ),
    "IRI_IRIDESCENCE_ONE_CHANNEL": (
        INFORMATION,
        "The image is grey: strength and thickness are the same values, and the thinnest film is invisible.",
        "Properties: R is the strength and G the thickness, which one grey channel cannot tell apart.",
    ),
}

IRIDESCENCE_CODES: dict[str, tuple[int, str]] = {code: stated[:2] for code, stated in _STATED.items()}

# Code to what the remark rests on, for those who ask.
IRIDESCENCE_REASONS: dict[str, str] = {code: reason for code, (_, _, reason) in _STATED.items()}
