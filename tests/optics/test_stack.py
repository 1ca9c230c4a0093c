"""Stacks against 50 digits, against the tmm package, and against what no passive stack may do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tmm import absorp_in_each_layer, coh_tmm

from gltf_iri.bench.fifty_digits import stack_50_digits
from gltf_iri.errors import UsageError
from gltf_iri.optics.stack import StackResponse, stack

Case = tuple[list[complex], list[float], float, float]  # indices, thicknesses nm, λ nm, cos θ₁

BOUND = (
    1e-12  # some thousand layers' roundings; measured: 8e-15 on random stacks, 4e-13 on two thousand layers
)


def error(case: Case) -> float:
    """The greatest distance from 50 digits of R and T, and of R + T + A from 1, in either polarisation."""
    ours, exact = stack(*case), stack_50_digits(*case)
    pairs = [(getattr(ours, name), getattr(exact, name)) for name in ("R_s", "R_p", "T_s", "T_p")]
    return max(*(abs(float(theirs - float(value))) for value, theirs in pairs), *imbalance(ours))


def imbalance(powers: StackResponse) -> tuple[float, float]:
    s = powers.R_s + powers.T_s + powers.absorbed_s.sum(axis=0) - 1.0
    p = powers.R_p + powers.T_p + powers.absorbed_p.sum(axis=0) - 1.0
    return float(np.abs(s).max()), float(np.abs(p).max())


def dielectric(g: np.random.Generator) -> complex:
    return g.uniform(1.0, 3.0)


def anything(g: np.random.Generator) -> complex:
    kind = g.random()
    if kind < 0.4:
        return g.uniform(1.0, 3.0)
    if kind < 0.6:
        return complex(g.uniform(1.0, 3.0), 10.0 ** g.uniform(-12.0, -1.0))
    return complex(g.uniform(0.05, 4.0), g.uniform(0.01, 8.0))


def random_case(g: np.random.Generator, medium: Callable[[np.random.Generator], complex]) -> Case:
    """Up to twelve layers, the light from a medium that may be denser than any of them."""
    layers = int(g.integers(0, 13))
    indices = [g.uniform(1.0, 2.5), *(medium(g) for _ in range(layers)), medium(g)]
    thicknesses_nm = [
        g.uniform(0.0, 600.0) if g.random() < 0.9 else 10.0 ** g.uniform(-8.0, 3.5) for _ in range(layers)
    ]
    cosine = float(g.choice([g.uniform(0.0, 1.0), 10.0 ** g.uniform(-12.0, 0.0), 0.0, 1.0]))
    return indices, thicknesses_nm, g.uniform(360.0, 830.0), cosine


@pytest.mark.parametrize("medium", [dielectric, anything])
def test_random_stacks_agree_with_50_digits(
    medium: Callable[[np.random.Generator], complex], record_property: Callable[[str, object], None]
) -> None:
    g = np.random.default_rng(3)
    worst = max(error(random_case(g, medium)) for _ in range(120))
    record_property("measured", f"stacks against 50 digits, {medium.__name__}: {worst:.1e}")
    assert worst <= BOUND


CRITICAL = float(np.sqrt(1.0 - (1.0 / 1.5) ** 2))
QUARTER_AT_CRITICAL_NM = 550.0 / 4.0 / np.sqrt(4.0 - 1.5**2 * (1.0 - CRITICAL**2))

HARD: dict[str, Case] = {
    "bare interface": ([1.0, 1.5], [], 550.0, 0.5),
    "bare metal": ([1.0, 0.2 + 3.4j], [], 550.0, 0.5),
    "exactly grazing": ([1.0, 1.3, 1.5], [400.0], 550.0, 0.0),
    "nearly grazing": ([1.0, 1.3, 1.5], [400.0], 550.0, 1e-8),
    "flatter than squares can hold": ([1.0, 1.3, 1.5], [400.0], 550.0, 1e-300),
    "a slab in its own outside, grazing": ([1.0, 1.3, 1.0], [400.0], 550.0, 0.0),
    "no thickness": ([1.0, 1.3, 2.0 + 1.0j, 1.5], [0.0, 0.0], 550.0, 0.4),
    "least thickness": ([1.0, 1.3, 2.0 + 1.0j, 1.5], [5e-324, 1e-200], 550.0, 0.4),
    "least absorption": ([1.0, 1.5 + 5e-324j, 1.5], [400.0], 550.0, 0.5),
    "all equal": ([1.5, 1.5, 1.5, 1.5], [100.0, 1e6], 550.0, 0.4),
    "absorbs for 10⁴ wavelengths": ([1.0, 1.5 + 0.1j, 1.5], [550e4], 550.0, 0.7),
    "absorbs for 10⁴ wavelengths below films": (
        [1.0, 1.4, 1.5 + 0.01j, 2.0, 1.5],
        [99.0, 550e4, 200.0],
        550.0,
        0.7,
    ),
    "as thick as numbers allow": ([1.0, 1.5 + 3.0j, 1.5], [1e12], 550.0, 0.7),
    "frustrated gap": ([1.5, 1.0, 1.5], [400.0], 550.0, 0.4),
    "frustrated gap of a millimetre": ([1.5, 1.0, 1.5], [1e6], 550.0, 0.4),
    "cavity between frustrated gaps": ([1.5, 1.0, 2.0, 1.0, 1.5], [400.0, 137.0, 400.0], 431.7, 0.3),
    "critical angle": ([1.5, 1.0, 1.5], [200.0], 550.0, CRITICAL),
    "below the critical angle": ([1.5, 1.0, 1.5], [200.0], 550.0, float(np.nextafter(CRITICAL, 1.0))),
    "beyond the critical angle": ([1.5, 1.0, 1.5], [200.0], 550.0, float(np.nextafter(CRITICAL, 0.0))),
    "critical angle of the exit": ([1.5, 2.0, 1.0], [200.0], 550.0, CRITICAL),
    "a node where fields are asked for": ([1.5, 2.0, 1.0], [QUARTER_AT_CRITICAL_NM], 550.0, CRITICAL),
    "absorbs at the critical angle": ([1.5, 1.0 + 1e-12j, 1.5], [2000.0], 550.0, CRITICAL),
    "gaps that reflect in turn": ([1.5, *[1.0, 2.0] * 20, 1.5], [50.0, 120.0] * 20, 550.0, 0.3),
    "plasmon": ([1.5, 0.05 + 3.5j, 1.0], [50.0], 550.0, float(np.sqrt(1.0 - 0.7**2))),
    "exit that only absorbs": ([1.0, 1.4, 3.0j], [400.0], 550.0, 0.3),
    "200 cells": ([1.0, *[1.0, 1.5] * 200, 1.0], [315.0] * 400, 550.0, 0.6),
    "1000 cells": ([1.0, *[1.0, 1.5] * 1000, 1.0], [315.0] * 2000, 550.0, 0.6),
    "200 cells that absorb": ([1.0, *[1.0, 1.5 + 0.01j] * 200, 1.0], [315.0] * 400, 550.0, 0.6),
    "a millimetre": ([1.0, 1.4, 1.5], [1e6], 550.0, 0.7),
    "extreme indices": ([1e-6, 1e6, 1e-6, 1e6, 1e-6 + 1e6j], [1e12, 1e-12, 1e12], 550.0, 0.3),
}


@pytest.mark.parametrize("case", HARD.values(), ids=HARD.keys())
def test_hard_stacks_agree_with_50_digits(case: Case) -> None:
    assert error(case) <= BOUND


@pytest.mark.parametrize("cosine", [0.0, 5e-324, 1e-200, 1e-152, 1e-149, 1e-8])
def test_matched_media_let_the_flattest_light_pass(cosine: float) -> None:
    powers = stack([1.3, 1.3, 1.3], [400.0], 550.0, cosine)
    assert max(powers.R_s, powers.R_p) <= 1e-30
    assert powers.T_s == powers.T_p == pytest.approx(1.0, abs=1e-15)


def test_small_losses_keep_their_digits() -> None:
    """1 − R − T at 50 digits, relative to itself: subtracted in float64 it would keep four digits."""
    case: Case = ([1.0, 1.4 + 1e-12j, 0.2 + 3.4j], [300.0], 550.0, 0.6)
    ours, exact = stack(*case), stack_50_digits(*case)
    assert float(ours.absorbed_s[0]) == pytest.approx(float(1 - exact.R_s - exact.T_s), rel=1e-12)
    assert float(ours.absorbed_p[0]) == pytest.approx(float(1 - exact.R_p - exact.T_p), rel=1e-12)


def test_every_layer_absorbs_what_tmm_finds() -> None:
    g = np.random.default_rng(5)
    worst = 0.0
    for _ in range(60):
        indices, thicknesses_nm, wavelength_nm, _ = random_case(g, anything)
        indices, cosine = [1.0, *indices[1:]], g.uniform(0.05, 1.0)
        ours = stack(indices, thicknesses_nm, wavelength_nm, cosine)
        for polarisation in "sp":
            theirs = coh_tmm(
                polarisation, indices, [np.inf, *thicknesses_nm, np.inf], np.arccos(cosine), wavelength_nm
            )
            shares = [
                getattr(ours, f"R_{polarisation}"),
                *getattr(ours, f"absorbed_{polarisation}"),
                getattr(ours, f"T_{polarisation}"),
            ]
            worst = max(worst, float(np.abs(np.array(shares) - absorp_in_each_layer(theirs)).max()))
    assert worst <= 1e-11  # tmm takes fluxes apart by subtraction, and its angles from an arccosine


def test_only_absorbing_layers_absorb() -> None:
    powers = stack([1.5, 1.0, 1.46, 0.1 + 3.0j, 1.3], [300.0, 50.0, 20.0], 550.0, np.linspace(0.0, 1.0, 21))
    for absorbed in (powers.absorbed_s, powers.absorbed_p):
        assert not absorbed[:2].any()
        assert np.all(absorbed[2, 1:] > 0.0)


def test_thick_absorber_is_a_half_space() -> None:
    cosine = np.linspace(0.0, 1.0, 21)
    thick = stack([1.0, 1.4, 1.5 + 0.1j, 3.0], [200.0, 550e4], 550.0, cosine)
    endless = stack([1.0, 1.4, 1.5 + 0.1j], [200.0], 550.0, cosine)
    assert np.abs(thick.R_s - endless.R_s).max() <= 1e-15
    assert np.abs(thick.R_p - endless.R_p).max() <= 1e-15
    assert not thick.T_s.any()
    assert np.abs(thick.absorbed_p[1] - endless.T_p).max() <= 1e-14


def test_as_much_comes_through_from_either_side() -> None:
    """Also through layers that absorb, where the reflectances differ."""
    indices = [1.0, 1.46, 0.05 + 3.5j, 2.0 + 0.3j, 1.4]
    thicknesses_nm = [100.0, 20.0, 70.0]
    sine = np.linspace(0.0, 0.999, 40)
    down = stack(indices, thicknesses_nm, 550.0, np.sqrt(1.0 - sine**2))
    up = stack(indices[::-1], thicknesses_nm[::-1], 550.0, np.sqrt(1.0 - (sine / 1.4) ** 2))
    assert np.abs(down.T_s - up.T_s).max() <= 1e-14
    assert np.abs(down.T_p - up.T_p).max() <= 1e-14
    assert np.abs(down.R_s - up.R_s).max() > 0.1


def test_dispersive_layers_take_the_index_of_each_wavelength() -> None:
    wavelength_nm = np.linspace(400.0, 700.0, 7)
    glass, metal = 1.5 + 4000.0 / wavelength_nm**2, 0.2 + 1j * wavelength_nm / 150.0
    cosine = np.array([[0.2], [0.9]])
    whole = stack([1.0, glass, metal, 1.5], [150.0, 12.0], wavelength_nm, cosine)
    assert whole.T_p.shape == (2, 7)
    assert whole.absorbed_s.shape == (2, 2, 7)
    for i, single_nm in enumerate(wavelength_nm):
        single = stack([1.0, glass[i], metal[i], 1.5], [150.0, 12.0], single_nm, cosine[:, 0])
        assert np.abs(whole.absorbed_s[:, :, i] - single.absorbed_s).max() <= 1e-15


def test_thicknesses_of_many_stacks_run_along_their_own_axis() -> None:
    thicknesses_nm = np.array([[100.0], [300.0]])
    powers = stack([1.0, 1.3, 1.5], [thicknesses_nm], np.array([450.0, 550.0, 650.0]), 0.6)
    assert powers.R_s.shape == (2, 3)
    assert powers.R_s[1, 2] == stack([1.0, 1.3, 1.5], [300.0], 650.0, 0.6).R_s


@pytest.mark.parametrize("which", range(7))
def test_nan_gives_nan(which: int) -> None:
    numbers: list[Any] = [1.0, 1.4, 1.5, 300.0, 550.0, 0.6, 0.0]
    numbers[which] = np.nan
    outside, film, exit_index, thickness_nm, wavelength_nm, cosine, k = numbers
    powers = stack([outside, complex(film, k), exit_index], [thickness_nm], wavelength_nm, cosine)
    values = (powers.R_s, powers.R_p, powers.T_s, powers.T_p, powers.absorbed_s[0], powers.absorbed_p[0])
    assert np.isnan(values[:4]).all()
    if which != 2:  # what lies below decides what reaches the layer; its loss is known to be none
        assert np.isnan(values[4:]).all()


def test_stacks_that_cannot_be_are_refused() -> None:
    with pytest.raises(UsageError, match="wants 3 indices"):
        stack([1.0, 1.5], [300.0], 550.0, 0.5)
    with pytest.raises(UsageError, match="must be real"):
        stack([1.0 + 0.1j, 1.5], [], 550.0, 0.5)
    with pytest.raises(UsageError, match="do not broadcast"):
        stack([1.0, np.ones(2), 1.5], [300.0], np.ones(3), 0.5)
