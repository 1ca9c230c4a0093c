"""Method `yeh-spectral`, the truth for mirrors: the exact reflectance integrated until it has converged.

Both polarisations are averaged. Cells may absorb and reflect totally inside, under any host.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["MirrorRows", "evaluate_yeh_spectral", "mirror_spectrum"]

Float64 = NDArray[np.float64]

_FADED: Final = 25.0  # e^−25 of an amplitude is 1e-11
_FADING_MIN_NM: Final = 1e-6  # less leaves fringes of 10⁶ cells to be seen


def evaluate_yeh_spectral(mirror: Mirror, white: White) -> Evaluation:
    """Evaluate the truth under `white`; raises UsageError where a spectrum is too fine to be integrated.

    Colours move by less than COLOUR_CONVERGENCE at 200 cells. Of 10⁶ cells float64 knows the reflectance to
    1e-8 only, and the colour to better than 1e-6; fringes so fine take a minute for each mirror.
    """
    rows = MirrorRows(mirror)
    rgb = integrate_colour(rows.reflectance, rows.count, white=white, opd_nm=rows.opd_nm())
    return Evaluation(rgb.reshape(*mirror.shape, 3), "yeh-spectral", str(white))


def mirror_spectrum(mirror: Mirror, wavelength_nm: Float64) -> Float64:
    """Return the reflectance (*mirror.shape, k) at `wavelength_nm` (k,), the mean of both polarisations."""
    rows = MirrorRows(mirror)
    wavelength_nm = np.asarray(wavelength_nm, dtype=np.float64)
    return rows.reflectance(np.arange(rows.count), wavelength_nm).reshape(*mirror.shape, len(wavelength_nm))


class MirrorRows:
    """A mirror whose broadcast shape is laid out as rows."""

    def __init__(self, mirror: Mirror) -> None:
        self.count = int(np.prod(mirror.shape, dtype=np.intp))
        lossless = mirror.is_lossless
        self._columns = [
            np.broadcast_to(a, mirror.shape).reshape(-1, 1)
            for a in (
                mirror.host_ior,
                mirror.n1.real if lossless else mirror.n1,
                mirror.n2.real if lossless else mirror.n2,
                mirror.d1_nm,
                mirror.d2_nm,
                mirror.cells,
                mirror.cos_theta_h,
            )
        ]

    def opd_nm(self) -> Float64:
        """Return (count,): an upper bound of the path difference of the fringes that there are to see."""
        host, n1, n2, d1_nm, d2_nm, cells, cosine = self._columns
        fading_1, fading_2 = (
            normal_index(normal_index_squared(n, host, cosine)).imag if n.imag.any() else np.zeros((1, 1))
            for n in (n1, n2)
        )
        # Light that has crossed so many cells twice is next to nothing: those behind show no fringes.
        fading_nm = np.maximum(fading_1 * d1_nm + fading_2 * d2_nm, _FADING_MIN_NM)
        seen = np.minimum(cells, np.ceil(_FADED * WAVELENGTH_RANGE_NM[1] / (4.0 * np.pi * fading_nm)))
        return np.asarray((2.0 * seen * (n1.real * d1_nm + n2.real * d2_nm))[:, 0])

    def reflectance(self, rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
        """Return (r, k) at `wavelength_nm` (k,) or (r, k)."""
        host, n1, n2, d1_nm, d2_nm, cells, cosine = (each[rows] for each in self._columns)
        return bragg_reflectance(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine)
