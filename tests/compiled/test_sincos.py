"""The compiled sine and cosine against 50 digits, and what they are compiled for."""

from __future__ import annotations

from collections.abc import Callable

import mpmath
import numpy as np
import pytest

pytest.importorskip("numba")

Pairs = Callable[..., None]


@pytest.fixture(scope="module")
def pairs() -> Pairs:
    from gltf_iri.compiled.loops import inline
    from gltf_iri.compiled.sincos import sincos_turns

    def write(turns, sine, cosine):  # type: ignore[no-untyped-def]
        for i in range(turns.size):
            sine[i], cosine[i] = sincos_turns(turns[i])

    return inline(write)  # unlike `loop`, keeps no machine code of an older formula


def both(pairs: Pairs, turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    sine, cosine = np.zeros_like(turns), np.zeros_like(turns)
    pairs(turns, sine, cosine)
    return sine, cosine


def test_sine_and_cosine_agree_with_50_digits_and_keep_their_digits_at_zeros(pairs: Pairs) -> None:
    g = np.random.default_rng(3)
    sixteenths = np.arange(-40, 41) / 16.0
    turns = np.concatenate([sixteenths, np.nextafter(sixteenths, 9.0), np.nextafter(sixteenths, -9.0)])
    turns = np.concatenate([turns, g.uniform(-3.0, 3.0, 500), g.uniform(0.0, 1e6, 300), [1e-9, -1e-300]])
    with mpmath.workdps(50):
        angles = [2 * mpmath.pi * mpmath.mpf(t) for t in turns.tolist()]
        for ours, exact in zip(both(pairs, turns), (mpmath.sin, mpmath.cos), strict=True):
            for mine, angle in zip(ours.tolist(), angles, strict=True):
                truth = exact(angle)
                assert abs(mine - truth) <= 2e-16
                assert abs(truth) < 1e-40 or abs(mine - truth) <= 4e-16 * abs(truth)


@pytest.mark.parametrize("turns", [np.nan, np.inf, -np.inf])
def test_no_angle_has_no_sine(pairs: Pairs, turns: float) -> None:
    assert np.all(np.isnan(both(pairs, np.array([turns]))))
