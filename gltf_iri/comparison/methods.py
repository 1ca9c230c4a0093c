"""The film methods as a comparison uses them: with the truth beside, whites in words, and branches marked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Final

import numpy as np

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import look_up
from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.khr import khr_branch_distance_ulp
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import ParameterValue
from gltf_iri.planning.reach import Lobe
from gltf_iri.reference.film_on import FilmMethod, Sight
from gltf_iri.tolerances import GLSL_BRANCH_ULP

__all__ = ["BRANCH", "TRUTH", "film_method", "table_method", "white_of"]

TRUTH: Final = "spectral"

# A case that counts rows where float32 and float64 may take different branches, both following the text.
BRANCH: Final = f"within {GLSL_BRANCH_ULP} float32 ulp of a branch of the text: either side is right"

_WHITES: Final = {
    "khr": "no single one: constant term (1, 1, 1), fringes "
    f"({', '.join(f'{channel:.3f}' for channel in SENSITIVITY_WHITE)})",
    "khr-guarded": "(1, 1, 1) for constant term and fringes alike",
}

_AVERAGING: Final = "fourier"  # whose shader averages over a spread of the thickness


def film_method(
    name: str, white: White, parameters: Mapping[str, ParameterValue] = MappingProxyType({})
) -> FilmMethod:
    """Return the evaluator called `name` under `white`; raises UsageError, when called, for unknown names.

    Image light is met at the facets' mean cosine where the sight has facets, else at the film's own.
    """

    def method(film: Film, sight: Sight) -> Evaluation:
        if sight.facets is not None:
            film = replace(film, cos_theta_1=sight.facets.mean_cosine)
        evaluation = evaluate(name, film, white=white, parameters=parameters)
        if name == _AVERAGING and sight.thickness_std_nm.any():
            tolerance = float(evaluation.parameters["tolerance"])
            averaged = prefiltered_fourier(film, sight.thickness_std_nm, white, tolerance)
            return replace(evaluation, rgb=averaged)
        if name == "khr":
            near = khr_branch_distance_ulp(film) <= GLSL_BRANCH_ULP
            return replace(evaluation, undefined={**evaluation.undefined, BRANCH: near})
        return evaluation

    return method


def table_method(tables: Mapping[Lobe, BakedTable], otherwise: FilmMethod) -> FilmMethod:
    """Return what looks films up in the tables of their lobe, and asks `otherwise` where there is none."""

    def method(film: Film, sight: Sight) -> Evaluation:
        baked = tables.get(sight.lobe)
        if baked is None:
            return otherwise(film, sight)
        cosine, roughness = film.cos_theta_1, np.zeros(film.shape)
        if sight.facets is not None and baked.table.axis("roughness") is not None:
            roughness = sight.facets.roughness
        elif sight.facets is not None:
            cosine = sight.facets.mean_cosine
        rgb = look_up(
            baked,
            cosine,
            film.thickness_nm,
            film.base.f0,
            roughness=roughness,
            spread_nm=sight.thickness_std_nm,
        )
        return Evaluation(rgb, TRUTH, baked.white)

    return method


def white_of(name: str, evaluated: str) -> str:
    """Return what the method `name` takes for white; `evaluated` is the illuminant its evaluation names."""
    return _WHITES.get(name, evaluated)
