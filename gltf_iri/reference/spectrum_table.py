"""The spectra of a stack's layers as tables, fine enough to stand for the truth at a million directions.

Spectra are held as their means over some hundred bands of equal share of what the observer sees, which
multiply as spectra do (`colour/bands.py` has few such bands, for pictures). Between nodes of the cosine, and
of the period texture's value where periods vary, tables are cubic.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import choose_backend
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.spaces import White
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import filter_nodes
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer

__all__ = ["FineBands", "SpectrumTable", "blocks", "filtered", "fine_bands", "reflectance_tables"]

Float64 = NDArray[np.float64]
Float32 = NDArray[np.float32]

_STEPS: Final = 18800  # of 0.025 nm, between which the observer's share is linear
_FILTER_POINTS: Final = 96  # a panel; sharp resonances are averaged, not sampled
_ROWS_AT_ONCE: Final = 256  # nodes whose spectra are evaluated together
_POINTS_AT_ONCE: Final = 512  # keeps what is read of tables inside a core's cache


@dataclass(frozen=True, slots=True)
class FineBands:
    """Wavelengths (B·m,) of equal share of u = Σ|w|, `m` to a band; w is the density of linear Rec.709.

    sample_weights : (B·m, 3), weights : (B, 3) what each sample and each band counts for; columns sum to 1.
    """

    wavelength_nm: Float64
    sample_weights: Float64
    weights: Float64

    def means(self, spectra: Float64) -> Float64:
        """Return the bands' means (..., B) of spectra (..., B·m)."""
        return np.asarray(spectra.reshape(*spectra.shape[:-1], len(self.weights), -1).mean(axis=-1))


def fine_bands(bands: int, samples: int, white: White) -> FineBands:
    """Return `bands` bands of `samples` wavelengths each under `white`."""
    nm = np.linspace(*WAVELENGTH_RANGE_NM, _STEPS + 1)
    density = colour_density(0.5 * (nm[1:] + nm[:-1]), white)
    seen = np.concatenate([[0.0], np.cumsum(np.abs(density).sum(axis=-1))])
    colour = np.concatenate([np.zeros((1, 3)), np.cumsum(density, axis=0)])
    ends = np.linspace(0.0, seen[-1], bands * samples + 1)
    at_ends = np.stack([np.interp(ends, seen, each) for each in (colour / colour[-1]).T], axis=-1)
    weights = np.diff(at_ends, axis=0)
    wavelength_nm = np.interp(0.5 * (ends[1:] + ends[:-1]), seen, nm)
    return FineBands(wavelength_nm, weights, weights.reshape(bands, samples, 3).sum(axis=1))


@dataclass(frozen=True, slots=True)
class SpectrumTable:
    """`values` (P, C, B) over P even texture shares and C even cosines from 0 to 1; either may be 1."""

    values: Float64 | Float32

    def at(self, share: Float64, cosine: Float64) -> Float64:
        """Return (n, B) at `share` (n,) and `cosine` (n,), both in [0, 1]."""
        periods, cosines, bands = self.values.shape
        rows, weights = np.zeros((len(cosine), 1), np.int64), np.ones((len(cosine), 1))
        if cosines > 1:
            rows, weights = _cubic(cosine, cosines)
        if periods > 1:
            places, shares = _cubic(share, periods)
            rows = (places[:, :, None] * cosines + rows[:, None, :]).reshape(len(cosine), -1)
            weights = (shares[:, :, None] * weights[:, None, :]).reshape(len(cosine), -1)
        flat = self.values.reshape(-1, bands)
        found = np.zeros((len(cosine), bands))
        for place in range(rows.shape[1]):
            found += weights[:, place, None] * flat[rows[:, place]]
        return found


def reflectance_tables(
    plan: LayersPlan, layer: PlannedLayer, bands: FineBands, periods: int, cosines: int
) -> tuple[SpectrumTable, SpectrumTable]:
    """Return the facets' reflectance as colours (periods, cosines, 3) and as bands (periods, cosines, B)."""
    cosine = np.linspace(0.0, 1.0, cosines)
    period_nm = np.linspace(*layer.period_nm, periods) if periods > 1 else np.array(layer.period_nm[:1])
    backend = choose_backend(
        "auto", periods * cosines * len(bands.wavelength_nm), ("numpy", "numba"), plan.method
    )
    colours = np.zeros((periods, cosines, 3))
    means = np.zeros((periods, cosines, len(bands.weights)), np.float32)
    for place, nm in enumerate(period_nm):
        d1_nm, d2_nm = layer.fill * nm, (1.0 - layer.fill) * nm
        for start in range(0, cosines, _ROWS_AT_ONCE):
            rows = slice(start, start + _ROWS_AT_ONCE)
            spectra = bragg_reflectance(
                plan.host_ior,
                layer.n1,
                layer.n2,
                d1_nm,
                d2_nm,
                layer.cells,
                bands.wavelength_nm,
                cosine[rows, None],
                backend=backend,
            )
            colours[place, rows] = spectra @ bands.sample_weights
            means[place, rows] = bands.means(spectra)
    return SpectrumTable(colours), SpectrumTable(means)


def filtered(reflected: SpectrumTable, alpha: float, cosines: int) -> SpectrumTable:
    """Return T = ∫ (1 − R) F_α dθ_d (periods, cosines, B), Fourneau et al. 2024, Eq. 28, of facets' R."""
    met, weights = filter_nodes(np.linspace(0.0, 1.0, cosines), alpha, count=_FILTER_POINTS)
    return _averaged(SpectrumTable(1.0 - reflected.values), met, weights)


def _averaged(table: SpectrumTable, met: Float64, weights: Float64) -> SpectrumTable:
    """Return Σ weights · table(cosine met) over the last axis of both, (C, k): (P, C, B)."""
    periods, nodes, bands = table.values.shape
    rows, shares = _cubic(met.ravel(), nodes)
    # What each of the table's nodes counts for: the rule's weights, spread by the interpolation's.
    counts = np.zeros((len(met), nodes))
    spread = weights.ravel()[:, None] * shares
    np.add.at(counts, (np.repeat(np.arange(len(met)), met.shape[1])[:, None], rows), spread)
    sums = np.zeros((periods, len(met), bands), table.values.dtype)
    for place in range(periods):
        sums[place] = counts @ table.values[place]
    return SpectrumTable(sums)


def blocks(count: int) -> list[slice]:
    """Return slices that cover `count` points, each small enough for a core's cache."""
    return [slice(start, start + _POINTS_AT_ONCE) for start in range(0, count, _POINTS_AT_ONCE)]


def _cubic(value: Float64, nodes: int) -> tuple[NDArray[np.int64], Float64]:
    """Return the four nodes around each `value` in [0, 1] and Lagrange's weights, (n, 4) each."""
    place = value * (nodes - 1)
    first = np.clip(place.astype(np.int64) - 1, 0, nodes - 4)
    u = place - first
    a, b, c, d = u, u - 1.0, u - 2.0, u - 3.0
    weights = np.stack([-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0], axis=-1)
    return first[:, None] + np.arange(4), weights
