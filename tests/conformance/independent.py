"""The model once more, from matrices, sums over facets' normals and tables: nothing of the package's."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from mpmath import mp
from numpy.typing import NDArray

Float64 = NDArray[np.float64]

DATA = Path(__file__).resolve().parents[2] / "gltf_iri" / "colour" / "data"

TO_RGB = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.969266, 1.8760108, 0.041556],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def matrix_reflectance(
    indices: list[Any], thicknesses_nm: list[Any], wavelength_nm: Any, cosine: Any, digits: int = 50
) -> Any:
    """Mean of R_s and R_p of a stack between indices[0] and indices[-1], by amplitude matrices in mpmath.

    Each interface is (1/t)((1, r), (r, 1)), each layer diag(e^{−iφ}, e^{iφ}); r = −M₁₀/M₀₀ but for its sign.
    """
    with mp.workdps(digits):
        n = [mp.mpf(each) for each in indices]
        sine = n[0] * mp.sqrt(1 - mp.mpf(cosine) ** 2)
        q = [n[0] * mp.mpf(cosine), *(mp.sqrt(mp.mpc((k - sine) * (k + sine))) for k in n[1:])]
        shares = []
        for admittance in (q, [b / a**2 for a, b in zip(n, q, strict=True)]):
            m = mp.matrix([[1, 0], [0, 1]])
            for k in range(len(n) - 1):
                y1, y2 = admittance[k], admittance[k + 1]
                m *= mp.matrix([[y1 + y2, y1 - y2], [y1 - y2, y1 + y2]]) / (2 * y1)
                if k < len(n) - 2:
                    phase = 2 * mp.pi * q[k + 1] * mp.mpf(thicknesses_nm[k]) / mp.mpf(wavelength_nm)
                    m *= mp.matrix([[mp.exp(-1j * phase), 0], [0, mp.exp(1j * phase)]])
            shares.append(abs(m[1, 0] / m[0, 0]) ** 2)
        return (shares[0] + shares[1]) / 2


def cell_reflectance(facets: Any, wavelength_nm: Any, cosine: Any) -> Any:
    """The same of a row's facets: cells of n1 and n2 in a host, n1 behind the last."""
    indices = [facets.host_ior, *([facets.n1, facets.n2] * facets.cells), facets.n1]
    films = [facets.d1_nm, facets.d2_nm] * facets.cells
    return matrix_reflectance(indices, films, wavelength_nm, cosine)


def fast_reflectance(facets: Any, wavelength_nm: Float64, cosine: Float64) -> Float64:
    """The same in float64 over broadcast arrays, by powers of the cell's characteristic matrix."""
    host, n1, n2 = facets.host_ior, facets.n1, facets.n2
    wavelength_nm, cosine = np.broadcast_arrays(wavelength_nm, cosine)
    sine_squared = host * host * (1.0 - cosine * cosine)
    q = [np.sqrt(n * n - sine_squared + 0j) for n in (n1, n2)]
    mean = np.zeros(wavelength_nm.shape)
    for scale in ((1.0, 1.0, 1.0), (host * host, n1 * n1, n2 * n2)):
        y0, y1, y2 = host * cosine / scale[0], q[0] / scale[1], q[1] / scale[2]
        cell = np.broadcast_to(np.eye(2, dtype=complex), (*wavelength_nm.shape, 2, 2))
        for y, qn, d in ((y1, q[0], facets.d1_nm), (y2, q[1], facets.d2_nm)):
            phase = 2.0 * np.pi * qn * d / wavelength_nm
            layer = np.stack(
                [np.cos(phase), -1j * np.sin(phase) / y, -1j * y * np.sin(phase), np.cos(phase)], -1
            )
            cell = cell @ layer.reshape(*phase.shape, 2, 2)
        whole = np.linalg.matrix_power(cell, facets.cells)
        front, back = whole[..., 0, 0] + whole[..., 0, 1] * y1, whole[..., 1, 0] + whole[..., 1, 1] * y1
        mean += 0.5 * np.abs((y0 * front - back) / (y0 * front + back)) ** 2
    return mean


def facet_transmittance(facets: Any, wavelength_nm: Float64, cosine: float, points: int) -> Float64:
    """T = G₁² ∫ D(m) max(i·m, 0)/cosθ_i (1 − R(i·m)) dm over facets' normals m; Fourneau et al. 2024, §4.2.

    tanθ_m = α tan v takes the lobe's width out; turns end where facets turn their back on the light.
    """
    nodes, gauss = np.polynomial.legendre.leggauss(points)
    inside, share = 0.5 + 0.5 * nodes, 0.5 * gauss
    a, sine = facets.alpha, np.sqrt(1.0 - cosine * cosine)
    g1 = 2.0 * cosine / (cosine + np.sqrt(a * a + (1.0 - a * a) * cosine * cosine))
    # Beyond that tilt some facets turn their back on the light.
    cut = np.arctan(cosine / sine / a) if sine > 0.0 else 0.5 * np.pi
    total = np.zeros(len(wavelength_nm))
    for low, high in ((0.0, cut), (cut, 0.5 * np.pi)):
        # v as sin² at both ends takes square roots out.
        v = low + (high - low) * np.sin(0.5 * np.pi * inside) ** 2
        dv = (high - low) * 0.5 * np.pi * np.sin(np.pi * inside) * share
        tilt = np.arctan(a * np.tan(v))
        cos_m, sin_m = np.cos(tilt), np.sin(tilt)
        # D sinθ dθ = (1/π) cos v sin v/cos⁴θ_m cos³θ_m … dv, with tanθ_m = α tan v
        weight = 2.0 * np.sin(v) * np.cos(v) / cos_m * dv
        reach = np.arccos(np.clip(-cosine * cos_m / np.maximum(sine * sin_m, 1e-300), -1.0, 1.0))
        turn = reach[:, None] * inside
        met = np.maximum(cosine * cos_m[:, None] + sine * sin_m[:, None] * np.cos(turn), 1e-12)
        area = weight[:, None] * (reach[:, None] * share) / np.pi * met / cosine
        for k, nm in enumerate(wavelength_nm):
            total[k] += np.sum(
                area * (1.0 - fast_reflectance(facets, np.full(met.shape, nm), np.minimum(met, 1.0)))
            )
    return g1 * g1 * total


def colour_of(spectrum: Any, points: int = 5) -> Float64:
    """Colour of spectrum(λ) by Gauss points in each nanometre, where the tables are straight lines."""
    nodes, gauss = np.polynomial.legendre.leggauss(points)
    nm = (360.0 + np.arange(470)[:, None] + 0.5 + 0.5 * nodes).reshape(-1)
    step = np.tile(0.5 * gauss, 470)
    observer = np.loadtxt(DATA / "cie1931_2deg_1nm.csv", delimiter=",", skiprows=1)
    d65 = np.loadtxt(DATA / "d65_5nm.csv", delimiter=",", skiprows=1)
    light = np.interp(nm, d65[:, 0], d65[:, 1]) * step
    curves = np.stack([np.interp(nm, observer[:, 0], observer[:, k]) for k in (1, 2, 3)], axis=-1)
    rgb = (curves * light[:, None]) @ TO_RGB.T
    return np.asarray(spectrum(nm) @ rgb / rgb.sum(axis=0))
