"""The film methods as a comparison uses them: with the truth beside, whites in words, and branches marked."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Final

from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.khr import khr_branch_distance_ulp
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.reference.film_on import FilmMethod
from gltf_iri.tolerances import GLSL_BRANCH_ULP

__all__ = ["BRANCH", "TRUTH", "film_method", "white_of"]

TRUTH: Final = "spectral"

# A case that counts rows where float32 and float64 may take different branches, both following the text.
BRANCH: Final = f"within {GLSL_BRANCH_ULP} float32 ulp of a branch of the text: either side is right"

_WHITES: Final = {
    "khr": "no single one: constant term (1, 1, 1), fringes "
    f"({', '.join(f'{channel:.3f}' for channel in SENSITIVITY_WHITE)})",
    "khr-guarded": "(1, 1, 1) for constant term and fringes alike",
}


def film_method(name: str, white: str) -> FilmMethod:
    """Return the evaluator called `name` under `white`; raises UsageError, when called, for unknown names."""
    return partial(_khr_with_branches if name == "khr" else partial(evaluate, name), white=white)


def white_of(name: str, evaluated: str) -> str:
    """Return what the method `name` takes for white; `evaluated` is the illuminant its evaluation names."""
    return _WHITES.get(name, evaluated)


def _khr_with_branches(film: Film, *, white: str) -> Evaluation:
    evaluation = evaluate("khr", film, white=white)
    near = khr_branch_distance_ulp(film) <= GLSL_BRANCH_ULP
    return replace(evaluation, undefined={**evaluation.undefined, BRANCH: near})
