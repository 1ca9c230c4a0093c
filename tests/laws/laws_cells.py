"""Laws that mirrors keep at one wavelength, asked of the optics functions that methods are made of."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from laws_law import Float64, Law, distance
from numpy.typing import ArrayLike

from gltf_iri.optics.airy import film_power
from gltf_iri.optics.bragg import bragg_powers
from gltf_iri.optics.film import film_reflectance
from gltf_iri.optics.stack import stack

__all__ = ["CELL_LAWS", "CELL_SUBJECTS"]

WAVELENGTHS_NM = np.linspace(380.0, 780.0, 41)
SINES = np.array([0.0, 0.3, 0.7, 0.9, 0.999])[:, None]
HOST, N1, N2, LOSSY = 1.0, 1.3, 1.9, 1.9 + 0.02j
D1_NM, D2_NM, CELLS = 120.0, 90.0, 10


class Cells(NamedTuple):
    """A mirror's media and measures, in the order of `bragg_powers`."""

    host_ior: ArrayLike = HOST
    n1: ArrayLike = N1
    n2: ArrayLike = N2
    d1_nm: ArrayLike = D1_NM
    d2_nm: ArrayLike = D2_NM
    cells: int = CELLS


def _bragg(mirror: Cells) -> tuple[Float64, ...]:
    return tuple(bragg_powers(*mirror, WAVELENGTHS_NM, _cosine(mirror.host_ior)))


def _stack(mirror: Cells) -> tuple[Float64, ...]:
    host, n1, n2, d1_nm, d2_nm, cells = mirror
    powers = stack(
        [host, *[n1, n2] * cells, n1], [d1_nm, d2_nm] * cells, WAVELENGTHS_NM, _cosine(mirror.host_ior)
    )
    absorbed = powers.absorbed_s.sum(axis=0), powers.absorbed_p.sum(axis=0)
    return powers.R_s, powers.R_p, powers.T_s, powers.T_p, *absorbed


# powers(mirror) → R_s, R_p, T_s, T_p, A_s, A_p, for SINES and WAVELENGTHS_NM
CELL_SUBJECTS: dict[str, Callable[[Cells], tuple[Float64, ...]]] = {
    "optics/bragg": _bragg,
    "optics/stack": _stack,
}


def _cosine(index: ArrayLike) -> Float64:
    return np.sqrt(1.0 - (SINES / np.asarray(index)) ** 2)


def full_order(subject: str) -> float:
    powers = CELL_SUBJECTS[subject]
    orders_nm = (WAVELENGTHS_NM / (2.0 * n * _cosine(n)) for n in (N1, N2))
    d1_nm, d2_nm = (d + order for d, order in zip((D1_NM, D2_NM), orders_nm, strict=True))
    thin = powers(Cells())
    thicker = (powers(Cells(d1_nm=d1_nm)), powers(Cells(d2_nm=d2_nm)))
    return max(distance(each, thin[i]) for powers in thicker for i, each in enumerate(powers))


def absentee(subject: str) -> float:
    half_wave_nm = WAVELENGTHS_NM / (2.0 * N2 * _cosine(N2))
    R_s, R_p, *_ = CELL_SUBJECTS[subject](Cells(d2_nm=half_wave_nm))
    bare = film_reflectance(HOST, N1, N1, 0.0, WAVELENGTHS_NM, _cosine(HOST))
    return distance(0.5 * (R_s + R_p), bare)


def one_cell(subject: str) -> float:
    worst = 0.0
    for n2 in (N2, LOSSY):
        powers = CELL_SUBJECTS[subject](Cells(N1, N1, n2, cells=1))
        slab = film_power(N1, n2, N1, D2_NM, WAVELENGTHS_NM, _cosine(N1))
        pairs = zip(powers[:4], (slab.R_s, slab.R_p, slab.T_s, slab.T_p), strict=True)
        worst = max(worst, *(distance(ours, theirs) for ours, theirs in pairs))
    return worst


def backwards(subject: str) -> float:
    """As much comes through the same films written out in reverse, through cells that absorb too."""
    worst = 0.0
    for n2 in (N2, LOSSY):
        _, _, T_s, T_p, _, _ = CELL_SUBJECTS[subject](Cells(n2=n2))
        up = stack([N1, *[n2, N1] * CELLS, HOST], [D2_NM, D1_NM] * CELLS, WAVELENGTHS_NM, _cosine(N1))
        worst = max(worst, distance(T_s, up.T_s), distance(T_p, up.T_p))
    return worst


def nothing_is_lost(subject: str) -> float:
    mirrors = (Cells(), Cells(n2=LOSSY), Cells(host_ior=1.7), Cells(host_ior=1.7, n2=LOSSY))
    powers = (CELL_SUBJECTS[subject](mirror) for mirror in mirrors)
    return max(distance(np.array(each[i::2]).sum(axis=0), 1.0) for each in powers for i in (0, 1))


def passive(subject: str) -> float:
    mirrors = (Cells(), Cells(n2=LOSSY), Cells(host_ior=1.7), Cells(n2=30.0, cells=200))
    shares = (share for mirror in mirrors for share in CELL_SUBJECTS[subject](mirror))
    return max(float(np.maximum(-share, share - 1.0).max()) for share in shares)


CELL_LAWS = {
    "full order": Law("Films thicker by λ/(2n cos θ) reflect, pass and absorb the same.", full_order, 1e-12),
    "absentee": Law("Cells whose second film is half a wave are not there.", absentee, 1e-12),
    "one cell": Law("One cell is the slab n2 in n1.", one_cell, 1e-13),
    "backwards": Law("As much comes through from either side, also where cells absorb.", backwards, 1e-12),
    "R + T + A = 1": Law("What is reflected, passed and absorbed is all.", nothing_is_lost, 1e-12),
    "0 ≤ R, T, A ≤ 1": Law("Each of them is within 0 and 1.", passive, 1e-14),
}
