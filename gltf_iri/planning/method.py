"""Descriptors of the methods: what each computes, where it is valid, what it costs and how wrong it may be.

The plan chooses by these; `gltf_iri.evaluation.registry` binds the same names to functions, and a test keeps
both sets equal.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final, Literal

from gltf_iri.errors import UsageError

__all__ = ["DEFAULT_METHOD", "METHODS", "Method", "find_method"]

DEFAULT_METHOD: Final = "khr-guarded"


@dataclass(frozen=True, slots=True)
class Method:
    """One published way to turn a film into a colour."""

    name: str
    domain: Literal["film", "mirror"]
    about: str
    source: str
    is_truth: bool  # exact up to a stated, converged quadrature error
    glsl_function: str | None  # the twin in shaders/optics, or None where there is none yet
    delta_e_mean: (
        float | None
    )  # CIEDE2000 against truth on the film set of the benchmark; None: undefined cases

    @property
    def define(self) -> str:
        """The preprocessor symbol that selects the method in GLSL: khr-guarded → METHOD_KHR_GUARDED."""
        return "METHOD_" + self.name.upper().replace("-", "_")


_FILM_METHODS = (
    Method(
        "khr",
        "film",
        "The extension's text to the letter; its undefined cases stay undefined and are recorded.",
        "KHR_materials_iridescence, Implementation Notes, Iridescence Fresnel",
        is_truth=False,
        glsl_function="iridescent_fresnel_khr",
        delta_e_mean=3.86,
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
        "spectral",
        "film",
        "Exact Airy reflectance, both polarisations, integrated over the spectrum until it no longer moves.",
        "Belcour & Barla 2017, Eq. 2-3; Airy summation",
        is_truth=True,
        glsl_function=None,
        delta_e_mean=0.0,
    ),
)

METHODS: Mapping[str, Method] = MappingProxyType({m.name: m for m in _FILM_METHODS})


def find_method(name: str) -> Method:
    """Return the descriptor called `name`; an unknown name raises UsageError."""
    try:
        return METHODS[name]
    except KeyError:
        known = ", ".join(METHODS)
        raise UsageError(f"There is no method '{name}'; choose one of: {known}.") from None
