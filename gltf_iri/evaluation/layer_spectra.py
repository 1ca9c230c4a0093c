"""Spectra of one rough layer: what its facets reflect, and what of light passes between and through them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.evaluation.layers import BraggLayer
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import filter_nodes

__all__ = ["FILTER_POINTS_MAX", "LayerRows", "filter_points"]

Float64 = NDArray[np.float64]

# Gauss points on each of the filter's panels: for the filter alone, for each fringe that light sees between
# straight on and grazing, and at most. 1e-9 of a colour up to some eight fringes; with twenty (ten cells of
# 500 nm in air) and more, resonances beside the band gaps are narrower than the points lie, and colours of
# two layers keep 1e-5.
_POINTS_OF_FILTER: Final = 32
_POINTS_A_FRINGE: Final = 40.0
FILTER_POINTS_MAX: Final = 384

_VALUES_AT_ONCE: Final = 1 << 20  # bounds memory: rows × nodes × wavelengths of one evaluation


def filter_points(layer: BraggLayer, host_ior: ArrayLike) -> int:
    """Return how many Gauss points a panel of the filter needs for the fringes of `layer`, the worst of all.

    Fringes pass as often as the path through all cells and back, 2N Σ qd, changes by a wavelength between
    straight on and grazing, where q = √(n² − n_h²).
    """
    host = np.asarray(host_ior, np.float64)
    change_nm = sum(
        d * (n - np.sqrt(np.maximum(n * n - host * host, 0.0)))
        for n, d in ((layer.n1, layer.d1_nm), (layer.n2, layer.d2_nm))
    )
    fringes = float(np.max(2.0 * layer.cells * change_nm / WAVELENGTH_RANGE_NM[0], initial=0.0))
    return min(_POINTS_OF_FILTER + int(_POINTS_A_FRINGE * fringes), FILTER_POINTS_MAX)


@dataclass(frozen=True, slots=True)
class LayerRows:
    """A layer in its host, its fields laid out as rows: (r, 1) each, or (1, 1) for all rows."""

    host_ior: Float64
    n1: Float64
    n2: Float64
    d1_nm: Float64
    d2_nm: Float64
    cells: NDArray[np.int64]
    alpha: Float64
    points: int

    @classmethod
    def of(cls, layer: BraggLayer, host_ior: Float64, shape: tuple[int, ...]) -> LayerRows:
        """Lay out `layer` as rows of the broadcast `shape`."""

        def column(values: NDArray[Any]) -> NDArray[Any]:
            return (values if values.size == 1 else np.broadcast_to(values, shape)).reshape(-1, 1)

        return cls(
            column(host_ior),
            column(layer.n1),
            column(layer.n2),
            column(layer.d1_nm),
            column(layer.d2_nm),
            column(layer.cells),
            column(layer.alpha),
            filter_points(layer, host_ior),
        )

    def opd_nm(self) -> Float64:
        """Return (r,) or (1,): an upper bound of the path difference of the fringes, all cells and back."""
        return (2.0 * self.cells * (self.n1 * self.d1_nm + self.n2 * self.d2_nm))[:, 0]

    def reflectance(self, rows: NDArray[np.intp], cosine: Float64, wavelength_nm: Float64) -> Float64:
        """Return R (r, k) of the facets at `cosine` (r,) in the host, at `wavelength_nm` (k,) or (r, k)."""
        host, n1, n2, d1_nm, d2_nm, cells = (
            column if len(column) == 1 else column[rows]
            for column in (self.host_ior, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells)
        )
        return bragg_reflectance(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine[:, None])

    def transmissivity(self, rows: NDArray[np.intp], cosine: Float64, wavelength_nm: Float64) -> Float64:
        """Return T (r, k) = ∫ (1 − R) F_α dθ_d, Fourneau et al. 2024, Eq. 28; arguments as `reflectance`."""
        passed = np.zeros((len(cosine), wavelength_nm.shape[-1]))
        rough = np.broadcast_to(self.alpha, (max(len(self.alpha), 1), 1))[:, 0]
        alpha = np.broadcast_to(rough, cosine.shape) if len(rough) == 1 else rough[rows]
        smooth = np.flatnonzero(alpha == 0.0)
        # All the weight of a smooth layer's filter lies at the angle of the light itself.
        passed[smooth] = 1.0 - self.reflectance(rows[smooth], cosine[smooth], _of(wavelength_nm, smooth))
        others = np.flatnonzero(alpha > 0.0)
        step = max(1, _VALUES_AT_ONCE // (3 * self.points * wavelength_nm.shape[-1]))
        for start in range(0, len(others), step):
            part = others[start : start + step]
            passed[part] = self._filtered(rows[part], cosine[part], alpha[part], _of(wavelength_nm, part))
        return passed

    def _filtered(
        self, rows: NDArray[np.intp], cosine: Float64, alpha: Float64, wavelength_nm: Float64
    ) -> Float64:
        nodes, weights = filter_nodes(cosine, alpha, count=self.points)
        count = nodes.shape[-1]
        spread = np.repeat(rows, count)
        if wavelength_nm.ndim == 2:
            wavelength_nm = np.repeat(wavelength_nm, count, axis=0)
        reflected = self.reflectance(spread, nodes.reshape(-1), wavelength_nm)
        passed = (1.0 - reflected).reshape(len(rows), count, -1)
        return np.asarray(np.matmul(weights[:, None, :], passed)[:, 0])


def _of(wavelength_nm: Float64, rows: NDArray[np.intp]) -> Float64:
    return wavelength_nm if wavelength_nm.ndim == 1 else wavelength_nm[rows]
