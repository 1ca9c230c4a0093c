"""Layers of arrays, laid out as rows: materials × poses, each row with a layer and cosines of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.layer_passing import LayerPassing
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import BraggLayer
from gltf_iri.optics.bragg import bragg_reflectance

__all__ = ["FacetRows", "PassingRows"]

Float64 = NDArray[np.float64]
Rows = NDArray[np.intp]


class FacetRows:
    """What facets of one layer of a stack reflect; `cosine` (r,) is in the host, a row each."""

    def __init__(self, layer: BraggLayer, host_ior: Float64, shape: tuple[int, ...], cosine: Float64) -> None:
        self._cell = [_column(a, shape) for a in (host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm)]
        self._cells, self._cosine = _column(layer.cells, shape), cosine[:, None]
        _, n1, n2, d1_nm, d2_nm = self._cell
        self.opd_nm: Float64 = np.broadcast_to(
            (2.0 * self._cells * (n1 * d1_nm + n2 * d2_nm))[:, 0], cosine.shape
        )

    def reflectance(self, rows: Rows, wavelength_nm: Float64) -> Float64:
        """Return R (r, k) of those numbered `rows` at `wavelength_nm` (k,) or (r, k)."""
        host, n1, n2, d1_nm, d2_nm = (a if len(a) == 1 else a[rows] for a in self._cell)
        cells = self._cells if len(self._cells) == 1 else self._cells[rows]
        return bragg_reflectance(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, self._cosine[rows])


class PassingRows:
    """What one layer of a stack lets through, once for each of some cosines (r,) in the host: in, and out."""

    def __init__(
        self,
        layer: BraggLayer,
        host_ior: Float64,
        shape: tuple[int, ...],
        cosines: Sequence[Float64],
    ) -> None:
        self._cosines = tuple(cosines)
        fields = layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, layer.alpha, host_ior
        columns = [_column(np.asarray(a, np.float64), shape)[:, 0] for a in fields]
        table = np.stack(np.broadcast_arrays(*columns), axis=-1)
        kinds, which = np.unique(table, axis=0, return_inverse=True)
        self._which = np.broadcast_to(which.reshape(-1), cosines[0].shape)
        # Rows in the order of their layers: those of one layer lie between two of `starts`.
        order = np.argsort(self._which, kind="stable")
        self._place = np.zeros(len(order), dtype=np.intp)
        starts = np.searchsorted(self._which[order], np.arange(len(kinds) + 1))
        self._passing: list[LayerPassing] = []
        for number, kind in enumerate(kinds):
            mine = order[starts[number] : starts[number + 1]]
            self._place[mine] = np.arange(len(mine))
            n1, n2, d1_nm, d2_nm, cells, alpha, host = (float(value) for value in kind)
            spectra = LayerSpectra(BraggLayer.of(n1, n2, d1_nm, d2_nm, cells, alpha), host)
            self._passing.append(LayerPassing(spectra, np.concatenate([c[mine] for c in cosines])))
        self._sizes = np.diff(starts)

    def is_of(self, cosines: Sequence[Float64]) -> bool:
        """True where these are the cosines that the rows were made for."""
        return all(np.array_equal(a, b) for a, b in zip(cosines, self._cosines, strict=True))

    def ways(self, rows: Rows, wavelength_nm: Float64) -> Float64:
        """Return T (cosines, r, k) of those numbered `rows` at `wavelength_nm` (k,)."""
        ways = np.zeros((len(self._cosines), len(rows), wavelength_nm.shape[-1]))
        which = self._which[rows]
        for number in np.unique(which):
            mine = np.flatnonzero(which == number)
            places = self._place[rows[mine]]
            for turn, way in enumerate(ways):
                first = turn * int(self._sizes[number])
                way[mine] = self._passing[number].transmissivity(places + first, wavelength_nm)
        return ways


def _column(values: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    return (values if values.size == 1 else np.broadcast_to(values, shape)).reshape(-1, 1)
