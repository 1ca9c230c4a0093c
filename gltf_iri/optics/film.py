"""The exact reflectance of one film that absorbs nothing: every inter-reflection, both polarisations.

The Airy sum r = (r₁₂ + r₂₃e^{2iβ})/(1 + r₁₂r₂₃e^{2iβ}) (Belcour & Barla 2017, Eq. 2–3) is, with the
admittances Y = q (s) and Y = q/n² (p), q = n cos θ, and β = 2πd q₂/λ,

    r = (Y₁ − Y₃ + i tan β (Y₂² − Y₁Y₃)/Y₂) / (Y₁ + Y₃ − i tan β (Y₂² + Y₁Y₃)/Y₂).

What does not return enters the base, so that

    R = 1 − κ(1 + tan²β) / ((1 + g tan β)² + (h tan β)²),    κ = 4Y₁ Re Y₃/|Y₁ + Y₃|²,
    g − ih = −i(Y₂² + Y₁Y₃) / (Y₂(Y₁ + Y₃)),

where κ, g and h belong to the angle, one tangent serves both polarisations, and no nearly equal numbers are
subtracted towards grazing light, where r₁₂ → −1. In a frustrated film q₂ and tan β are imaginary: Y₂² and
tan²β change sign. Convention exp(−iωt), index n + ik, k ≥ 0. Twin: `gltf_iri.compiled.film`.
`gltf_iri.optics.airy` has films that absorb, and what is transmitted.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import Backend
from gltf_iri.optics.blocks import blocks, part, scratch
from gltf_iri.optics.film_phase import phase_factors, table, write_tangent
from gltf_iri.optics.refraction import (
    normal_index,
    normal_index_squared,
    normal_index_squared_exact,
    normal_index_squared_real,
)
from gltf_iri.optics.two_floats import square_root

__all__ = ["film_reflectance", "film_reflectance_polarised"]

Float64 = NDArray[np.float64]

_NO_INDEX: Final = 1e-150  # below, n² underflows; such a base reflects everything

# Flatter light than this is at its limit to the last bit; no square of it underflows, no ratio overflows.
_GRAZING: Final = 1e-40

# From so many half turns on, phases are multiplied with twice float64's digits: each would cost 4e-16 rad.
_MANY_HALF_TURNS: Final = 4.0
_SHARP: Final = 0.05**2  # so do resonances narrower than this, squared


def film_reflectance(
    outside_ior: ArrayLike,
    film_ior: ArrayLike,
    base_index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
    *,
    backend: Backend = "numpy",
) -> Float64:
    """Return the mean of R_s and R_p of a film that absorbs nothing; all arguments broadcast.

    base_index : n + ik, k ≥ 0; ∞ or 0 is the perfect mirror. outside_ior, film_ior : real.
    What depends on the angle is computed in the shape of indices and cosine alone. Give the wavelengths an
    axis of their own, best the last: film_reflectance(1.0, 1.3, 1.5, 400.0, wavelength_nm, cosine[:, None]).
    """
    if backend == "numba":
        from gltf_iri.compiled.film import film_reflectance as compiled

        return compiled(outside_ior, film_ior, base_index, thickness_nm, wavelength_nm, cos_theta_1)
    films = _Films(outside_ior, film_ior, base_index, thickness_nm, wavelength_nm, cos_theta_1)
    return films.reflectances(mean=True)[0]


def film_reflectance_polarised(
    outside_ior: ArrayLike,
    film_ior: ArrayLike,
    base_index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
) -> tuple[Float64, Float64]:
    """Return R_s and R_p; arguments as in `film_reflectance`."""
    films = _Films(outside_ior, film_ior, base_index, thickness_nm, wavelength_nm, cos_theta_1)
    s, p = films.reflectances(mean=False)
    return s, p


class _Films:
    """Films, with what they keep from one wavelength to the next in the shape of indices and cosine."""

    def __init__(
        self,
        outside_ior: ArrayLike,
        film_ior: ArrayLike,
        base_index: ArrayLike,
        thickness_nm: ArrayLike,
        wavelength_nm: ArrayLike,
        cos_theta_1: ArrayLike,
    ) -> None:
        given = (outside_ior, film_ior, thickness_nm, wavelength_nm, cos_theta_1)
        n1, n2, thickness, wavelength, c1 = (np.asarray(a, dtype=np.float64) for a in given)
        n3: Any = np.asarray(base_index, dtype=np.complex128)
        self.shape = np.broadcast(n1, n2, n3, thickness, wavelength, c1).shape
        c1 = np.maximum(c1, _GRAZING)
        size = np.abs(n3)
        is_mirror = (size < _NO_INDEX) | np.isinf(size)
        share: Any = 2.0  # half of 4: the mean of both polarisations
        if np.any(is_mirror):
            n3, share = np.where(is_mirror, 1.0, n3), np.where(is_mirror, 0.0, share)

        q2_squared = normal_index_squared_real(n2, n1, c1)
        is_frustrated = q2_squared < 0.0
        sign: Any = 1.0
        self._sign = None
        if np.any(is_frustrated):
            sign = np.where(is_frustrated, -1.0, 1.0)
            self._sign = sign[None]
        q2: Any = np.sqrt(np.maximum(sign * q2_squared, _GRAZING**2))
        if np.any(n3.imag):
            of: Any = _on_absorber
            q3: Any = normal_index(normal_index_squared(n3, n1, c1))
        else:  # what a real base reflects in total enters it nowhere: Re q₃ = 0
            of, n3 = _on_dielectric, n3.real
            q3 = np.sqrt(np.maximum(normal_index_squared_real(n3, n1, c1), 0.0))
        y1, y2 = n1 * c1, q2
        s = of(share, y1, sign, y2, q3)
        p = of(share, y1 / (n1 * n1), sign, y2 / (n2 * n2), q3 / (n3 * n3))
        # κ/2, h² and, where a base absorbs, g: of s, then of p
        self._coefficients = table(*s, *p)

        digits: tuple[Any, ...] = (q2,)
        most = [np.max(a, initial=0.0) for a in (thickness, n1, n2)]
        half_turns = 2.0 * most[0] * max(most[1:]) / np.min(wavelength, initial=np.inf)
        self._is_sharp = _is_sharp(*s) or _is_sharp(*p)
        if half_turns > _MANY_HALF_TURNS or self._is_sharp:
            exact, low = normal_index_squared_exact(n2, n1, c1)
            digits = square_root(np.maximum(sign * exact, _GRAZING**2), sign * low)
        self._by_angle, self._by_wavelength = phase_factors(digits, 2.0 * thickness, wavelength)

    def reflectances(self, *, mean: bool) -> list[Float64]:
        """Return [(R_s + R_p)/2] or [R_s, R_p], each of `shape`."""
        shape = self.shape or (1,)
        answers = [np.zeros(shape) for _ in range(1 if mean else 2)]
        axes, rows = len(shape), len(self._coefficients)
        space = np.zeros((0, 0))
        for piece in blocks(shape):
            pieces = [each[piece] for each in answers]
            if space.shape[1] < pieces[0].size:
                space = scratch(rows + 3, pieces[0].size)
            work = space[:, : pieces[0].size].reshape(rows + 3, *pieces[0].shape)
            # Written out: numpy's loops over broadcast arrays take three times as long.
            np.copyto(work[:rows], part(self._coefficients, piece, axes))
            sign = None if self._sign is None else part(self._sign, piece, axes)[0]
            a, b = (part(each, piece, axes) for each in (self._by_angle, self._by_wavelength))
            write_tangent(a, b, sign, self._is_sharp, *work[rows:])
            s, p, both = _entering(work[:rows], work[rows], sign, work[rows + 1])
            for answer, half, other in zip(pieces, (s, p), (p if mean else s, p), strict=False):
                half += other
                half *= both
                np.subtract(1.0, half, out=half)
                # A last bit below 0 is rounding, where nothing is reflected.
                np.maximum(half, 0.0, out=answer)
        return [answer.reshape(self.shape) for answer in answers]


def _on_dielectric(share: Any, y1: Any, sign: Any, y2: Any, y3: Any) -> tuple[Any, Any]:
    """Return share·κ/4 and h²."""
    total = y1 + y3
    h = (sign * (y2 * y2) + y1 * y3) / (y2 * total)
    return share * y1 * y3 / (total * total), h * h


def _on_absorber(share: Any, y1: Any, sign: Any, y2: Any, y3: Any) -> tuple[Any, Any, Any]:
    """Return share·κ/4, h² and g."""
    x3, z3 = np.maximum(y3.real, 0.0), y3.imag  # a last bit below 0 would be light from inside
    total, absorbed, inside = y1 + x3, z3 * z3, sign * (y2 * y2)
    size = total * total + absorbed
    scale = 1.0 / (y2 * size)
    h = ((inside + y1 * x3) * total + y1 * absorbed) * scale
    return share * y1 * x3 / size, h * h, (y1 * y1 - inside) * z3 * scale


def _is_sharp(_: Any, h_squared: Any, g: Any = 0.0) -> bool:
    """Return whether a resonance is so narrow, h/(1 + g²) or 1/h, that it magnifies what rounds the phase."""
    wide = 1.0 + g * g
    return bool(np.any((h_squared < _SHARP * (wide * wide)) | (h_squared * _SHARP > 1.0)))


def _entering(
    coefficients: Float64, t: Float64, sign: Float64 | None, square: Float64
) -> tuple[Float64, Float64, Float64]:
    """Return half of what enters the base in s and p over 1 + t², and 1 + t²; overwrites its arguments."""
    np.multiply(t, t, out=square)
    half = len(coefficients) // 2
    s, p = coefficients[:half], coefficients[half:]
    for entering, h_squared, *g in (s, p):
        h_squared *= square
        if g:
            resonance = np.multiply(g[0], t, out=g[0])
            resonance += 1.0
            h_squared += np.multiply(resonance, resonance, out=resonance)
        else:
            h_squared += 1.0
        entering /= h_squared
    if sign is not None:
        square *= sign
    square += 1.0
    return s[0], p[0], square
