"""The codes for EXT_materials_bragg: errors only where the proposal's text says MUST."""

from __future__ import annotations

from gltf_iri.validation.issue import ERROR, HINT, INFORMATION, WARNING

__all__ = ["BRAGG_CODES"]

BRAGG_CODES: dict[str, tuple[int, str]] = {
    "IRI_BRAGG_EXCLUDED": (ERROR, "Layers must not stand beside {other} on one material."),
    "IRI_BRAGG_FIRST_INDEX": (ERROR, "ior1 is {ior1}, and must be hostIor, {host}: {reason}."),
    "IRI_BRAGG_FIRST_INDEX_ANIMATED": (
        ERROR,
        "{ior1} must be hostIor or lie over a base without direction at every time: {reason}.",
    ),
    "IRI_BRAGG_BEYOND_LIMITS": (
        WARNING,
        "{value} is more than the {accepted} that every reader must accept, and gltf-iri draws up to "
        "{drawn}; readers that accept less ignore all layers of the material.",
    ),
    "IRI_BRAGG_REQUIRED": (
        WARNING,
        "The core material is what other viewers show: the extension should not be required.",
    ),
    "IRI_BRAGG_UNUSED": (INFORMATION, "No material has layers."),
    "IRI_BRAGG_NO_LAYERS": (INFORMATION, "Without layers the extension has no effect."),
    "IRI_BRAGG_FACTOR_ZERO": (WARNING, "braggFactor is 0{by_default}: the layers have no effect."),
    "IRI_BRAGG_NO_MIRROR": (WARNING, "The second film reflects nothing: {reason}."),
    "IRI_BRAGG_ONE_FILM": (
        INFORMATION,
        "fill is 0: the cells merge into one film of ior2, {cells} periods thick.",
    ),
    "IRI_BRAGG_ONE_CELL": (HINT, "One cell is a single film of ior2: there is no periodic mirror."),
    "IRI_BRAGG_BAND_INVISIBLE": (
        INFORMATION,
        "The longest band lies at {nm:.5g} nm and is {width:.3g} nm wide: all of it is below {end:g} nm, "
        "where nothing is seen.",
    ),
    "IRI_BRAGG_WASHED_OUT": (
        INFORMATION,
        "Cells {nm:.5g} nm thick, as light counts it, have {orders:.3g} bands within what is seen: their "
        "colours add up to grey.",
    ),
    "IRI_BRAGG_PERIODS_REVERSED": (
        INFORMATION,
        "periodMinimum, {low:g}, is greater than periodMaximum, {high:g}: brighter texels are thinner cells.",
    ),
    "IRI_BRAGG_PERIOD_RANGE_WITHOUT_TEXTURE": (
        INFORMATION,
        "Without a period texture periodMaximum holds everywhere, and periodMinimum has no effect.",
    ),
    "IRI_BRAGG_PERIOD_TEXTURE_UNUSED": (
        INFORMATION,
        "Minimum and maximum of every layer's period are the same: the texture changes nothing.",
    ),
    "IRI_BRAGG_TEXCOORD_OVERRIDDEN": (
        INFORMATION,
        "texCoord is {given} here and {winner} in KHR_texture_transform, which wins where it is known.",
    ),
    "IRI_BRAGG_COLOUR_SPACE": (
        WARNING,
        "The image holds linear data here and an sRGB colour for {other}: one of both is not what is meant.",
    ),
    "IRI_BRAGG_PERIOD_BANDING": (
        INFORMATION,
        "A step of the 8-bit texture is {step:.2g} nm and up to ΔE {delta_e:.2g}: ramps show bands.",
    ),
    "IRI_BRAGG_PERIOD_16_BITS": (
        INFORMATION,
        "Readers that keep 8 of the 16 bits, as browsers do, make steps of {step:.2g} nm, up to ΔE "
        "{delta_e:.2g}.",
    ),
    "IRI_BRAGG_PERIOD_LOSSY": (
        INFORMATION,
        "Periods in a {format}: compression made for colours adds rings and blocks to the layers.",
    ),
    "IRI_BRAGG_PERIOD_GREY": (
        HINT,
        "The image is grey, and its one channel serves as G; tools that pack it into R leave no periods.",
    ),
    "IRI_BRAGG_ONE_CHANNEL": (
        INFORMATION,
        "The image is grey: strength and periods are the same values, so layers are strong where G is great.",
    ),
}
