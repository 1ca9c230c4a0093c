"""Method khr: the text's numbers, to the letter, with its gaps recorded."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.khr import evaluate_khr, iridescent_fresnel_khr, khr_branch_distance_ulp

POLE = "Fresnel0ToIor divides by zero or turns negative (F0 ≥ 0.9999)"
NEGATIVE_POW = "pow(x, 2.0) of a negative x (x·x used)"


def literal_text(outside: float, film: float, base_f0: float, d_nm: float, cos_1: float) -> list[float]:
    """One grey film in plain floats and SI units, written from the text line by line."""
    r0 = ((film - outside) / (film + outside)) ** 2
    r12 = r0 + (1 - r0) * (1 - cos_1) ** 5
    t121 = 1 - r12
    cos_2_squared = 1 - (outside / film) ** 2 * (1 - cos_1**2)
    if cos_2_squared < 0:
        return [1.0] * 3
    cos_2 = math.sqrt(cos_2_squared)
    root = math.sqrt(base_f0 + 0.0001)
    base = (1 + root) / (1 - root)
    r1 = ((base - film) / (base + film)) ** 2
    r23 = r1 + (1 - r1) * (1 - cos_2) ** 5
    phi = math.pi - (math.pi if film < outside else 0) + (math.pi if base < film else 0)
    r123 = min(max(r12 * r23, 1e-5), 0.9999)
    rs = t121**2 * r23 / (1 - r123)
    rgb = [r12 + rs] * 3
    cm = rs - t121
    for m in (1, 2):
        cm *= math.sqrt(r123)
        phase = 2 * math.pi * m * 2 * film * d_nm * cos_2 * 1e-9
        lobes = [
            (5.4856e-13, 1.6810e6, 4.3278e9),
            (4.4201e-13, 1.7953e6, 9.3046e9),
            (5.2481e-13, 2.2084e6, 6.6121e9),
        ]
        lobes.append((9.7470e-14, 2.2399e6, 4.5282e9))
        x, y, z, x2 = (
            v
            * math.sqrt(2 * math.pi * var)
            * math.cos(pos * phase + m * phi)
            * math.exp(-(phase**2) * var)
            / 1.0685e-7
            for v, pos, var in lobes
        )
        x += x2
        sensitivity = (
            3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
            -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
        )
        rgb = [c + cm * 2 * s for c, s in zip(rgb, sensitivity, strict=True)]
    return [max(c, 0.0) for c in rgb]


def test_follows_the_text_line_by_line() -> None:
    g = np.random.default_rng(4)
    for _ in range(300):
        case = (
            g.choice([1.0, 1.5]),
            g.uniform(1.0, 2.5),
            g.uniform(0.0, 0.99),
            g.uniform(0, 1200),
            g.uniform(0, 1),
        )
        rgb = iridescent_fresnel_khr(case[0], case[1], np.full(3, case[2]), case[3], case[4])
        assert np.abs(rgb - literal_text(*case)).max() <= 1e-12


def test_pole_of_the_base_index_is_undefined_and_recorded() -> None:
    film = Film.of(0.8, 300.0, 1.3, base_from_f0([[0.04] * 3, [0.9999] * 3, [0.04, 1.0, 0.04]]))
    evaluation = evaluate_khr(film, "D65")
    assert evaluation.undefined[POLE].tolist() == [False, True, True]
    assert np.all(np.isfinite(evaluation.rgb[0]))


def test_float32_pole_is_recorded_too() -> None:
    """0.9999 rounded to float32 lies below 0.9999, and float32 arithmetic divides by zero there."""
    rounded = np.full(3, np.float32(0.9999), dtype=np.float64)
    assert POLE in evaluate_khr(Film.of(0.8, 300.0, 1.3, base_from_f0(rounded)), "D65").undefined


def test_negative_argument_of_pow_is_recorded() -> None:
    film = Film.of(0.8, 300.0, np.array([1.3, 1.8]), base_from_ior(1.5))
    assert evaluate_khr(film, "D65").undefined[NEGATIVE_POW].tolist() == [False, True]


def test_ordinary_film_has_no_undefined_case() -> None:
    assert evaluate_khr(Film.of(0.8, 300.0, 1.3, base_from_ior(1.5)), "D65").undefined == {}


def test_total_reflection_is_white() -> None:
    film = Film.of(0.1, 300.0, 1.0, base_from_ior(1.5), outside_ior=1.5)
    assert np.array_equal(evaluate_khr(film, "D65").rgb, np.ones(3))


@pytest.mark.parametrize(
    ("film_ior", "outside_ior", "expected"),
    [(1.3, 1.3, 0.0), (float(np.nextafter(np.float32(1.3), np.float32(2))), float(np.float32(1.3)), 1.0)],
)
def test_branch_distance_counts_float32_steps(film_ior: float, outside_ior: float, expected: float) -> None:
    film = Film.of(1.0, 300.0, film_ior, base_from_ior(2.5), outside_ior)
    assert khr_branch_distance_ulp(film) == pytest.approx(expected, abs=0.01)


def test_branch_distance_is_large_for_ordinary_films() -> None:
    assert khr_branch_distance_ulp(Film.of(0.7, 300.0, 1.3, base_from_ior(1.5))) > 1e5


def test_equal_indices_take_the_phase_of_the_denser_second_medium() -> None:
    """The text turns the phase where the next index is lower, not where it is the same."""
    outside_ior, f0 = 1.5, np.full(3, 0.04)
    at, above, below = iridescent_fresnel_khr(
        outside_ior, outside_ior + np.array([0.0, 1e-9, -1e-9]), f0 + 0.2, 200.0, 0.4
    )
    assert np.abs(at - above).max() <= 1e-6
    assert np.abs(at - below).max() > 1e-3
