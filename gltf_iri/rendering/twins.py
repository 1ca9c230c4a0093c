"""The GLSL twins of the methods: where they stand, what they take, and what they sample."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS, ParameterValue, find_method
from gltf_iri.rendering.optics_tables import Table, optics_table

__all__ = ["COMPONENTS", "FILM_TYPES", "MIRROR_TYPES", "ResultType", "Twin", "film_arguments", "find_twin"]

ResultType = Literal["float", "vec3"]

COMPONENTS: Final[Mapping[ResultType, int]] = {"float": 1, "vec3": 3}

# What films and mirrors are given as, in this order.
FILM_TYPES: Final[tuple[ResultType, ...]] = ("float", "float", "vec3", "float", "float")
MIRROR_TYPES: Final[tuple[ResultType, ...]] = ("float",) * 7


@dataclass(frozen=True, slots=True)
class Twin:
    """A GLSL function and all that a call of it on one subject needs."""

    function: str
    include: str  # the file below shaders/ that defines it
    types: tuple[ResultType, ...]
    arguments: tuple[NDArray[np.float64], ...]  # of the subject, in the shapes in which they broadcast
    tables: Mapping[str, Table]
    blank: Evaluation  # method, white and checked parameters; its colour is of no meaning


def find_twin(
    method: str, subject: Film | Mirror, white: str, parameters: Mapping[str, ParameterValue]
) -> Twin:
    """Return the twin of `method` for `subject`.

    Raises UsageError where the method, the white or a parameter is unknown, the method has no GLSL twin, and
    for mirrors whose cells absorb: no twin computes those.
    """
    is_mirror = isinstance(subject, Mirror)
    descriptor = find_method(method, "mirror" if is_mirror else "film")
    if descriptor.glsl_function is None:
        having = [m.name for m in METHODS.values() if m.glsl_function and m.domain == descriptor.domain]
        raise UsageError(f"The method '{method}' has no GLSL twin; those that have one: {', '.join(having)}.")
    # One film or mirror, on which Python checks names and ranges in no time.
    small = (
        Mirror.of(1.0, 1.0, 1.5, 100.0, 100.0, 5)
        if is_mirror
        else Film.of(1.0, 100.0, 1.3, base_from_f0([0.04] * 3))
    )
    blank = evaluate(method, small, white=white, parameters=parameters)
    return Twin(
        descriptor.glsl_function,
        f"optics/{method.replace('-', '_')}.glsl",
        MIRROR_TYPES if is_mirror else FILM_TYPES,
        _arguments(subject),
        {name: optics_table(name, white, blank.parameters) for name in descriptor.glsl_tables},
        blank,
    )


def film_arguments(film: Film) -> tuple[NDArray[np.float64], ...]:
    """Return what twins of film methods are called with; types are FILM_TYPES."""
    return film.outside_ior, film.film_ior, film.base.f0, film.thickness_nm, film.cos_theta_1


def _arguments(subject: Film | Mirror) -> tuple[NDArray[np.float64], ...]:
    if isinstance(subject, Film):
        return film_arguments(subject)
    if not subject.is_lossless:
        raise UsageError("The GLSL twins of mirror methods know lossless cells only: leave k out.")
    cells = subject.cells.astype(np.float64)
    films = subject.n1.real, subject.n2.real, subject.d1_nm, subject.d2_nm
    return subject.host_ior, *films, cells, subject.cos_theta_h
