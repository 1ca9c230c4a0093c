"""A mirror's spectrum as boxes between landmarks, which `landmarks` and `landmarks-sub` sum.

Fourneau et al. 2024, §3.2.2 and Appendix B: inside band gaps everything is reflected, in a box between two
landmarks w̃ R^e at its middle, s and p apart. As read here: bands count from m = 0 below the first gap; a box
that the visible range cuts keeps its middle; θ of w̃ is the angle in n1. The number of cells does not enter:
the envelope is that of many.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.bragg_cell import cell_optics
from gltf_iri.optics.envelope_weight import envelope_weight, normal_r_squared
from gltf_iri.optics.landmarks import MODES_MAX, RootFinder, band, envelope_transmittance, zero_point

__all__ = ["Boxes", "Lanes", "lanes_of", "lossless_cells", "spectral_boxes"]

Float64 = NDArray[np.float64]

_SHORTEST_NM, _LONGEST_NM = WAVELENGTH_RANGE_NM
_MIRRORS_AT_ONCE: Final = 2048  # keeps temporaries inside a core's cache
_LEAST_PATH_NM: Final = 1e-12  # stands for a cell without thickness: its first band then fills the spectrum


@dataclass(frozen=True, slots=True)
class Lanes:
    """What boxes need of mirrors: a lane for s of each, then one for p of each; every field is (2n,).

    path_nm : q₁d₁ + q₂d₂. lean : ρ. r_squared : r₁₂². weight : w̃. host_r, host_t : reflectance and
    transmittance from the host into n1. runs : whether light runs in both films; the rest is finite always.
    """

    path_nm: Float64
    lean: Float64
    r_squared: Float64
    weight: Float64
    host_r: Float64
    host_t: Float64
    runs: NDArray[np.bool_]

    def part(self, start: int, stop: int) -> Lanes:
        """Return the lanes from `start` to before `stop`."""
        return Lanes(*(getattr(self, each.name)[start:stop] for each in fields(self)))


@dataclass(frozen=True, slots=True)
class Boxes:
    """Boxes of the bands, each (b,): their lane, ends in t, and 1 − w_j; what no box covers lies in a gap.

    mode, stride : the band's, which stands for the `stride` bands from `mode` on.
    """

    lane: NDArray[np.intp]
    mode: Float64
    stride: Float64
    low: Float64
    high: Float64
    transmittance: Float64

    def stretched(self, t: Float64) -> Float64:
        """Return where t of the band lies in the bands that it stands for."""
        return np.asarray(self.mode + self.stride * (t - self.mode))


def lanes_of(mirror: Mirror) -> Lanes:
    """Return the lanes of `mirror`; raises UsageError for cells that absorb."""
    _check_lossless(mirror)
    n1, n2, cos_h = mirror.n1.real, mirror.n2.real, mirror.cos_theta_h
    cell = cell_optics(mirror.host_ior, n1, n2, mirror.d1_nm, mirror.d2_nm, cos_h)
    runs = ~np.isnan(cell.path_1_nm + cell.path_2_nm)
    ratio = mirror.host_ior / n1
    cos_1 = np.sqrt(np.maximum(1.0 - ratio * ratio * ((1.0 - cos_h) * (1.0 + cos_h)), 0.0))
    path = np.maximum(cell.path_1_nm + cell.path_2_nm, _LEAST_PATH_NM)

    def lanes(s: Float64, p: Float64) -> Float64:
        both = [np.broadcast_to(np.where(runs, each, 0.0), mirror.shape) for each in (s, p)]
        return np.stack(both).reshape(-1)

    lean = (cell.path_1_nm - cell.path_2_nm) / path
    # Without one of its films a cell has no interface; also towards grazing light, where r₁₂² nears 1.
    has_both = (cell.path_1_nm > 0.0) & (cell.path_2_nm > 0.0)
    r_s = np.where(has_both, _r_squared(cell.contrast_s, cell.imbalance_s), 0.0)
    r_p = np.where(has_both, _r_squared(cell.contrast_p, cell.imbalance_p), 0.0)
    weight = envelope_weight(normal_r_squared(n1, n2), cos_1)
    return Lanes(
        np.maximum(lanes(path, path), _LEAST_PATH_NM),
        lanes(lean, lean),
        lanes(r_s, r_p),
        lanes(weight, weight),
        lanes(cell.host_r_s**2, cell.host_r_p**2),
        lanes(cell.host_t_s, cell.host_t_p),
        np.tile(np.broadcast_to(runs, mirror.shape).reshape(-1), 2),
    )


def lossless_cells(mirror: Mirror) -> Iterator[tuple[slice, Float64]]:
    """Yield which mirrors come next, and their cells (14, ≥ as many): `Cell`, then host, n1, n2 and cos θ_h.

    One array, filled anew each time. Raises UsageError for cells that absorb.
    """
    _check_lossless(mirror)
    flat = [
        np.broadcast_to(np.real(each), mirror.shape).reshape(-1)
        for each in (mirror.host_ior, mirror.n1, mirror.n2, mirror.d1_nm, mirror.d2_nm, mirror.cos_theta_h)
    ]
    count = len(flat[0])
    cells = np.zeros((14, min(count, _MIRRORS_AT_ONCE)))
    for start in range(0, count, _MIRRORS_AT_ONCE):
        part = slice(start, min(start + _MIRRORS_AT_ONCE, count))
        host, n1, n2, d1_nm, d2_nm, cos_h = (each[part] for each in flat)
        cell = cell_optics(host, n1, n2, d1_nm, d2_nm, cos_h)
        values = (*(getattr(cell, each.name) for each in fields(cell)), host, n1, n2, cos_h)
        for row, value in zip(cells, values, strict=True):
            row[: part.stop - start] = value
        yield part, cells


def _check_lossless(mirror: Mirror) -> None:
    if not mirror.is_lossless:
        raise UsageError("Landmarks are defined for lossless cells only: leave k out, or take yeh-spectral.")


def spectral_boxes(lanes: Lanes, subdivisions: int, root_finder: RootFinder) -> Boxes:
    """Return every box that overlaps 360–830 nm."""
    t_low, t_high = 2.0 * lanes.path_nm / _LONGEST_NM, 2.0 * lanes.path_nm / _SHORTEST_NM
    first, last = np.floor(t_low), np.floor(t_high)
    strides = 1.0 + np.floor((last - first) / MODES_MAX)
    counts = np.where(lanes.runs, 1.0 + np.floor((last - first) / strides), 0.0).astype(np.intp)
    lane = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(lane)) - np.repeat(np.cumsum(counts) - counts, counts)
    mode = first[lane] + strides[lane] * place
    lean = lanes.lean[lane]
    found = band(mode, lean, lanes.r_squared[lane], root_finder)
    zero = zero_point(found, lean)
    inner = np.minimum(found.airy, zero), np.maximum(found.airy, zero)
    parts = np.maximum(1.0, subdivisions - mode)
    chosen, lows, highs = [], [], []
    for low, high in ((found.start, inner[0]), inner, (inner[1], found.end)):
        for part in range(subdivisions):
            sub_low = low + (high - low) * (part / parts)
            sub_high = low + (high - low) * ((part + 1) / parts)
            stride = strides[lane]
            is_seen = mode + stride * (sub_high - mode) > t_low[lane]
            is_seen &= mode + stride * (sub_low - mode) < t_high[lane]
            those = np.nonzero(is_seen & (part < parts) & (sub_low < sub_high))[0]
            chosen.append(those)
            lows.append(sub_low[those])
            highs.append(sub_high[those])
    pick = np.concatenate(chosen)
    low, high, lane = np.concatenate(lows), np.concatenate(highs), lane[pick]
    envelope = envelope_transmittance(0.5 * (low + high), lanes.lean[lane], lanes.r_squared[lane])
    transmittance = 1.0 - lanes.weight[lane] * (1.0 - envelope)
    transmittance = _under_host(transmittance, lanes.host_r[lane], lanes.host_t[lane])
    return Boxes(lane, mode[pick], strides[lane], low, high, transmittance)


def _r_squared(contrast: Float64, imbalance: Float64) -> Float64:
    """Return r₁₂² = ((X − 1)/(X + 1))² from X and ½(X − 1/X), which does not cancel at n1 ≈ n2."""
    r = 2.0 * (contrast / (1.0 + contrast)) * (imbalance / (1.0 + contrast))
    return np.asarray(np.minimum(r * r, 1.0))


def _under_host(transmittance: Float64, host_r: Float64, host_t: Float64) -> Float64:
    """Return (1 − F) T/(1 − F + F T), the mean over phase of an interface F before a lossless mirror T."""
    total = host_t + host_r * transmittance
    return np.asarray(host_t * transmittance / np.where(total > 0.0, total, 1.0))
