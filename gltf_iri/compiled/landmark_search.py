"""Compiled twin of the searches in gltf_iri/optics/landmarks.py, for the bands of many mirrors side by side.

Every root takes the same steps, so that all run in vector instructions.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["search_by_halving", "search_by_newton"]

# As in the twin.
_HALVINGS = 10
_TINY = 1e-150
_LEAST_SLOPE = 0.05


@inline
def _is_odd(mode: float) -> bool:
    return bool(mode - 2.0 * np.floor(0.5 * mode) == 1.0)


@inline
def _first_guess(kappa: float, sine: float, cosine: float, rho: float) -> float:
    """Return the closed-form guess of x in turns."""
    drive = kappa * sine
    root = np.sqrt(max(1.0 - drive * drive * (1.0 - rho * rho), 0.0))
    tangent = drive / max(root - kappa * rho * cosine, _TINY)
    size = abs(tangent)
    is_small = size <= 1.0
    quotient = size / ((1.0 + 0.28 * size * size) if is_small else (size * size + 0.28))
    arc = quotient if is_small else 0.5 * np.pi - quotient
    return float(np.copysign(arc, tangent) * (0.5 / np.pi))


@loop
def search_by_newton(
    count: int, steps: int, modes: Any, leans: Any, squares: Any, root: Any, found: Any
) -> None:
    """Fill found (3, count): start, Airy point and end of the first `count` bands.

    root : scratch (5, 3 count): κ, sine and cosine of φ, ρ, and x in turns of every root.
    """
    for i in range(count):
        m, rho = modes[i], leans[i]
        amplitude = np.sqrt(squares[i])
        sine, cosine = sincos_turns(0.25 * (rho * m))
        g, h = (cosine, -sine) if _is_odd(m) else (sine, cosine)
        root[0, i], root[1, i], root[2, i], root[3, i] = amplitude, abs(g), np.copysign(1.0, g) * h, rho
    for i in range(count):
        m, rho, k = modes[i], leans[i], count + i
        sine, cosine = sincos_turns(0.25 * (rho * (2.0 * m + 1.0)))
        sign = 1.0 if _is_odd(m) else -1.0
        root[0, k], root[1, k], root[2, k], root[3, k] = squares[i], sign * cosine, -sign * sine, rho
    for i in range(count):
        m, rho, k = modes[i] + 1.0, leans[i], 2 * count + i
        sine, cosine = sincos_turns(0.25 * (rho * m))
        g, h = (cosine, -sine) if _is_odd(m) else (sine, cosine)
        root[0, k], root[1, k], root[2, k], root[3, k] = root[0, i], abs(g), np.copysign(1.0, g) * h, -rho
    for i in range(3 * count):
        root[4, i] = _first_guess(root[0, i], root[1, i], root[2, i], root[3, i])
    for _ in range(steps):
        for i in range(3 * count):
            kappa, sine, cosine, rho, turns = root[0, i], root[1, i], root[2, i], root[3, i], root[4, i]
            sin_x, cos_x = sincos_turns(turns)
            sin_r, cos_r = sincos_turns(rho * turns)
            value = sin_x - kappa * (sine * cos_r + cosine * sin_r)
            slope = cos_x - kappa * rho * (cosine * cos_r - sine * sin_r)
            turns = turns - (0.5 / np.pi) * value / max(slope, _LEAST_SLOPE)
            root[4, i] = min(max(turns, -0.25), 0.25)
    for i in range(count):
        m = modes[i]
        airy = min(max(m + 0.5 + 2.0 * root[4, count + i], m), m + 1.0)
        found[0, i] = min(m + 4.0 * root[4, i], airy)
        found[1, i] = airy
        found[2, i] = max(m + 1.0 - 4.0 * root[4, 2 * count + i], airy)


@loop
def search_by_halving(count: int, modes: Any, leans: Any, squares: Any, root: Any, found: Any) -> None:
    """The same by ten halvings on (1 − r²) cos KΛ."""
    for which in (1, 0, 2):
        for i in range(count):
            root[0, i] = found[1, i] if which == 2 else modes[i]
            root[1, i] = found[1, i] if which == 0 else modes[i] + 1.0
            root[2, i] = 0.0 if which == 1 else (1.0 - squares[i]) * (1.0 - which)
        for _ in range(_HALVINGS):
            for i in range(count):
                low, high = root[0, i], root[1, i]
                middle = 0.5 * (low + high)
                _, cos_s = sincos_turns(0.5 * middle)
                _, cos_d = sincos_turns(0.5 * (leans[i] * middle))
                value = cos_s - squares[i] * cos_d
                is_before = (-value if _is_odd(modes[i]) else value) > root[2, i]
                root[0, i] = middle if is_before else low
                root[1, i] = high if is_before else middle
        for i in range(count):
            found[which, i] = 0.5 * (root[0, i] + root[1, i])
    for i in range(count):
        is_matched = squares[i] == 0.0
        found[0, i] = modes[i] if is_matched or modes[i] == 0.0 else found[0, i]
        found[2, i] = modes[i] + 1.0 if is_matched else found[2, i]
