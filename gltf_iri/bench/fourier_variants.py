"""What each approximation in the text costs: variants of the formula with one of them removed at a time.

They exist to be measured, for lossless films with a grey base; nothing renders with them. The sensitivities
are integrated numerically to full accuracy, so their times say nothing about a production version.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.khr import iridescent_fresnel_khr
from gltf_iri.optics.fresnel import amplitude_p, amplitude_s
from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["exact_interfaces", "exact_sensitivity", "khr_with_exact_sensitivity"]

Float64 = NDArray[np.float64]

_DEGREE: Final = 512  # resolves path differences up to 100 µm; the film set's sixth order has 21 µm


def exact_sensitivity(opd_nm: Float64, shift: Float64, white: White) -> Float64:
    """Return ∫ density(λ) cos(2π OPD/λ + shift) dλ, (..., 3), for OPD (...) and shift (..., 3)."""
    rule = colour_rule(_DEGREE, white)
    phase = 2.0 * np.pi * opd_nm[..., None] / rule.wavelength_nm
    return np.asarray(
        (np.cos(phase) @ rule.weights) * np.cos(shift) - (np.sin(phase) @ rule.weights) * np.sin(shift)
    )


def khr_with_exact_sensitivity(film: Film, white: White) -> Float64:
    """Return the text's formula (..., 3) with exact sensitivities in place of its Gaussians."""
    return iridescent_fresnel_khr(
        film.outside_ior,
        film.film_ior,
        film.base.f0,
        film.thickness_nm,
        film.cos_theta_1,
        sensitivity=lambda opd_nm, shift: exact_sensitivity(opd_nm, shift, white),
    )


def exact_interfaces(film: Film, white: White, orders: int) -> Float64:
    """Return the Fourier series (..., 3) of exact polarised interfaces, cut after `orders` terms.

    R = C₀ + Σ_m 2 C_m Ŝ(mD), C₀ = R₁₂ + R_s, C_m = (R_s − T₁₂₁)(r₂₁r₂₃)^m (Belcour & Barla 2017, Eq. 5–6)
    """
    n1, n2, n3 = film.outside_ior, film.film_ior, film.base.index[..., 0].real
    q1, q2, q3 = (normal_index(normal_index_squared(n, n1, film.cos_theta_1)) for n in (n1, n2, n3))
    opd_nm = 2.0 * film.thickness_nm * q2.real
    fringes = [exact_sensitivity(m * opd_nm, np.zeros(3), white) for m in range(1, orders + 1)]
    polarisations = (
        (amplitude_s(q1, q2).real, amplitude_s(q2, q3).real),
        (amplitude_p(n1, q1, n2, q2).real, amplitude_p(n2, q2, n3, q3).real),
    )
    return 0.5 * sum((_series(r12, r23, fringes) for r12, r23 in polarisations), np.zeros(3))


def _series(r12: Float64, r23: Float64, fringes: list[Float64]) -> Float64:
    R12, R23 = (r * r for r in (r12, r23))
    T121 = 1.0 - R12
    Rs = T121 * T121 * R23 / (1.0 - R12 * R23)
    colour = (R12 + Rs)[..., None] * np.ones(3)
    Cm = Rs - T121
    for fringe in fringes:
        Cm = Cm * (-r12 * r23)  # r₂₁ = −r₁₂
        colour = colour + 2.0 * Cm[..., None] * fringe
    return colour
