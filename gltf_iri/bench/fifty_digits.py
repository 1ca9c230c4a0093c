"""Reflected and transmitted power of films, stacks and mirrors to 50 digits: errors are measured against it.

A layer is its characteristic matrix on the tangential fields (Abelès 1950; Born & Wolf, §1.6), in the form
for exp(−iωt) and n + ik:

    [[cos δ, −i sin δ/Y], [−iY sin δ, cos δ]],   δ = 2πqd/λ,   q² = n² − n₁² sin²θ₁,   Y = q (s) or q/n² (p)

It is even in q, so a layer needs no branch; the exit medium takes q with Re q ≥ 0 and Im q ≥ 0, the wave that
runs or fades onward. Numbers here have no greatest exponent, so nothing overflows where layers absorb or
reflect totally. Slow on purpose: no formula is shared with the fast code.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final, NamedTuple

from gltf_iri.errors import UsageError

__all__ = ["Powers", "mirror_50_digits", "stack_50_digits"]

# Powers of a cell lose up to twice log₁₀ of 10⁶ cells at a band edge, phases of thick layers some ten more.
_WORKING_DIGITS: Final = 90

_Matrix = tuple[tuple[Any, Any], tuple[Any, Any]]


class Powers(NamedTuple):
    """Shares of the incident power, each an mpf: reflected, and carried into the exit medium at its face."""

    R_s: Any
    R_p: Any
    T_s: Any
    T_p: Any

    @property
    def reflected(self) -> Any:
        """The reflected share of unpolarised light."""
        return _mean(self.R_s, self.R_p)

    @property
    def transmitted(self) -> Any:
        """The transmitted share of unpolarised light."""
        return _mean(self.T_s, self.T_p)


def stack_50_digits(
    indices: Sequence[complex], thicknesses_nm: Sequence[float], wavelength_nm: float, cos_theta_1: float
) -> Powers:
    """Return R and T of both polarisations for one stack at one wavelength and angle.

    indices : the outside (real), each layer, the exit medium; thicknesses_nm : of the layers alone. All are
    taken as the exact float64 values that they are. Raises UsageError where their numbers do not fit.
    """
    if len(indices) != len(thicknesses_nm) + 2:
        raise UsageError(f"{len(thicknesses_nm)} layers want {len(thicknesses_nm) + 2} indices.")
    layers = list(zip(indices[1:-1], thicknesses_nm, strict=True))
    return _powers(indices[0], layers, 1, indices[-1], wavelength_nm, cos_theta_1)


def mirror_50_digits(
    host_ior: float,
    n1: complex,
    n2: complex,
    d1_nm: float,
    d2_nm: float,
    cells: int,
    wavelength_nm: float,
    cos_theta_h: float,
) -> Powers:
    """Return R and T of both polarisations for `cells` cells; n1 is met first and lies beyond the last."""
    return _powers(host_ior, [(n1, d1_nm), (n2, d2_nm)], cells, n1, wavelength_nm, cos_theta_h)


def _mean(a: Any, b: Any) -> Any:
    from mpmath import mp

    with mp.workdps(_WORKING_DIGITS):  # mpmath rounds to the digits of where it is asked
        return (a + b) / 2


def _powers(
    outside: complex,
    cell: Iterable[tuple[complex, float]],
    repeats: int,
    exit_index: complex,
    wavelength_nm: float,
    cosine: float,
) -> Powers:
    from mpmath import mp

    if complex(outside).imag != 0.0:
        raise UsageError("Power that comes from an absorbing medium is not defined: its index must be real.")
    layers = list(cell)
    with mp.workdps(_WORKING_DIGITS):
        c, n_1 = mp.mpf(cosine), mp.mpf(complex(outside).real)
        turn = 2 * mp.pi / mp.mpf(wavelength_nm)

        def q_squared(n: Any) -> Any:
            """Return n² − n₁² sin²θ₁; written so that a flat angle's cosine is not lost beside 1."""
            return (n - n_1) * (n + n_1) + (n_1 * c) ** 2

        def admittance(n: Any, is_p: bool) -> Any:
            root = mp.sqrt(q_squared(n))
            q = mp.mpc(abs(root.real), abs(root.imag))
            return q / n**2 if is_p else q

        shares = []
        for is_p in (False, True):
            whole: _Matrix = ((mp.mpf(1), mp.mpf(0)), (mp.mpf(0), mp.mpf(1)))
            for index, thickness_nm in layers:
                n = mp.mpmathify(index)
                whole = _times(whole, _layer(mp, n, mp.sqrt(q_squared(n)), turn * thickness_nm, is_p))
            whole = _power(whole, repeats)
            y_1 = n_1 * c / (n_1**2 if is_p else 1)
            y_exit = admittance(mp.mpmathify(exit_index), is_p)
            front = whole[0][0] + whole[0][1] * y_exit
            other = whole[1][0] + whole[1][1] * y_exit
            total = y_1 * front + other
            if total == 0:  # grazing light on media that all match: nothing is there to reflect it
                shares.append((mp.mpf(0), mp.mpf(1)))
            else:
                reflected = abs((y_1 * front - other) / total) ** 2
                shares.append((reflected, 4 * y_1 * y_exit.real / abs(total) ** 2))
    (R_s, T_s), (R_p, T_p) = shares
    return Powers(R_s, R_p, T_s, T_p)


def _layer(mp: Any, n: Any, q: Any, turn_by_thickness: Any, is_p: bool) -> _Matrix:
    phase = turn_by_thickness * q
    scale = n**2 if is_p else 1
    sine_over_q = turn_by_thickness if q == 0 else mp.sin(phase) / q
    cosine = mp.cos(phase)
    return ((cosine, -1j * scale * sine_over_q), (-1j * q * q * sine_over_q / scale, cosine))


def _times(a: _Matrix, b: _Matrix) -> _Matrix:
    (a11, a12), (a21, a22) = a
    (b11, b12), (b21, b22) = b
    return (
        (a11 * b11 + a12 * b21, a11 * b12 + a12 * b22),
        (a21 * b11 + a22 * b21, a21 * b12 + a22 * b22),
    )


def _power(matrix: _Matrix, exponent: int) -> _Matrix:
    result, square, left = None, matrix, int(exponent)
    while left:
        if left & 1:
            result = square if result is None else _times(result, square)
        left >>= 1
        if left:
            square = _times(square, square)
    if result is None:
        raise UsageError("A mirror has at least one cell.")
    return result
