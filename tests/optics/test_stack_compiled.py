"""The compiled stack gives the same numbers as numpy, however the axes lie."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.stack import StackPower, stack_power

BACKENDS_AGREE = 1e-13


def apart(first: StackPower, second: StackPower) -> float:
    names = ("R_s", "R_p", "T_s", "T_p")
    return max(float(np.abs(getattr(first, name) - getattr(second, name)).max()) for name in names)


def both(*arguments: object) -> tuple[StackPower, StackPower]:
    numpy, numba = (stack_power(*arguments, backend=backend) for backend in ("numpy", "numba"))
    assert numba.R_s.shape == numpy.R_s.shape
    return numpy, numba


COSINES = np.concatenate([[0.0, 1e-300, 1e-8, 1.0], np.linspace(0.01, 0.99, 41)])[:, None]
WAVELENGTHS_NM = np.linspace(360.0, 830.0, 301)

STACKS: dict[str, tuple[list[object], list[object]]] = {
    "bare": ([1.0, 1.5], []),
    "film": ([1.0, 1.3, 1.5], [400.0]),
    "gap": ([1.5, 1.0, 1.5], [400.0]),
    "total reflection at the exit": ([1.5, 2.0, 1.0], [100.0]),
    "metals": ([1.0, 1.46, 0.05 + 3.5j, 1.46, 0.05 + 3.5j, 1.5], [100.0, 20.0, 150.0, 20.0]),
    "faint absorption": ([1.0, 1.5 + 1e-9j, 2.0], [3000.0]),
    "exit that absorbs": ([1.0, 1.4, 0.2 + 3.4j], [250.0]),
    "opaque": ([1.0, 1.5 + 0.1j, 1.5], [550e4]),
    "dispersive": (
        [1.0, 1.5 + 4000.0 / WAVELENGTHS_NM**2, 0.2 + 1j * WAVELENGTHS_NM / 150.0, 1.5],
        [150.0, 12.0],
    ),
    "mirror": ([1.0, *[1.0, 1.5] * 20, 1.0], [315.0] * 40),
    "mirror that absorbs": ([1.0, *[1.6 + 1e-3j, 1.5 + 0.01j] * 20, 1.6], [90.0] * 40),
}


@pytest.mark.parametrize("which", STACKS)
def test_backends_agree(which: str) -> None:
    """To 1e-13, or within what the last bit of the wavelength changes: mirrors have resonances so sharp."""
    numpy, numba = both(*STACKS[which], WAVELENGTHS_NM, COSINES)
    beside = stack_power(*STACKS[which], np.nextafter(WAVELENGTHS_NM, 0.0), COSINES)
    for name in ("R_s", "R_p", "T_s", "T_p"):
        ours, theirs, last_bit = (getattr(each, name) for each in (numpy, numba, beside))
        assert np.all(np.abs(ours - theirs) <= np.maximum(BACKENDS_AGREE, np.abs(last_bit - ours)))


@pytest.mark.parametrize("shape", [(), (7,), (2, 3), (3, 1, 2), (2, 3, 2, 3)])
def test_any_axes_will_do(shape: tuple[int, ...]) -> None:
    g = np.random.default_rng(1)
    thickness_nm, metal = g.uniform(0.0, 500.0, shape), g.uniform(0.1, 1.0, shape[-1:]) + 2j
    cosine = g.uniform(0.0, 1.0, (*shape[:1], *(1,) * (len(shape) - 1)))
    arguments = ([1.0, 1.4, metal, 1.5], [thickness_nm, 15.0], 550.0, cosine)
    assert both(*arguments)[1].T_p.shape == shape
    assert apart(*both(*arguments)) <= BACKENDS_AGREE


def test_nothing_gives_nothing() -> None:
    assert both([1.0, 1.4, 1.5], [np.zeros(0)], 550.0, 0.5)[1].R_s.shape == (0,)


@pytest.mark.parametrize("medium", [1.4, 1.4 + 0.1j])
def test_nan_gives_nan(medium: complex) -> None:
    thickness_nm = np.array([100.0, np.nan, 300.0])
    for powers in both([1.0, medium, 1.5], [thickness_nm], 550.0, 0.6):
        for values in (powers.R_s, powers.R_p, powers.T_s, powers.T_p):
            assert np.isnan(values).tolist() == [False, True, False]
