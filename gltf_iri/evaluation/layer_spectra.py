"""Spectra of one rough layer: what its facets reflect, and what of light passes between and through them."""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.evaluation.layers import BraggLayer
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.filter_panels import FilterPanels

__all__ = ["LayerSpectra", "fringes_of", "panels_for"]

Float64 = NDArray[np.float64]

# Panels of 16 angles: for the filter alone, for each fringe between straight on and grazing, and at most.
# Measured at single wavelengths against twice as many panels: 1e-13 at five fringes (five cells of 240 nm in
# air), 2e-9 at twenty (ten of 500 nm); with the most, 5e-11 at forty (ten of 988 nm) or 3e-8 (twenty of
# 500 nm), and 4e-5 at a hundred (fifty of 500 nm), whose resonances are narrower than angles can lie.
_PANELS_OF_FILTER: Final = 8
_PANELS_A_FRINGE: Final = 12.0
_PANELS_MAX: Final = 1024

_VALUES_AT_ONCE: Final = 1 << 21  # bounds memory: angles × wavelengths, and cosines × angles


def fringes_of(layer: BraggLayer, host_ior: float) -> float:
    """Return how many fringes pass between straight on and grazing, at the shortest wavelength.

    As many as the path through all cells and back, 2N Σ qd, changes by wavelengths, where q = √(n² − n_h²).
    """
    change_nm = 0.0
    for n, d_nm in ((layer.n1, layer.d1_nm), (layer.n2, layer.d2_nm)):
        change_nm += float((d_nm * (n - np.sqrt(np.maximum(n * n - host_ior**2, 0.0)))).item())
    return 2.0 * float(layer.cells.item()) * change_nm / WAVELENGTH_RANGE_NM[0]


def panels_for(layer: BraggLayer, host_ior: float) -> int:
    """Return how many panels of θ_d the fringes of one `layer` need."""
    wanted = _PANELS_OF_FILTER + _PANELS_A_FRINGE * fringes_of(layer, host_ior)
    # Of the same few numbers, so that layers share the angles.
    return int(min(2.0 ** (np.ceil(4.0 * np.log2(wanted)) / 4.0), _PANELS_MAX))


class LayerSpectra:
    """One layer of numbers, in a host of index `host_ior`; cosines are those in the host."""

    def __init__(self, layer: BraggLayer, host_ior: float) -> None:
        self._layer, self._host_ior = layer, host_ior
        self._cell = tuple(float(a.item()) for a in (layer.n1, layer.n2, layer.d1_nm, layer.d2_nm))
        self.cells, self.alpha = int(layer.cells.item()), float(layer.alpha.item())

    @property
    def opd_nm(self) -> float:
        """An upper bound of the path difference of the fringes, all cells and back."""
        n1, n2, d1_nm, d2_nm = self._cell
        return 2.0 * self.cells * (n1 * d1_nm + n2 * d2_nm)

    def reflectance(self, cosine: Float64, wavelength_nm: Float64) -> Float64:
        """Return R (n, k) of the facets at `cosine` (n,), at `wavelength_nm` (k,) or (n, k)."""
        n1, n2, d1_nm, d2_nm = self._cell
        return bragg_reflectance(
            self._host_ior, n1, n2, d1_nm, d2_nm, self.cells, wavelength_nm, cosine[:, None]
        )

    def transmissivity(self, cosine: Float64, wavelength_nm: Float64) -> Float64:
        """Return T (n, k) = ∫ (1 − R) F_α dθ_d at `cosine` (n,) and `wavelength_nm` (k,); Eq. 28."""
        if self.alpha == 0.0:
            # All the weight of a smooth layer's filter lies at the angle of the light itself.
            return np.asarray(1.0 - self.reflectance(cosine, wavelength_nm))
        panels = _panels(panels_for(self._layer, self._host_ior))
        angles, count = len(panels.cosines), len(wavelength_nm)
        passed = np.zeros((len(cosine), count))
        rows, columns = max(1, _VALUES_AT_ONCE // angles), max(1, _VALUES_AT_ONCE // angles)
        for start in range(0, len(cosine), rows):
            part = slice(start, start + rows)
            weights = panels.weights(cosine[part], self.alpha)
            for first in range(0, count, columns):
                some = slice(first, first + columns)
                passed[part, some] = weights @ (1.0 - self.reflectance(panels.cosines, wavelength_nm[some]))
        return passed


@cache
def _panels(count: int) -> FilterPanels:
    return FilterPanels.of(count)
