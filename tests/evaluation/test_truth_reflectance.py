"""The exact film against independent code: 50-digit transfer matrices, and the tmm package."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tmm import unpolarized_RT

from gltf_iri.optics.film import film_reflectance, film_reflectance_polarised
from gltf_iri.tolerances import SPECTRAL_REFLECTANCE_MAX_ABS, SPECTRAL_VERSUS_TMM_MAX_ABS

Case = tuple[float, float, complex, float, float, float]  # n1, n2, n3, d nm, λ nm, cos θ1
Exact = Callable[..., tuple[Any, Any]]


def polarised(case: Case) -> tuple[float, float]:
    n1, n2, n3, d_nm, wavelength_nm, cos_1 = case
    s, p = film_reflectance_polarised(n1, n2, n3, d_nm, wavelength_nm, cos_1)
    return float(s), float(p)


@pytest.fixture(scope="module")
def error(film_reflectance: Exact) -> Callable[[Case], float]:
    """The worse polarisation's distance from 50 digits."""

    def worse(case: Case) -> float:
        pairs = zip(film_reflectance(*case), polarised(case), strict=True)
        return max(abs(float(exact - ours)) for exact, ours in pairs)

    return worse


def dielectric(g: np.random.Generator) -> complex:
    return g.uniform(1.0, 4.0)


def metal(g: np.random.Generator) -> complex:
    return complex(g.uniform(0.05, 4.0), g.uniform(0.01, 9.0))


def nearly_perfect_mirror(g: np.random.Generator) -> complex:
    return 10.0 ** g.uniform(2.0, 6.0)


@pytest.mark.parametrize("base", [dielectric, metal, nearly_perfect_mirror])
def test_random_films_agree_with_50_digits(
    base: Callable[[np.random.Generator], complex],
    error: Callable[[Case], float],
    record_property: Callable[[str, object], None],
) -> None:
    g = np.random.default_rng(11)
    worst = max(
        error(
            (
                g.choice([1.0, 1.33]),
                g.uniform(1.34, 2.6),
                base(g),
                g.uniform(0.0, 5000.0),
                g.uniform(360.0, 830.0),
                10.0 ** g.uniform(-5.0, 0.0),
            )
        )
        for _ in range(250)
    )
    record_property("measured", f"reflectance against 50 digits, {base.__name__}: {worst:.1e}")
    assert worst <= SPECTRAL_REFLECTANCE_MAX_ABS


CRITICAL_COSINE = float(np.sqrt(1.0 - (1.0 / 1.5) ** 2))

EDGES: dict[str, Case] = {
    "straight on": (1.0, 1.3, 1.5, 400.0, 550.0, 1.0),
    "no thickness": (1.0, 1.3, 1.5, 0.0, 550.0, 0.4),
    "film is outside": (1.0, 1.0, 1.5, 400.0, 550.0, 0.3),
    "film is base": (1.0, 1.5, 1.5, 400.0, 550.0, 0.3),
    "base is outside": (1.0, 1.4, 1.0, 400.0, 550.0, 0.3),
    "almost grazing": (1.0, 1.4, 1.5, 400.0, 550.0, 1e-12),
    "almost grazing on metal": (1.0, 1.4, 0.2 + 3.4j, 400.0, 550.0, 1e-12),
    "thick": (1.0, 1.4, 1.5, 10_000.0, 360.0, 0.7),
    "quarter wave": (1.0, 1.38, 1.9044, 550.0 / 4 / 1.38, 550.0, 1.0),
    "absorbing base with no real part": (1.0, 1.4, 3j, 400.0, 550.0, 0.6),
    "frustrated film": (1.5, 1.0, 1.5, 100.0, 550.0, 0.4),
    "thick frustrated film": (1.5, 1.0, 1.5, 100_000.0, 550.0, 0.4),
    "frustrated film on metal": (1.5, 1.0, 0.2 + 3.4j, 80.0, 550.0, 0.4),
    "total reflection at the base": (1.5, 2.0, 1.0, 300.0, 550.0, 0.4),
    "just below the critical angle": (1.5, 1.0, 1.5, 200.0, 550.0, float(np.nextafter(CRITICAL_COSINE, 1.0))),
    "at the critical angle": (1.5, 1.0, 1.5, 200.0, 550.0, CRITICAL_COSINE),
    "just beyond the critical angle": (
        1.5,
        1.0,
        1.5,
        200.0,
        550.0,
        float(np.nextafter(CRITICAL_COSINE, 0.0)),
    ),
    "critical angle of the base": (1.5, 2.0, 1.0, 200.0, 550.0, CRITICAL_COSINE),
}


@pytest.mark.parametrize("case", EDGES.values(), ids=EDGES.keys())
def test_edges_agree_with_50_digits(case: Case, error: Callable[[Case], float]) -> None:
    assert error(case) <= SPECTRAL_REFLECTANCE_MAX_ABS


def test_tmm_package_agrees(record_property: Callable[[str, object], None]) -> None:
    g = np.random.default_rng(12)
    worst = 0.0
    for i in range(300):
        n3 = metal(g) if i % 2 else dielectric(g)
        case = (
            1.0,
            g.uniform(1.05, 2.6),
            n3,
            g.uniform(0.0, 1000.0),
            g.uniform(360.0, 830.0),
            g.uniform(0.01, 1.0),
        )
        n1, n2, _, d_nm, wavelength_nm, cos_1 = case
        theirs = unpolarized_RT([n1, n2, n3], [np.inf, d_nm, np.inf], np.arccos(cos_1), wavelength_nm)["R"]
        worst = max(worst, abs(theirs - np.mean(polarised(case))))
    record_property("measured", f"reflectance against tmm: {worst:.1e}")
    assert worst <= SPECTRAL_VERSUS_TMM_MAX_ABS


def test_wrong_sign_of_k_would_be_noticed(film_reflectance: Exact, error: Callable[[Case], float]) -> None:
    """n − ik belongs to exp(+iωt): taken under exp(−iωt), the metal would amplify."""
    case = (1.0, 1.4, 0.3 + 3.0j, 150.0, 550.0, 0.8)
    wrong = np.mean([float(r) for r in film_reflectance(1.0, 1.4, 0.3 - 3.0j, *case[3:])])
    assert abs(wrong - np.mean(polarised(case))) > 0.01
    assert error(case) <= SPECTRAL_REFLECTANCE_MAX_ABS


@pytest.mark.parametrize(("base", "expected"), [(1.0, 0.0), (1.5, 1.0), (0.2 + 3.4j, 1.0)])
def test_grazing_light_is_reflected_unless_all_media_match(base: complex, expected: float) -> None:
    assert film_reflectance(1.0, 1.0, base, 0.7, 1.0, 0.0) == expected


def test_perfect_mirror_reflects_all_under_any_film() -> None:
    mirror = film_reflectance(1.0, 1.4, np.inf, 0.7, 1.0, np.linspace(0.0, 1.0, 21))
    assert np.array_equal(mirror, np.ones(21))
