"""The one place where a method's name meets its function."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from gltf_iri.backends import choose_backend
from gltf_iri.colour.spaces import WHITES, Light
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.bb17 import evaluate_bb17
from gltf_iri.evaluation.bloch import evaluate_bloch
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.fourier import evaluate_fourier
from gltf_iri.evaluation.granier_heidrich import evaluate_granier_heidrich
from gltf_iri.evaluation.incoherent import evaluate_incoherent
from gltf_iri.evaluation.khr import evaluate_khr
from gltf_iri.evaluation.khr_guarded import evaluate_khr_guarded
from gltf_iri.evaluation.landmarks import evaluate_landmarks, evaluate_landmarks_sub
from gltf_iri.evaluation.layers import LayeredSurface
from gltf_iri.evaluation.layers_bands import evaluate_layers_bands
from gltf_iri.evaluation.layers_rgb import evaluate_layers_rgb
from gltf_iri.evaluation.layers_single import evaluate_layers_single
from gltf_iri.evaluation.layers_single_table import evaluate_layers_single_table
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.naive_rgb import evaluate_naive_rgb
from gltf_iri.evaluation.parameters import checked_parameters
from gltf_iri.evaluation.smits_meyer import evaluate_smits_meyer
from gltf_iri.evaluation.spectral import evaluate_spectral
from gltf_iri.evaluation.spectral_grid import evaluate_spectral_grid
from gltf_iri.evaluation.yeh_grid import evaluate_yeh_grid
from gltf_iri.evaluation.yeh_spectral import evaluate_yeh_spectral
from gltf_iri.planning.method import Domain, ParameterValue, find_method

__all__ = ["EVALUATORS", "Evaluator", "Subject", "checked_parameters", "domain_of", "evaluate"]

Subject = Film | Mirror | LayeredSurface

# evaluator(subject, white, **parameters, and `backend` where the method has more than one)
Evaluator = Callable[..., Evaluation]

# Names are those of gltf_iri.planning.method.METHODS; a test holds both sets equal.
EVALUATORS: Mapping[str, Evaluator] = MappingProxyType(
    {
        "khr": evaluate_khr,
        "khr-guarded": evaluate_khr_guarded,
        "granier-heidrich": evaluate_granier_heidrich,
        "naive-rgb": evaluate_naive_rgb,
        "smits-meyer": evaluate_smits_meyer,
        "bb17": evaluate_bb17,
        "fourier": evaluate_fourier,
        "spectral-grid": evaluate_spectral_grid,
        "incoherent": evaluate_incoherent,
        "spectral": evaluate_spectral,
        "yeh-spectral": evaluate_yeh_spectral,
        "yeh-grid": evaluate_yeh_grid,
        "landmarks": evaluate_landmarks,
        "landmarks-sub": evaluate_landmarks_sub,
        "bloch": evaluate_bloch,
        "layers-single": evaluate_layers_single,
        "layers-single-table": evaluate_layers_single_table,
        "layers-rgb": evaluate_layers_rgb,
        "layers-bands": evaluate_layers_bands,
    }
)


def domain_of(subject: Subject) -> Domain:
    """Return whose methods compute `subject`."""
    if isinstance(subject, LayeredSurface):
        return "layers"
    return "mirror" if isinstance(subject, Mirror) else "film"


def evaluate(
    method: str,
    subject: Subject,
    *,
    white: str | Light = "D65",
    backend: str = "auto",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> Evaluation:
    """Return the reflectance colour of `subject` (shape subject.shape + (3,)) by the method called `method`.

    Of a layered surface the colour is that of its BRDF, 1/sr, as `gltf_iri.evaluation.layers.brdf` has it.

    white : "D65", "E", or a light of the caller's own.
    Raises UsageError where the method or the white is unknown, the method is not one for films, mirrors or
    layers as the subject is, or has no such parameter or backend.
    """
    descriptor = find_method(method, domain_of(subject))
    if not isinstance(white, Light) and white not in WHITES:
        raise UsageError(f"There is no white '{white}'; choose one of: {', '.join(WHITES)}.")
    values = checked_parameters(descriptor, parameters)
    count = int(np.prod(subject.shape, dtype=np.intp))
    chosen = choose_backend(backend, count, descriptor.backends, method)
    arguments: dict[str, Any] = dict(values)
    if len(descriptor.backends) > 1:
        arguments["backend"] = chosen
    return replace(EVALUATORS[method](subject, white, **arguments), backend=chosen, parameters=values)
