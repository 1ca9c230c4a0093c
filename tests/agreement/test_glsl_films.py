"""GLSL's films are Python's films, up to the rounding of float32."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.evaluation.khr import evaluate_khr, khr_branch_distance_ulp
from gltf_iri.evaluation.khr_guarded import evaluate_khr_guarded
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_BRANCH_ULP, GLSL_OPTICS_MAX_ABS

PYTHON = {"khr": evaluate_khr, "khr-guarded": evaluate_khr_guarded}

# Compared in the files of tests beside this one that have their names.
ELSEWHERE = {"fourier", "spectral", "incoherent", "granier-heidrich"}
ELSEWHERE |= {"yeh-spectral", "landmarks", "landmarks-sub", "bloch"}
ELSEWHERE |= {"layers-single", "layers-rgb", "layers-bands"}

POLE = "Fresnel0ToIor"  # the undefined case in which the text divides by zero


def test_every_method_with_a_twin_is_compared() -> None:
    assert {*PYTHON, *ELSEWHERE} == {m.name for m in METHODS.values() if m.glsl_function}


@pytest.mark.parametrize("method", PYTHON)
def test_glsl_film_equals_python_film(
    method: str,
    films: Film,
    probe: Probe,
    request: pytest.FixtureRequest,
    record_property: Callable[[str, object], None],
) -> None:
    python = PYTHON[method](films, "D65")
    glsl = probe.evaluate(method, films)
    error = np.abs(glsl.rgb - python.rgb).max(axis=-1)
    undefined = pole_rows(python, films)
    near = (khr_branch_distance_ulp(films) <= GLSL_BRANCH_ULP) & ~undefined
    compared = ~near & ~undefined

    other_side = near & ~(error <= GLSL_OPTICS_MAX_ABS)
    unexplained = 0
    if other_side.any():
        nearest = np.min(
            [
                np.abs(glsl.rgb[other_side] - PYTHON[method](film, "D65").rgb).max(axis=-1)
                for film in both_sides(films, other_side)
            ],
            axis=0,
        )
        unexplained = int((~(nearest <= GLSL_OPTICS_MAX_ABS)).sum())
    cases = "; ".join(f"{case}: {mask.sum()} rows" for case, mask in python.undefined.items())
    record_property(
        "measured",
        f"{request.node.callspec.id}, GLSL on {glsl.backend} against Python: max abs "
        f"{error[compared].max():.2e} over {compared.sum()} rows; {near.sum()} within {GLSL_BRANCH_ULP} ulp "
        f"of a branch, {other_side.sum()} of them on its other side; {undefined.sum()} undefined and not "
        f"compared; undefined by the text: {cases or 'none'}",
    )
    assert error[compared].max() <= GLSL_OPTICS_MAX_ABS
    assert unexplained == 0


def pole_rows(evaluation: Evaluation, films: Film) -> NDArray[np.bool_]:
    """Rows where the text divides by zero: listed by the evaluator, not compared."""
    poles = [mask for case, mask in evaluation.undefined.items() if case.startswith(POLE)]
    return np.any([np.zeros(films.shape, dtype=bool), *poles], axis=0)


def both_sides(films: Film, rows: NDArray[np.bool_]) -> list[Film]:
    """The chosen rows, with each index and angle moved to either side of the branch that it is next to."""
    f0, film_ior = films.base.f0[rows], films.film_ior[rows]
    outside, cosine = films.outside_ior[rows], films.cos_theta_1[rows]
    tiny = GLSL_BRANCH_ULP * 2.0**-23
    base_ior = fresnel0_to_ior(f0 + 1e-4)
    is_matched = np.abs(base_ior / film_ior[:, None] - 1.0) < 2.0 * tiny
    is_outside = np.abs(outside / film_ior - 1.0) < 2.0 * tiny
    critical = np.sqrt(np.maximum(1.0 - (film_ior / outside) ** 2, 0.0))
    is_critical = (critical > 0.0) & ~is_outside & (np.abs(cosine**2 - critical**2) < 4.0 * tiny)
    moved = []
    for *signs, outer, angle in itertools.product((-1, 1), (-1, 1), (-1, 1), (-1, 0, 1), (-1, 1)):
        beside = film_ior[:, None] * (1.0 + 1e-9 * np.array(signs))
        moved_f0 = np.where(is_matched, np.maximum(ior_to_fresnel0(beside, 1.0) - 1e-4, 0.0), f0)
        moved_outside = np.where(is_outside, film_ior * (1.0 + 1e-15 * outer), outside)
        moved_cosine = np.where(is_critical, critical * (1.0 + 1e-9 * angle), cosine)
        moved.append(
            Film.of(moved_cosine, films.thickness_nm[rows], film_ior, base_from_f0(moved_f0), moved_outside)
        )
    return moved
