"""One film that absorbs nothing against 50 digits, where formulas lose theirs; both backends."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
import pytest

from gltf_iri.bench.fifty_digits import stack_50_digits
from gltf_iri.optics.film import film_reflectance, film_reflectance_polarised

Case = tuple[float, float, complex, float, float, float]  # n1, n2, n3, d nm, λ nm, cos θ1
Draw = Callable[[np.random.Generator, complex], Case]

MAX_ABS = 1e-14

BASES: dict[str, Callable[[np.random.Generator], complex]] = {
    "dielectric": lambda g: complex(g.uniform(1.0, 4.0)),
    "metal": lambda g: complex(g.uniform(0.05, 4.0), g.uniform(0.01, 9.0)),
    "base that hardly absorbs": lambda g: complex(g.uniform(1.0, 3.0), 10.0 ** g.uniform(-12.0, -2.0)),
    "F0 towards 1": lambda g: complex(10.0 ** g.uniform(2.0, 6.0)),
    "F0 towards 0": lambda g: complex(1.0 + 10.0 ** g.uniform(-12.0, -1.0)),
}


def nearly(value: float, g: np.random.Generator) -> float:
    return float(value * (1.0 + g.choice([-1.0, 1.0]) * 10.0 ** g.uniform(-16.0, -3.0)))


def anywhere(g: np.random.Generator, base: complex) -> Case:
    return (
        float(g.choice([1.0, 1.33, 1.5])),
        g.uniform(1.0, 2.6),
        base,
        10.0 ** g.uniform(-6.0, 4.0),
        g.uniform(360.0, 830.0),
        10.0 ** g.uniform(-5.0, 0.0),
    )


def grazing(g: np.random.Generator, base: complex) -> Case:
    return (*anywhere(g, base)[:5], 10.0 ** g.uniform(-14.0, -5.0))


def near_the_films_critical_angle(g: np.random.Generator, base: complex) -> Case:
    film = g.uniform(1.0, 1.45)
    return (1.5, film, *anywhere(g, base)[2:5], nearly(np.sqrt(1.0 - (film / 1.5) ** 2), g))


def near_the_bases_critical_angle(g: np.random.Generator, base: complex) -> Case:
    exit_ior = g.uniform(1.0, 1.45)
    case = anywhere(g, exit_ior + 0.1j * base.imag)
    return (1.5, 2.0, *case[2:5], nearly(np.sqrt(1.0 - (exit_ior / 1.5) ** 2), g))


def near_brewster(g: np.random.Generator, base: complex) -> Case:
    case = anywhere(g, base)
    return (*case[:5], nearly(1.0 / np.sqrt(1.0 + (case[1] / case[0]) ** 2), g))


def film_nearly_outside(g: np.random.Generator, base: complex) -> Case:
    case = anywhere(g, base)
    return (case[0], nearly(case[0], g), *case[2:])


def film_nearly_base(g: np.random.Generator, base: complex) -> Case:
    case = anywhere(g, base)
    return (*case[:2], complex(nearly(case[1], g), 1e-3 * base.imag), *case[3:])


def a_millimetre(g: np.random.Generator, base: complex) -> Case:
    case = anywhere(g, base)
    return (*case[:3], 1e6, *case[4:])


def frustrated(g: np.random.Generator, base: complex) -> Case:
    case = anywhere(g, base)
    return (g.uniform(1.5, 2.5), g.uniform(1.0, 1.4), base, g.uniform(1.0, 600.0), case[4], case[5] ** 0.3)


def guided(g: np.random.Generator, base: complex) -> Case:
    """At grazing light a film guides it where D of the Airy sum is least: its sharpest lines."""
    film, cosine = g.uniform(1.1, 2.6), 10.0 ** g.uniform(-5.0, -1.0)
    y1, y2 = cosine, np.sqrt(film * film - 1.0 + cosine * cosine)
    y3 = np.sqrt(base * base - 1.0 + cosine * cosine)
    ratio = -1j * (y2 * y2 + y1 * y3) / (y2 * (y1 + y3))
    beta = np.arctan2(-ratio.real, abs(ratio) ** 2) if abs(ratio.real) > 1e-9 else 0.5 * np.pi
    beta += np.pi * g.integers(1, 5) + g.uniform(-2.0, 2.0) * min(abs(ratio.imag), 1.0)
    wavelength_nm = g.uniform(360.0, 830.0)
    return 1.0, film, base, float(beta * wavelength_nm / (2.0 * np.pi * y2)), wavelength_nm, cosine


DRAWS: list[Draw] = [
    anywhere,
    grazing,
    near_the_films_critical_angle,
    near_the_bases_critical_angle,
    near_brewster,
    film_nearly_outside,
    film_nearly_base,
    a_millimetre,
    frustrated,
    guided,
]


@pytest.mark.parametrize("kind", BASES)
@pytest.mark.parametrize("draw", DRAWS, ids=lambda draw: draw.__name__)
def test_films_keep_their_digits(
    draw: Draw, kind: str, record_property: Callable[[str, object], None]
) -> None:
    g = np.random.default_rng(21)
    backends = ["numpy", "numba"] if find_spec("numba") else ["numpy"]
    worst = dict.fromkeys(("polarised", *backends), 0.0)
    for _ in range(40):
        case = draw(g, BASES[kind](g))
        n1, n2, n3, d_nm, wavelength_nm, cosine = case
        exact = stack_50_digits([n1, n2, n3], [d_nm], wavelength_nm, cosine)
        for ours, truth in zip(film_reflectance_polarised(*case), (exact.R_s, exact.R_p), strict=True):
            worst["polarised"] = max(worst["polarised"], abs(float(truth - float(ours))))
        for backend in backends:
            mean = float(film_reflectance(*case, backend=backend))
            worst[backend] = max(worst[backend], abs(float(exact.reflected - mean)))
    record_property(
        "measured", f"{kind}, {draw.__name__}: {', '.join(f'{k} {v:.0e}' for k, v in worst.items())}"
    )
    assert max(worst.values()) <= MAX_ABS
