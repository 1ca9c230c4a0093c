"""What a Bragg mirror's cell is to light at one angle: the constants that no wavelength changes.

A cell is a film n1 of thickness d1, met first, and a film n2 of d2; beyond the last cell lies n1 again.
Light comes from a host of index n_h. q = n cos θ is a medium's index along the normal; Y = q (s) and
Y = q/n² (p) are its admittances. Convention exp(−iωt).
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.refraction import normal_index_squared_exact

__all__ = ["NO_NORMAL_INDEX", "Cell", "Films", "Host", "cell_optics", "film_optics"]
__all__ += ["frustrated_cell_optics", "host_optics"]

Float64 = NDArray[np.float64]

# Stands for q = 0, light along the films: X = Y₂/Y₁ stays finite, its product with sin k₁d₁ keeps its limit.
NO_NORMAL_INDEX: Final = 1e-75


@dataclass(frozen=True, slots=True)
class Cell:
    """Constants of a lossless cell; each has the arguments' broadcast shape.

    path_1_nm, path_2_nm : q₁d₁ and q₂d₂; a film's phase k_z d is 2π·path/λ.
    contrast_s, contrast_p : X = Y₂/Y₁.
    imbalance_s, imbalance_p : ½(X − 1/X), without the cancellation of that difference at n1 ≈ n2.
    host_r_s, host_r_p : r_h1 = (n_h c_h − n1 c1)/(…) and (n1 c_h − n_h c1)/(…), from the host into n1.
    host_t_s, host_t_p : 1 − r_h1², without cancellation where r_h1 nears ±1.
    All are NaN where light does not run in both films (total reflection).
    """

    path_1_nm: Float64
    path_2_nm: Float64
    contrast_s: Float64
    contrast_p: Float64
    imbalance_s: Float64
    imbalance_p: Float64
    host_r_s: Float64
    host_r_p: Float64
    host_t_s: Float64
    host_t_p: Float64


class Films(NamedTuple):
    """What `Cell` says of the two films, also where light fades in n2; arrays broadcast.

    There q₂ = i|q₂|, and path_2_nm, contrast and imbalance hold |q₂| for q₂. NaN where light fades in n1.
    """

    path_1_nm: Float64
    path_2_nm: Float64
    contrast_s: Float64
    contrast_p: Float64
    imbalance_s: Float64
    imbalance_p: Float64
    fades_in_1: NDArray[np.bool_]
    fades_in_2: NDArray[np.bool_]


class Host(NamedTuple):
    """What `Cell` says of the step from the host into n1; arrays broadcast."""

    r_s: Float64
    r_p: Float64
    t_s: Float64
    t_p: Float64


def cell_optics(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cos_theta_h: ArrayLike,
) -> Cell:
    """Return the cell's constants for real indices (Yeh 1988; Fourneau et al. 2024, Eq. 8 and Appendix D)."""
    cell, is_frustrated = frustrated_cell_optics(host_ior, n1, n2, d1_nm, d2_nm, cos_theta_h)
    return _without(cell, is_frustrated)


def frustrated_cell_optics(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cos_theta_h: ArrayLike,
) -> tuple[Cell, NDArray[np.bool_]]:
    """Return the constants also where light fades in n2, with |q₂| for q₂, and where it does."""
    films = film_optics(host_ior, n1, n2, d1_nm, d2_nm, cos_theta_h)
    *constants, fades_in_1, fades_in_2 = np.broadcast_arrays(
        *films[:6], *host_optics(host_ior, n1, cos_theta_h), films.fades_in_1, films.fades_in_2
    )
    return _without(Cell(*constants), fades_in_1), fades_in_2


def _without(cell: Cell, mask: NDArray[np.bool_]) -> Cell:
    if not mask.any():
        return cell
    return replace(cell, **{f.name: np.where(mask, np.nan, getattr(cell, f.name)) for f in fields(cell)})


def film_optics(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cos_theta_h: ArrayLike,
) -> Films:
    """Return the constants of the two films under a host."""
    host, first, second, d1, d2, c = (
        np.asarray(a, dtype=np.float64) for a in (host_ior, n1, n2, d1_nm, d2_nm, cos_theta_h)
    )
    q_1, fades_in_1 = _along_normal(first, host, c)
    q_2, fades_in_2 = _along_normal(second, host, c)
    n1n1, n2n2 = first * first, second * second
    tangential = host * host * ((1.0 - c) * (1.0 + c))  # (n sin θ)², the same in every medium
    contrast = q_2 / q_1
    # Y₂² − Y₁² as products: q₂² − q₁² = n2² − n1²; for p, with a factor that vanishes at Brewster's angle.
    imbalance_s = (0.5 * (second - first) * (second + first)) / (q_1 * q_2)
    brewster = tangential * ((n1n1 + n2n2) / (n1n1 * n2n2)) - 1.0
    return Films(
        np.where(fades_in_1, np.nan, q_1 * d1) if fades_in_1.any() else q_1 * d1,
        q_2 * d2,
        contrast,
        contrast * (n1n1 / n2n2),
        imbalance_s,
        imbalance_s * brewster,
        fades_in_1,
        fades_in_2,
    )


def host_optics(host_ior: ArrayLike, n1: ArrayLike, cos_theta_h: ArrayLike) -> Host:
    """Return r_h1 and 1 − r_h1² of both polarisations; meaningless where light fades in n1."""
    host, first, c = (np.asarray(a, dtype=np.float64) for a in (host_ior, n1, cos_theta_h))
    q_h, (q_1, _) = np.maximum(host * c, NO_NORMAL_INDEX), _along_normal(first, host, c)
    hh, n1n1 = host * host, first * first
    tangential = hh * ((1.0 - c) * (1.0 + c))
    sum_s, sum_p = q_h + q_1, n1n1 * q_h + hh * q_1
    step = (host - first) * (host + first)
    return Host(
        step / (sum_s * sum_s),
        step * (tangential * (n1n1 + hh) - n1n1 * hh) / (sum_p * sum_p),
        4.0 * q_h * q_1 / (sum_s * sum_s),
        4.0 * (n1n1 * q_h) * (hh * q_1) / (sum_p * sum_p),
    )


def _along_normal(index: Float64, host_ior: Float64, c: Float64) -> tuple[Float64, NDArray[np.bool_]]:
    """Return |q| of a film, never 0, and where light fades in it.

    To the last bit, because a sharp band magnifies one rounding of a phase beyond 1e-13.
    """
    squared = np.asarray(normal_index_squared_exact(index, host_ior, c)[0])
    return np.maximum(np.sqrt(np.abs(squared)), NO_NORMAL_INDEX), squared < 0.0
