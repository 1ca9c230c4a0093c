"""The 50-digit truth against a second formulation: scattering amplitudes, interface by interface."""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest
from mpmath import mp

from gltf_iri.bench.fifty_digits import mirror_50_digits, stack_50_digits
from gltf_iri.errors import UsageError

DIGITS = 90
AGREE = mp.mpf(10) ** -50

CASES = {
    "film": ((1.0, 1.3, 1.5), (400.0,), 0.3),
    "film on metal": ((1.0, 1.3, 1.1 + 1.5j), (400.0,), 0.02),
    "lossy film": ((1.0, 1.5 + 0.3j, 2.2 + 4.0j), (250.0,), 0.7),
    "absorbing film of 100 wavelengths": ((1.0, 1.5 + 0.5j, 1.2), (50_000.0,), 0.7),
    "total reflection at the base": ((2.0, 1.7, 1.0), (400.0,), 0.4),
    "tunnelling through a gap": ((1.8, 1.0, 1.8), (400.0,), 0.4),
    "five layers, two of them evanescent": (
        (1.7, 1.2, 2.1, 1.05, 1.4 + 0.02j, 2.5, 1.9),
        (90.0, 60.0, 200.0, 40.0, 7.0),
        0.3,
    ),
    "near grazing": ((1.0, 1.38, 2.3, 1.5), (100.0, 50.0), 1e-8),
    "no layer": ((1.0, 1.5 + 2.0j), (), 0.5),
}


class Scatterer(NamedTuple):
    """Amplitudes of reflection and transmission for light from the front and from the back."""

    r: Any
    t: Any
    r_back: Any
    t_back: Any


def star(a: Scatterer, b: Scatterer) -> Scatterer:
    """Return a followed by b, all echoes between them summed (Redheffer 1959)."""
    echoes = 1 / (1 - a.r_back * b.r)
    return Scatterer(
        a.r + a.t * b.r * a.t_back * echoes,
        a.t * b.t * echoes,
        b.r_back + b.t_back * a.r_back * b.t * echoes,
        a.t_back * b.t_back * echoes,
    )


def onward(n: Any, transverse: Any) -> Any:
    root = mp.sqrt(mp.mpc(n) ** 2 - transverse)
    return mp.mpc(abs(root.real), abs(root.imag))


def interface(y_a: Any, y_b: Any) -> Scatterer:
    r = (y_a - y_b) / (y_a + y_b)
    return Scatterer(r, 1 + r, -r, 1 - r)


def propagation(phase: Any) -> Scatterer:
    gained = mp.exp(1j * phase)
    return Scatterer(mp.mpf(0), gained, mp.mpf(0), gained)


def scattered(
    outside: float,
    cell: list[tuple[complex, float]],
    repeats: int,
    last: complex,
    wavelength: float,
    cosine: float,
) -> list[Any]:
    """Return R_s, R_p, T_s, T_p; each layer between two interfaces to its neighbours, cells by doubling."""
    transverse = mp.mpf(outside) ** 2 * (1 - mp.mpf(cosine) ** 2)
    reflected, transmitted = [], []
    for is_p in (False, True):

        def admittance(n: complex, is_p: bool = is_p) -> Any:
            return onward(n, transverse) / (mp.mpc(n) ** 2 if is_p else 1)

        one: Scatterer | None = None
        first = cell[0][0] if cell else last
        for k, (n, d) in enumerate(cell):
            after = cell[(k + 1) % len(cell)][0]
            step = propagation(2 * mp.pi * onward(n, transverse) * mp.mpf(d) / mp.mpf(wavelength))
            step = star(step, interface(admittance(n), admittance(after)))
            one = step if one is None else star(one, step)
        whole = interface(admittance(outside), admittance(first))
        left = repeats if one is not None else 0
        while left and one is not None:
            whole = star(whole, one) if left & 1 else whole
            one, left = star(one, one), left >> 1
        whole = star(whole, interface(admittance(first), admittance(last)))
        reflected.append(abs(whole.r) ** 2)
        transmitted.append(abs(whole.t) ** 2 * admittance(last).real / admittance(outside).real)
    return [*reflected, *transmitted]


def assert_agree(ours: Any, theirs: list[Any]) -> None:
    assert all(abs(a - b) <= AGREE for a, b in zip(ours, theirs, strict=True))


@pytest.mark.parametrize("case", CASES)
def test_stacks_scatter_as_their_interfaces_do(case: str) -> None:
    indices, thicknesses_nm, cosine = CASES[case]
    with mp.workdps(DIGITS):
        cell = list(zip(indices[1:-1], thicknesses_nm, strict=True))
        for wavelength_nm in (360.0, 551.3, 830.0):
            ours = stack_50_digits(indices, thicknesses_nm, wavelength_nm, cosine)
            assert_agree(ours, scattered(indices[0].real, cell, 1, indices[-1], wavelength_nm, cosine))


@pytest.mark.parametrize("cells", [1, 2, 7, 10, 200, 10**6])
@pytest.mark.parametrize(("host", "n2"), [(1.0, 1.5), (1.3, 1.7), (1.0, 1.5 + 0.01j), (1.8, 0.9)])
def test_mirrors_scatter_as_their_interfaces_do(cells: int, host: float, n2: complex) -> None:
    n1, d1_nm, d2_nm = 1.1, 315.0, 290.0
    with mp.workdps(DIGITS):
        for wavelength_nm, cosine in ((400.0, 0.9), (611.7, 0.2)):
            ours = mirror_50_digits(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine)
            cell = [(n1, d1_nm), (n2, d2_nm)]
            assert_agree(ours, scattered(host, cell, cells, n1, wavelength_nm, cosine))


def test_a_mirror_is_the_stack_of_its_films() -> None:
    mirror = mirror_50_digits(1.2, 1.4, 1.9 + 0.02j, 120.0, 80.0, 6, 500.0, 0.6)
    stack = stack_50_digits([1.2, *[1.4, 1.9 + 0.02j] * 6, 1.4], [120.0, 80.0] * 6, 500.0, 0.6)
    with mp.workdps(DIGITS):
        assert_agree(mirror, list(stack))


def test_what_absorbs_nothing_loses_nothing() -> None:
    with mp.workdps(DIGITS):
        for cosine in (1.0, 0.3, 1e-8):
            powers = stack_50_digits([1.0, 1.3, 2.1, 1.5], [400.0, 1e6], 500.0, cosine)
            assert abs(powers.reflected + powers.transmitted - 1) <= AGREE
            assert abs(powers.R_s + powers.T_s - 1) <= AGREE


def test_thicknesses_0_and_quarter_wave_are_the_textbooks() -> None:
    with mp.workdps(DIGITS):
        bare = stack_50_digits([1.0, 1.7, 1.5], [0.0], 500.0, 1.0)
        assert abs(bare.reflected - (mp.mpf(1) / 5) ** 2) <= AGREE
        # 4·1.25 nm·100 = 500 nm: a quarter wave of √(n₁n₃) in exact binary numbers reflects nothing.
        quarter = stack_50_digits([1.0, 1.25, 1.5625], [100.0], 500.0, 1.0)
        assert quarter.reflected <= AGREE


def test_grazing_light_is_reflected_where_there_is_something_to_reflect_it() -> None:
    assert stack_50_digits([1.0, 1.3, 1.5], [400.0], 500.0, 0.0).reflected == 1
    assert stack_50_digits([1.0, 1.0, 1.0], [400.0], 500.0, 0.0).reflected == 0


def test_what_cannot_be_a_stack_is_refused() -> None:
    with pytest.raises(UsageError, match="want 3 indices"):
        stack_50_digits([1.0, 1.5], [400.0], 500.0, 1.0)
    with pytest.raises(UsageError, match="must be real"):
        stack_50_digits([1.0 + 0.1j, 1.5], [], 500.0, 1.0)
    with pytest.raises(UsageError, match="at least one cell"):
        mirror_50_digits(1.0, 1.0, 1.5, 100.0, 100.0, 0, 500.0, 1.0)
