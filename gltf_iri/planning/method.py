"""Descriptors of the methods: what each computes, where it is valid, what it costs and how wrong it may be.

The plan chooses by these; `gltf_iri.evaluation.registry` binds the same names to functions, and a test keeps
both sets equal.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from gltf_iri.errors import UsageError
from gltf_iri.planning.layer_methods import LAYER_METHODS
from gltf_iri.planning.method_type import Domain, Method, Parameter, ParameterValue

__all__ = ["DEFAULT_LAYERS_METHOD", "DEFAULT_METHOD", "DEFAULT_MIRROR_METHOD", "METHODS", "Domain"]
__all__ += ["Method", "Parameter"]
__all__ += ["ParameterValue", "find_method", "method_names", "parameters_text", "truth_of"]

DEFAULT_METHOD: Final = "khr-guarded"
DEFAULT_MIRROR_METHOD: Final = "yeh-spectral"
DEFAULT_LAYERS_METHOD: Final = "layers-single"

# Bounds and words of the formulas stand here a second time, and a test holds both equal: the formulas import
# numpy, for which `--help` cannot wait.
_GRID_SAMPLES = Parameter("samples", "Wavelengths from 360 to 830 nm, evenly spaced.", 31, 3.0, 471.0)

_FILM_METHODS = (
    Method(
        "khr",
        "film",
        "The extension's text to the letter; its undefined cases stay undefined and are recorded.",
        "KHR_materials_iridescence, Implementation Notes, Iridescence Fresnel",
        is_truth=False,
        glsl_function="iridescent_fresnel_khr",
        delta_e_mean=3.86,
        backends=("numpy", "numba"),
    ),
    Method(
        "khr-guarded",
        "film",
        "The extension's formula with its undefined and discontinuous cases closed.",
        "KHR_materials_iridescence; guards in spec/iridescence-notes.md",
        is_truth=False,
        glsl_function="iridescent_fresnel_khr_guarded",
        delta_e_mean=3.25,
    ),
    Method(
        "granier-heidrich",
        "film",
        "Two interfering Phong lobes at one wavelength a channel; here at the mirror direction, lobes of 1.",
        "Granier & Heidrich 2003, Eq. 3-11",
        is_truth=False,
        glsl_function="iridescent_fresnel_granier_heidrich",
        delta_e_mean=47.6,
    ),
    Method(
        "naive-rgb",
        "film",
        "Exact Airy reflectance at one wavelength a channel, the peaks of Rec.709's weights under D65.",
        "Belcour & Barla 2017, §4.1, Fig. 7a",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=2.79,
        parameters=(
            Parameter("red_nm", "The wavelength that stands for red.", 605.0, 360.0, 830.0),
            Parameter("green_nm", "The wavelength that stands for green.", 535.0, 360.0, 830.0),
            Parameter("blue_nm", "The wavelength that stands for blue.", 450.0, 360.0, 830.0),
        ),
    ),
    Method(
        "smits-meyer",
        "film",
        "Two beams of unpolarised Fresnel reflectances, no inter-reflections, no conductor; dense spectrum.",
        "Smits & Meyer 1992, as described in Belcour & Barla 2017, §2 and §4.1",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=2.99,
    ),
    Method(
        "bb17",
        "film",
        "The Fourier series of exact interfaces with Gaussian fits of the observer, cut at a fixed order.",
        "Belcour & Barla 2017, Eq. 10; the fits of KHR_materials_iridescence; its white is E",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=0.63,
        parameters=(Parameter("orders", "The highest order of the fringes.", 3, 1.0, 3.0),),
    ),
    Method(
        "fourier",
        "film",
        "The Fourier series of exact polarised interfaces, tabulated sensitivities, terms by an error bound.",
        "Belcour & Barla 2017, Eq. 5-10; bound and table in gltf_iri/evaluation/fourier.py",
        is_truth=False,
        glsl_function="iridescent_fresnel_fourier",
        delta_e_mean=0.0024,
        parameters=(
            Parameter("tolerance", "The most that the terms left out may add up to.", 1e-4, 1e-9, 0.1),
        ),
        backends=("numpy", "numba"),
        glsl_tables=("film_sensitivity", "spectral_rule"),
        glsl_spread_function="iridescent_fresnel_fourier_spread",
        glsl_spread_tables=("film_sensitivity_spread", "spectral_rule"),
    ),
    Method(
        "spectral-grid",
        "film",
        "Exact Airy reflectance, both polarisations, at a fixed number of evenly spaced wavelengths.",
        "Belcour & Barla 2017, Eq. 2-3; trapezoidal sums, as spectral renderers and tools take them",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=0.03,
        parameters=(_GRID_SAMPLES,),
    ),
    Method(
        "incoherent",
        "film",
        "The constant term of the Fourier series: the film without its fringes.",
        "Belcour & Barla 2017, Eq. 5-6, m = 0",
        is_truth=False,
        glsl_function="iridescent_fresnel_incoherent",
        delta_e_mean=10.54,
    ),
    Method(
        "spectral",
        "film",
        "Exact Airy reflectance, both polarisations, integrated over the spectrum until it no longer moves.",
        "Belcour & Barla 2017, Eq. 2-3; Airy summation",
        is_truth=True,
        glsl_function="iridescent_fresnel_spectral",
        delta_e_mean=0.0,
        glsl_tables=("spectral_rule",),
    ),
)

_ROOT_FINDER = Parameter(
    "root_finder",
    "How landmarks are sought: Newton steps from a closed-form guess, or halvings between modes.",
    "newton-2",
    choices=("newton-2", "newton-1", "bisect-10"),
)

_MIRROR_METHODS: tuple[Method, ...] = (
    Method(
        "yeh-spectral",
        "mirror",
        "Exact reflectance of the cells, both polarisations, integrated over the spectrum until it settles.",
        "Yeh 1988; Fourneau et al. 2024, Eq. 2-9, Appendix D",
        is_truth=True,
        glsl_function="mirror_colour_yeh_spectral",
        delta_e_mean=0.0,
        glsl_tables=("spectral_rule",),
    ),
    Method(
        "yeh-grid",
        "mirror",
        "Exact reflectance of the cells, both polarisations, at a fixed number of evenly spaced wavelengths.",
        "Yeh 1988; trapezoidal sums, as spectral renderers and tools take them",
        is_truth=False,
        glsl_function=None,
        delta_e_mean=3.68,  # 20 cells
        parameters=(_GRID_SAMPLES,),
    ),
    Method(
        "landmarks",
        "mirror",
        "The envelope of many cells in boxes between band-gap edges, Airy and zero points, s and p apart.",
        "Fourneau et al. 2024, §3.2, Eq. 11-16, Appendices A and B",
        is_truth=False,
        glsl_function="bragg_reflectance_landmarks",
        delta_e_mean=4.29,  # 20 cells
        glsl_tables=("cumulative_colour",),
        parameters=(_ROOT_FINDER,),
        backends=("numpy", "numba"),
    ),
    Method(
        "landmarks-sub",
        "mirror",
        "`landmarks` with each box of the band above gap m cut into max(1, s − m).",
        "Fourneau et al. 2024, §3.2.2, Approximation quality",
        is_truth=False,
        glsl_function="bragg_reflectance_landmarks_sub",
        delta_e_mean=3.01,  # 20 cells
        glsl_tables=("cumulative_colour",),
        parameters=(
            Parameter("subdivisions", "s: how finely the first bands are cut.", 3, 2.0, 5.0),
            _ROOT_FINDER,
        ),
        backends=("numpy", "numba"),
    ),
    Method(
        "bloch",
        "mirror",
        "Samples beside the real axis of wavenumbers, where fringes fade, and a pole for each band gap.",
        "this project; spec/decisions/bloch.md",
        is_truth=False,
        glsl_function="bragg_reflectance_bloch",
        delta_e_mean=0.04,  # 20 cells
        glsl_tables=("bloch_weights",),
        parameters=(Parameter("samples", "Wavenumbers a polarisation.", 12, 8.0, 128.0),),
        backends=("numpy", "numba"),
    ),
)

METHODS: Mapping[str, Method] = MappingProxyType(
    {m.name: m for m in (*_FILM_METHODS, *_MIRROR_METHODS, *LAYER_METHODS)}
)


def method_names(domain: Domain) -> tuple[str, ...]:
    """Return the names of the methods of `domain`."""
    return tuple(method.name for method in METHODS.values() if method.domain == domain)


def truth_of(domain: Domain) -> str:
    """Return the name of the method that all others are judged by."""
    return next(name for name in method_names(domain) if METHODS[name].is_truth)


def parameters_text(parameters: Mapping[str, ParameterValue]) -> str:
    """Return `parameters` as people read them: "red_nm 605, green_nm 535"; empty where there are none."""
    return ", ".join(f"{k} {v}" if isinstance(v, str) else f"{k} {v:g}" for k, v in parameters.items())


def find_method(name: str, domain: Domain | None = None) -> Method:
    """Return the descriptor called `name`; UsageError where there is none in `domain`."""
    method = METHODS.get(name)
    if method is None or domain not in (None, method.domain):
        known = ", ".join(m.name for m in METHODS.values() if domain in (None, m.domain))
        kind = "" if method is None else " for layers" if domain == "layers" else f" for a {domain}"
        raise UsageError(f"There is no method '{name}'{kind}; choose one of: {known}.")
    return method
