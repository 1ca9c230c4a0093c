"""Laws of Bragg mirrors as colours, asked of every mirror method by its name."""

from __future__ import annotations

import numpy as np
from laws_law import Law, colourfulness, distance, luminance

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate

__all__ = ["MIRROR_LAWS"]

COSINES = np.array([1e-8, 0.02, 0.1, 0.3, 0.55, 0.8, 1.0])
THICKNESSES_NM = np.array([40.0, 150.0, 315.0])[:, None]
CELLS = np.array([1, 2, 10, 50])[:, None, None]


def equal_films(method: str) -> float:
    mirrors = (
        Mirror.of(COSINES, n, n, 120.0, THICKNESSES_NM, CELLS, host) for n, host in ((1.5, 1.5), (1.5, 1.0))
    )
    return max(colourfulness(evaluate(method, mirror).rgb) for mirror in mirrors)


def no_second_film(method: str) -> float:
    mirror = Mirror.of(COSINES, 1.0, 1.5, THICKNESSES_NM, 0.0, CELLS)
    return distance(evaluate(method, mirror).rgb, 0.0)


def one_cell(method: str) -> float:
    """One cell under its own n1 is the film n2 between n1 and n1; how thick n1 is does not matter."""
    d1_nm, d2_nm = np.array([30.0, 170.0])[:, None, None], THICKNESSES_NM
    mirror = Mirror.of(COSINES, 1.2, 1.9, d1_nm, d2_nm, 1)
    slab = evaluate("spectral", Film.of(COSINES, d2_nm, 1.9, base_from_ior(1.2), 1.2)).rgb
    return distance(evaluate(method, mirror).rgb, slab)


def no_more_than_white(method: str) -> float:
    mirror = Mirror.of(
        COSINES, 1.0, np.array([1.3, 1.8, 3.0])[:, None, None, None], 120.0, THICKNESSES_NM, CELLS
    )
    y = luminance(evaluate(method, mirror).rgb)
    return float(np.maximum(-y, y - 1.0).max())


def grazing(method: str) -> float:
    mirror = Mirror.of(0.0, 1.0, 1.5, 120.0, THICKNESSES_NM, CELLS[2:])
    return distance(evaluate(method, mirror).rgb, 1.0)


MIRROR_LAWS = {
    "equal films": Law("Films of one index are one medium: no colour.", equal_films, 1e-9),
    "no second film": Law("Cells whose second film has no thickness reflect nothing.", no_second_film, 1e-9),
    "one cell": Law("One cell is the slab n2 in n1.", one_cell, 1e-8),
    "no more than white": Law("The luminance is within 0 and 1.", no_more_than_white, 1e-9),
    "grazing": Law("Grazing light is all reflected, where the films differ.", grazing, 1e-9),
}
