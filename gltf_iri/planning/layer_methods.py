"""Descriptors of the methods for layered mirrors: rough Bragg layers in a host on a base.

All share one sum over the layers (Fourneau et al. 2024, Eq. 34; `gltf_iri.evaluation.layers`) and differ in
the colours of what each layer reflects and lets pass. Light reflected more than once is in none of them.
"""

from __future__ import annotations

from typing import Final

from gltf_iri.planning.method_type import Method, Parameter

__all__ = ["LAYER_METHODS"]

# Twins have two functions: stack_passed stands beside it.
_TWIN: Final = "stack_reflected"

LAYER_METHODS: Final = (
    Method(
        "layers-single",
        "layers",
        "Paths that reflect once, every factor a spectrum, multiplied and integrated until it settles.",
        "Fourneau et al. 2024, Eq. 28 and 34; the filter in closed form",
        is_truth=True,
        glsl_function=_TWIN,
        delta_e_mean=0.0,
        glsl_tables=("spectral_rule",),
    ),
    Method(
        "layers-single-table",
        "layers",
        "The same of one stack, each layer's two spectra read from tables over the cosine.",
        "Fourneau et al. 2024, §5, Model-LUT; linear between even cosines, a fixed rule of wavelengths",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=0.0048,
        parameters=(
            Parameter("nodes", "Cosines from 0 to 1 of each table.", 512, 16.0, 8192.0),
            Parameter(
                "wavelengths", "Steps from 830 to 360 nm, rounded up to an even number.", 128, 16.0, 1024.0
            ),
        ),
    ),
    Method(
        "layers-rgb",
        "layers",
        "Paths that reflect once, every factor a colour, and colours multiplied.",
        "Fourneau et al. 2024, Eq. 28 and 34, over the RGB reflectances of §3.2 or of this project",
        is_truth=False,
        glsl_function=_TWIN,  # which samples the tables of the method for mirrors
        delta_e_mean=2.5,
        parameters=(
            Parameter(
                "reflectance",
                "The method for mirrors that colours the facets.",
                "bloch",
                choices=("bloch", "yeh-spectral", "landmarks", "landmarks-sub"),
            ),
        ),
    ),
    Method(
        "layers-bands",
        "layers",
        "Every factor as its means over a few overlapping bands, multiplied band by band.",
        "this project; spec/decisions/layers-bands.md",
        is_truth=False,
        glsl_function=_TWIN,
        delta_e_mean=0.065,
        glsl_tables=("spectral_rule", "layer_bands"),
        parameters=(Parameter("bands", "How many bands.", 16, 3.0, 64.0),),
    ),
)
