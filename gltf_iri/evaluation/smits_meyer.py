"""Method `smits-meyer`: two beams, one from each side of the film, integrated over the spectrum.

Smits & Meyer 1992 as Belcour & Barla 2017 (§2, §4.1, Fig. 7b) describe it: unpolarised Fresnel reflectances,
no inter-reflections within the film, a base that does not conduct. With F₁₂ and F₂₃ at the refracted angle,

    R(λ) = F₁₂ + (1 − F₁₂)² F₂₃ ± 2(1 − F₁₂) √(F₁₂F₂₃) cos(2πD/λ),   D = 2n₂d cos θ₂,

+ where the index rises, or falls, at both interfaces: reflection on a denser medium turns the phase by π.
Of a base's index n + ik only n is used. The two beams' amplitudes are not those of a passive surface: their
sum passes 1 over bright bases, and is not clamped.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.integrate import MAX_DEGREE
from gltf_iri.colour.quadrature import colour_rule, resolved_opd_nm
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.optics.fresnel import amplitude_p, amplitude_s
from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["LONGEST_OPD_NM", "evaluate_smits_meyer"]

Float64 = NDArray[np.float64]

# The path difference that the fixed rule resolves with a tenth of its nodes to spare, some 0.19 mm. The eye
# sees no fringes from 0.05 mm on; beyond this one they are left out, where the rule would alias them.
LONGEST_OPD_NM: Final = 0.9 * resolved_opd_nm(MAX_DEGREE)

_ROWS_AT_ONCE: Final = 256  # bounds memory: 256 × 1025 cosines

# Below, n² underflows; a base of no real index, like one of an infinite one, reflects everything.
_NO_INDEX: Final = 1e-150


def evaluate_smits_meyer(film: Film, white: White) -> Evaluation:
    """Evaluate `smits-meyer`; a dispersive film or base has the one index of methods that know one only."""
    n1, n2, c1 = (a[..., None] for a in (film.outside_ior, film.film_ior, film.cos_theta_1))
    n3 = film.base.index.real
    is_mirror = np.isinf(n3) | (n3 < _NO_INDEX)
    is_denser = (n3 > n2) | np.isinf(n3)
    n3 = np.where(is_mirror, 1.0, n3)
    q1, q2, q3 = (normal_index(normal_index_squared(n, n1, c1)) for n in (n1, n2, n3))
    F12 = _unpolarised(n1, q1, n2, q2)
    F23 = np.where(is_mirror, 1.0, _unpolarised(n2, q2, n3, q3))

    # All light turns back at the film where it cannot enter: there T₁₂ is zero.
    T12 = np.where(q2.imag > 0.0, 0.0, 1.0 - F12)
    F12 = 1.0 - T12
    sign = np.where((n2 > n1) == is_denser, 1.0, -1.0)
    opd_nm = np.broadcast_to(2.0 * film.thickness_nm * q2[..., 0].real, film.shape)
    fringe = _fringes(opd_nm.reshape(-1), white).reshape(*film.shape, 3)
    rgb = F12 + T12 * T12 * F23 + 2.0 * T12 * np.sqrt(F12 * F23) * sign * fringe
    return Evaluation(np.array(np.broadcast_to(rgb, (*film.shape, 3))), "smits-meyer", str(white))


def _unpolarised(n_1: Any, q_1: Any, n_2: Any, q_2: Any) -> Float64:
    s, p = amplitude_s(q_1, q_2), amplitude_p(n_1, q_1, n_2, q_2)
    mean = 0.5 * (np.abs(s) ** 2 + np.abs(p) ** 2)
    return np.asarray(np.minimum(mean, 1.0))  # a last bit above 1, under total reflection


def _fringes(opd_nm: Float64, white: White) -> Float64:
    """Return the colour (r, 3) of cos(2πD/λ) for D = `opd_nm` (r,), by one dense rule for all."""
    rule = colour_rule(MAX_DEGREE, white)
    colour = np.zeros((len(opd_nm), 3))
    seen = np.flatnonzero(opd_nm <= LONGEST_OPD_NM)
    for start in range(0, len(seen), _ROWS_AT_ONCE):
        rows = seen[start : start + _ROWS_AT_ONCE]
        colour[rows] = np.cos((2.0 * np.pi) * opd_nm[rows, None] / rule.wavelength_nm) @ rule.weights
    return colour
