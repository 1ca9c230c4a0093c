"""Laws of thin films as colours, asked of every film method by its name."""

from __future__ import annotations

import numpy as np
from laws_law import Law, colourfulness, distance, luminance

from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate

__all__ = ["FILM_LAWS"]

# Exactly grazing, nearly so, straight on, and what lies between.
COSINES = np.array([0.0, 1e-100, 1e-8, 0.02, 0.1, 0.3, 0.55, 0.8, 1.0])
THICKNESSES_NM = np.array([0.0, 1e-6, 60.0, 250.0, 411.0, 1300.0])[:, None]
INDICES = np.array([1.05, 1.33, 1.5, 2.4])[:, None, None]


def film_is_outside(method: str) -> float:
    bases = (base_from_ior(INDICES), base_from_ior(0.2 + 3.4j))
    films = (Film.of(COSINES, THICKNESSES_NM, n, base, n) for n in (1.0, 1.4) for base in bases)
    return max(colourfulness(evaluate(method, film).rgb) for film in films)


def film_is_base(method: str) -> float:
    film = Film.of(COSINES, THICKNESSES_NM, INDICES, base_from_ior(INDICES))
    return colourfulness(evaluate(method, film).rgb)


def no_thickness(method: str) -> float:
    """What is left of a film of no thickness must not depend on what it is made of."""
    film = Film.of(COSINES, 0.0, np.linspace(1.0, 2.5, 31)[:, None, None], base_from_ior(INDICES[:, 0]))
    rgb = evaluate(method, film).rgb
    return max(float(np.ptp(rgb, axis=0).max()), colourfulness(rgb))


def backwards(method: str) -> float:
    """The same film seen from below, along the path that the light leaves by."""
    above, film_ior, below = (
        1.0,
        np.array([1.1, 1.38, 1.9, 2.6])[:, None, None],
        np.array([1.33, 1.8])[:, None],
    )
    sine = np.linspace(0.0, 0.995, 12)
    cosine, cosine_below = np.sqrt(1.0 - sine**2), np.sqrt(1.0 - (sine / below) ** 2)
    down = evaluate(method, Film.of(cosine, 320.0, film_ior, base_from_ior(below), above)).rgb
    up = evaluate(method, Film.of(cosine_below, 320.0, film_ior, base_from_ior(above), below)).rgb
    return distance(down, up)


def perfect_mirror(method: str) -> float:
    film = Film.of(COSINES, THICKNESSES_NM, INDICES, base_from_f0(np.ones(3)))
    return max(distance(evaluate(method, film, white=white).rgb, 1.0) for white in ("D65", "E"))


def finer_than_the_eye(method: str) -> float:
    thickness_nm = np.linspace(40_000.0, 40_300.0, 4)[:, None]
    film = Film.of(COSINES[5:], thickness_nm, 1.5, base_from_ior(2.0))
    return max(colourfulness(evaluate(method, film, white=white).rgb) for white in ("D65", "E"))


def no_more_than_white(method: str) -> float:
    """Channels of saturated colours leave 0 to 1, the luminance of a passive surface does not."""
    bases = (
        base_from_ior(INDICES),
        base_from_f0(np.array([0.3, 0.7, 0.95])[:, None, None, None] * np.ones(3)),
    )
    films = (Film.of(COSINES, THICKNESSES_NM, n, base) for n in (1.2, 1.5, 2.2) for base in bases)
    luminances = (luminance(evaluate(method, film).rgb) for film in films)
    return max(float(np.maximum(-y, y - 1.0).max()) for y in luminances)


def grazing(method: str) -> float:
    film = Film.of(0.0, THICKNESSES_NM, INDICES[1:], base_from_ior(np.linspace(1.2, 3.0, 7)))
    return distance(evaluate(method, film).rgb, 1.0)


FILM_LAWS = {
    "film = outside": Law(
        "A film of the outside's index adds no colour to a grey base.", film_is_outside, 1e-9
    ),
    "film = base": Law("A film of its base's index adds no colour.", film_is_base, 1e-9),
    "no thickness": Law(
        "A film of no thickness is the bare base, whatever it is made of.", no_thickness, 1e-9
    ),
    # The refracted cosine is rounded, which flat light magnifies.
    "backwards": Law("Light that comes from below along its path is reflected as much.", backwards, 1e-9),
    "perfect mirror": Law("A base that reflects everything is white under any film.", perfect_mirror, 1e-9),
    "fine fringes": Law("Fringes finer than the eye resolves leave grey.", finer_than_the_eye, 2e-3),
    "no more than white": Law("The luminance is within 0 and 1.", no_more_than_white, 1e-9),
    "grazing": Law("Grazing light is all reflected, where the media differ.", grazing, 1e-9),
}
