"""What a Bragg mirror's cell is to light at one angle: the constants that no wavelength changes.

A cell is a film n1 of thickness d1, met first, and a film n2 of d2; beyond the last cell lies n1 again.
Light comes from a host of index n_h. q = n cos θ is a medium's index along the normal; Y = q (s) and
Y = q/n² (p) are its admittances. Convention exp(−iωt).
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.refraction import normal_index_squared

__all__ = ["NO_NORMAL_INDEX", "Cell", "cell_optics", "frustrated_cell_optics"]

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
    if not is_frustrated.any():
        return cell
    return replace(
        cell, **{f.name: np.where(is_frustrated, np.nan, getattr(cell, f.name)) for f in fields(cell)}
    )


def frustrated_cell_optics(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cos_theta_h: ArrayLike,
) -> tuple[Cell, NDArray[np.bool_]]:
    """Return the constants also where light fades in n2, and where it does.

    There q₂ = i|q₂|; path_2_nm, contrast and imbalance hold |q₂| for q₂. NaN stays where it fades in n1.
    """
    host, first, second, d1, d2, c = (
        np.asarray(a, dtype=np.float64) for a in (host_ior, n1, n2, d1_nm, d2_nm, cos_theta_h)
    )
    squared_1, squared_2 = (normal_index_squared(n, host, c).real for n in (first, second))
    q_h = np.maximum(host * c, NO_NORMAL_INDEX)
    q_1 = np.maximum(np.sqrt(np.where(squared_1 < 0.0, np.nan, squared_1)), NO_NORMAL_INDEX)
    q_2 = np.maximum(np.sqrt(np.abs(squared_2)), NO_NORMAL_INDEX)

    tangential = host * host * ((1.0 - c) * (1.0 + c))  # (n sin θ)², the same in every medium
    hh, n1n1, n2n2 = host * host, first * first, second * second
    # Y₂² − Y₁² as products: q₂² − q₁² = n2² − n1²; for p, with a factor that vanishes at Brewster's angle.
    imbalance_s = (second - first) * (second + first) / (2.0 * q_1 * q_2)
    brewster = tangential * (n1n1 + n2n2) / (n1n1 * n2n2) - 1.0
    sum_s, sum_p = q_h + q_1, n1n1 * q_h + hh * q_1
    step = (host - first) * (host + first)
    constants = (
        q_1 * d1,
        q_2 * d2,
        q_2 / q_1,
        (q_2 * n1n1) / (q_1 * n2n2),
        imbalance_s,
        imbalance_s * brewster,
        step / (sum_s * sum_s),
        step * (tangential * (n1n1 + hh) - n1n1 * hh) / (sum_p * sum_p),
        4.0 * q_h * q_1 / (sum_s * sum_s),
        4.0 * (n1n1 * q_h) * (hh * q_1) / (sum_p * sum_p),
    )
    *each, is_frustrated = np.broadcast_arrays(*constants, squared_2 < 0.0)
    return Cell(*each), is_frustrated
