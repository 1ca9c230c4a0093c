"""The one place where a method's name meets its function."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from gltf_iri.colour.spaces import WHITES, White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.khr import evaluate_khr
from gltf_iri.evaluation.khr_guarded import evaluate_khr_guarded
from gltf_iri.evaluation.spectral import evaluate_spectral
from gltf_iri.planning.method import find_method

__all__ = ["EVALUATORS", "Evaluator", "evaluate"]

Evaluator = Callable[[Film, White], Evaluation]

# Names are those of gltf_iri.planning.method.METHODS; a test holds both sets equal.
EVALUATORS: Mapping[str, Evaluator] = MappingProxyType(
    {
        "khr": evaluate_khr,
        "khr-guarded": evaluate_khr_guarded,
        "spectral": evaluate_spectral,
    }
)


def evaluate(method: str, film: Film, *, white: str = "D65") -> Evaluation:
    """Return the reflectance colour of `film` (shape film.shape + (3,)) by the method called `method`.

    Raises UsageError where the method or the white ("D65", "E") is unknown.
    """
    descriptor = find_method(method)
    for known in WHITES:
        if white == known:
            return EVALUATORS[descriptor.name](film, known)
    raise UsageError(f"There is no white '{white}'; choose one of: {', '.join(WHITES)}.")
