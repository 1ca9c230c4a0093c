"""Method `khr-guarded`: the text's formula with its undefined and discontinuous cases closed.

Each guard says what it prevents; `spec/iridescence-notes.md` shows the measurements behind the two constants.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE, eval_sensitivity
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.optics.refraction import cos_theta_2_squared

__all__ = [
    "MATCHED_F0",
    "MAX_F0",
    "MAX_R123",
    "THIN_OPD_NM",
    "evaluate_khr_guarded",
    "iridescent_fresnel_khr_guarded",
]

Float64 = NDArray[np.float64]

# Keeps the index of a perfect white metal finite.
MAX_F0: Final = 0.9999

# Keeps the geometric series from its pole where both interfaces reflect everything.
MAX_R123: Final = 0.9999

# Below this reflectance at normal incidence an interface's grazing reflectance shrinks with its contrast, so
# that film = base and film = outside are no interface at all; Schlick alone lets them reflect all at grazing.
MATCHED_F0: Final = 0.005

# Below this path difference the film fades into the bare base, as the text's own fringes do not.
THIN_OPD_NM: Final = 100.0

_ORDERS = (1, 2)


def iridescent_fresnel_khr_guarded(
    outside_ior: ArrayLike,
    film_ior: ArrayLike,
    base_f0: ArrayLike,
    thickness_nm: ArrayLike,
    cos_theta_1: ArrayLike,
) -> Float64:
    """Return the guarded film Fresnel, linear Rec.709 (..., 3) in [0, 1].

    outside_ior, film_ior, thickness_nm, cos_theta_1 : (...), broadcast together.
    base_f0 : (..., 3) in [0, 1].
    """
    n1, n2, d_nm, c1 = (
        np.asarray(a, dtype=np.float64)[..., None] for a in (outside_ior, film_ior, thickness_nm, cos_theta_1)
    )
    cos2_sq = cos_theta_2_squared(n1, n2, c1)
    # Under total internal reflection the answer is 1, below; 0 keeps the root real until then.
    c2 = np.sqrt(np.maximum(cos2_sq, 0.0))

    R12 = f_schlick_matched(ior_to_fresnel0(n2, n1), c1)
    T121 = 1.0 - R12
    base_ior = fresnel0_to_ior(np.clip(np.asarray(base_f0, dtype=np.float64), 0.0, MAX_F0))
    R23 = f_schlick_matched(ior_to_fresnel0(base_ior, n2), c2)

    opd_nm = 2.0 * n2 * d_nm * c2
    phi12 = np.where(n2 < n1, np.pi, 0.0)
    phi23 = np.where(base_ior < n2, np.pi, 0.0)
    phi = (np.pi - phi12) + phi23

    # No floor: it would draw fringes where an interface reflects nothing.
    R123 = np.minimum(R12 * R23, MAX_R123)
    r123 = np.sqrt(R123)
    Rs = T121 * T121 * R23 / (1.0 - R123)

    film = R12 + Rs
    Cm = Rs - T121
    for m in _ORDERS:
        Cm = Cm * r123
        # Divided by its own white, a fringe is as white as the constant term.
        film = film + Cm * 2.0 * eval_sensitivity(m * opd_nm[..., 0], m * phi) / SENSITIVITY_WHITE

    bare = f_schlick(ior_to_fresnel0(base_ior, n1), c1)
    presence = _smoothstep(opd_nm / THIN_OPD_NM)
    # Truncation to two orders overshoots on both sides; a passive surface does not.
    colour = np.clip(bare + (film - bare) * presence, 0.0, 1.0)
    return np.asarray(np.where(cos2_sq < 0.0, 1.0, colour))


def f_schlick_matched(f0: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """Return F₀ + (F₉₀ − F₀)(1 − cos θ)⁵ with F₉₀ = min(1, F₀/MATCHED_F0): no contrast, no reflection."""
    f0 = np.asarray(f0, dtype=np.float64)
    f90 = np.minimum(1.0, f0 / MATCHED_F0)
    return np.asarray(f0 + (f90 - f0) * (1.0 - np.asarray(cos_theta, dtype=np.float64)) ** 5)


def evaluate_khr_guarded(film: Film, white: White) -> Evaluation:
    """Evaluate `khr-guarded`; both terms have the white (1, 1, 1), whichever white that stands for."""
    rgb = iridescent_fresnel_khr_guarded(
        film.outside_ior, film.film_ior, film.base.f0, film.thickness_nm, film.cos_theta_1
    )
    return Evaluation(np.broadcast_to(rgb, (*film.shape, 3)), "khr-guarded", str(white))


def _smoothstep(x: Float64) -> Float64:
    t = np.clip(x, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
