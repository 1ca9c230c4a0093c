"""The eye's sensitivities in Fourier space, tabulated for any light and RGB space.

Ŝ(D) = ∫ S(ν) exp(2πi D ν) dν, where S is the density of colour over wavenumber ν = 1/λ, with ∫ S dν = 1 in
each channel, and D an optical path difference (Belcour & Barla 2017, Eq. 7–10; their texture of real and
imaginary parts). Layout, which the compiled loops and GLSL share: cell k covers D from k·STEP_NM to
(k + 1)·STEP_NM, and there

    Ŝ(D) = c₀ + c₁t + c₂t² + c₃t³,   t = D/STEP_NM − k,   coefficients[k, part, power, channel]

with part 0 the real and 1 the imaginary part. Neighbouring cells meet: the cubic runs through both ends of
its cell and two Lobatto points between, which keeps Ŝ to TABLE_ERROR. Ŝ(−D) is the conjugate of Ŝ(D). Over
the last FADE_NM the table fades to 0, which it counts as from END_NM on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.gauss import gauss_panels
from gltf_iri.colour.observer import colour_matching, illuminant, observer_table
from gltf_iri.colour.spaces import White, rgb_matrix
from gltf_iri.errors import UsageError

__all__ = ["CELLS", "END_NM", "FADE_NM", "STEP_NM", "TABLE_ERROR", "Density", "SensitivityTable"]
__all__ += ["FlatTable", "flat_sensitivity_table", "rgb_density", "sensitivity_table", "tabulate_sensitivity"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]
Density = Callable[[Float64], Float64]  # wavelength_nm (...) → (..., 3)

STEP_NM: Final = 20.0
CELLS: Final = 3200
END_NM: Final = STEP_NM * CELLS  # 64 µm, where D65's |Ŝ| has fallen below 3e-4
FADE_NM: Final = 1000.0

# max |table − Ŝ| below END_NM − FADE_NM, under D65 and E in Rec.709.
TABLE_ERROR: Final = 4e-6

# Lobatto's points, ends included: their cubic errs least of those that meet at the cells' ends.
_POINTS: Final = np.array([0.0, 0.5 - 0.5 / np.sqrt(5.0), 0.5 + 0.5 / np.sqrt(5.0), 1.0])

# Gauss points per nanometre of the observer: at END_NM a panel at 360 nm spans 3.1 rad of the fringe.
_GAUSS_POINTS: Final = 6


@dataclass(frozen=True, slots=True)
class SensitivityTable:
    """Ŝ of three channels and a bound of it; arrays are read-only.

    coefficients : (CELLS, 2, 4, 3), see the module's layout.
    envelope : (CELLS + 1,), never rising, 0 at its end; read linearly between cells, it is at least |Ŝ(D′)|
    of every channel for all D′ ≥ D that the table holds.
    beyond : at least |Ŝ(D)| from END_NM − FADE_NM on, as far as 4 · END_NM: what the table's end leaves out.
    """

    coefficients: Float64
    envelope: Float64
    beyond: float

    def at(self, opd_nm: ArrayLike) -> Complex128:
        """Return Ŝ (..., 3) at path differences `opd_nm` (...) of either sign; NaN stays NaN."""
        opd = np.asarray(opd_nm, dtype=np.float64)
        cell, t = _place(np.abs(opd))
        c = self.coefficients[cell]
        t = t[..., None, None]
        parts = c[..., 0, :] + t * (c[..., 1, :] + t * (c[..., 2, :] + t * c[..., 3, :]))
        inside = np.abs(opd)[..., None] < END_NM
        real = np.where(inside | np.isnan(opd)[..., None], parts[..., 0, :], 0.0)
        imaginary = np.where(inside, parts[..., 1, :], 0.0)
        return np.asarray(real + 1j * np.where(opd < 0.0, -1.0, 1.0)[..., None] * imaginary)

    def reach_nm(self, epsilon: float) -> float:
        """Return D_max: |Ŝ(D)| ≤ `epsilon` in every channel for all D ≥ D_max, to one cell of the table.

        Belcour & Barla 2017, section 5: films with a longer path at normal incidence are as good as grey.
        END_NM where the table is too short to tell.
        """
        if epsilon < self.beyond:
            return END_NM
        above = np.flatnonzero(self.envelope[1:-1] > epsilon)
        return float(STEP_NM * (above[-1] + 1)) if len(above) else 0.0

    def bound(self, opd_nm: ArrayLike) -> Float64:
        """Return (...): at least |Ŝ| of every channel at and beyond `opd_nm` ≥ 0 within the table."""
        opd = np.asarray(opd_nm, dtype=np.float64)
        cell, t = _place(opd)
        low, high = self.envelope[cell], self.envelope[cell + 1]
        return np.asarray(np.where(opd < END_NM, low + t * (high - low), 0.0))


@cache
def sensitivity_table(white: White) -> SensitivityTable:
    """Return the table of the RGB space of `white`, made once."""
    return tabulate_sensitivity(rgb_density(lambda nm: illuminant(nm, white), rgb_matrix(white)))


class FlatTable(NamedTuple):
    """The table as compiled loops read it; a cell of zeros beyond the last answers for all that lies there.

    real, imaginary : 12 numbers a cell, by power, then channel.
    envelope : two numbers a cell, the bound at its start and how it changes in it.
    decay : no bound exceeds decay/place², with the place in cells.
    """

    real: Float64
    imaginary: Float64
    envelope: Float64
    decay: float


@cache
def flat_sensitivity_table(white: White) -> FlatTable:
    """Return the table of `sensitivity_table(white)`, laid flat once."""
    table = sensitivity_table(white)
    real, imaginary = (np.append(table.coefficients[:, part].reshape(-1), np.zeros(12)) for part in (0, 1))
    starts_and_changes = np.stack([table.envelope[:-1], np.diff(table.envelope)], axis=-1)
    envelope = np.append(starts_and_changes.reshape(-1), [0.0, 0.0])
    # A cell's bound is greatest at its start, its place at its end.
    decay = float((table.envelope[:-1] * np.arange(1, CELLS + 1) ** 2).max())
    for array in (real, imaginary, envelope):
        array.setflags(write=False)
    return FlatTable(real, imaginary, envelope, decay)


def rgb_density(power: Callable[[Float64], Float64], xyz_to_rgb: ArrayLike) -> Density:
    """Return the density over wavelength of an RGB space under the light of spectral power `power`.

    xyz_to_rgb : (3, 3), rows give R, G, B. The observer is CIE 1931, 2°.
    """
    matrix = np.asarray(xyz_to_rgb, dtype=np.float64)

    def density(wavelength_nm: Float64) -> Float64:
        return np.asarray((colour_matching(wavelength_nm) * power(wavelength_nm)[..., None]) @ matrix.T)

    return density


def tabulate_sensitivity(density: Density, *, opd_std_nm: float = 0.0) -> SensitivityTable:
    """Return the table of `density`, which must be smooth within each whole nanometre from 360 to 830.

    Each channel is divided by its integral; UsageError where that is not positive. Gauss points in every
    nanometre integrate Ŝ(D) to 1e-12 on the whole table.

    opd_std_nm : Ŝ averaged over a Gaussian spread of D of this width: S is multiplied by exp(−2π²σ²ν²).
    """
    wavelength_nm, weights = _panels(density)
    weights = weights * np.exp(-2.0 * (np.pi * opd_std_nm / wavelength_nm[:, None]) ** 2)
    nodes = _fourier(wavelength_nm, weights)  # (cells + 1, 3 points, 3 channels)
    values = np.concatenate([nodes[:-1], nodes[1:, :1]], axis=1)
    opd_nm = STEP_NM * (np.arange(CELLS)[:, None] + _POINTS)
    envelope, beyond = _envelope(np.abs(values).max(axis=(1, 2)), wavelength_nm, weights)
    left = np.clip((END_NM - opd_nm) / FADE_NM, 0.0, 1.0)
    values = values * (left * left * (3.0 - 2.0 * left))[..., None]
    powers = np.linalg.inv(_POINTS[:, None] ** np.arange(4))
    cubics = np.einsum("pn,knc->kpc", powers, values)
    coefficients = np.ascontiguousarray(np.stack([cubics.real, cubics.imag], axis=1))
    for array in (coefficients, envelope):
        array.setflags(write=False)
    return SensitivityTable(coefficients, envelope, beyond)


def _place(opd_nm: Float64) -> tuple[NDArray[np.intp], Float64]:
    scaled = opd_nm / STEP_NM
    # Keeps what lies beyond the table, and NaN, from asking for a cell that is not there.
    inside = np.where(scaled < CELLS, scaled, CELLS - 1.0)
    cell = inside.astype(np.intp)
    return cell, np.where(np.isnan(scaled), scaled, inside - cell)


def _panels(density: Density) -> tuple[Float64, Float64]:
    """Return wavelengths (p,) and the normalised density times quadrature weights (p, 3)."""
    wavelength_nm, gauss = gauss_panels(observer_table()[:, 0], _GAUSS_POINTS)
    weights = density(wavelength_nm) * gauss[:, None]
    total = weights.sum(axis=0)
    if not np.all(total > 0.0):
        raise UsageError("A channel of this RGB space sees nothing of this light: it has no white.")
    return wavelength_nm, weights / total


def _fourier(wavelength_nm: Float64, weights: Float64) -> Complex128:
    """Return Σ weights exp(2πi D/λ) at the first three points of each cell, (CELLS + 1, 3, 3)."""
    stride = int(np.sqrt(CELLS)) + 1
    turns = STEP_NM / wavelength_nm
    # D = (stride·i + j + point)·step: two small tables and a matrix product.
    coarse = np.exp(2j * np.pi * stride * np.arange(stride)[:, None] * turns)
    fine = np.exp(2j * np.pi * (np.arange(stride)[:, None] + _POINTS[:3]).reshape(-1, 1) * turns)
    columns = [((coarse * w) @ fine.T).reshape(-1, 3)[: CELLS + 1] for w in weights.T]
    return np.stack(columns, axis=-1)


def _envelope(sizes: Float64, wavelength_nm: Float64, weights: Float64) -> tuple[Float64, float]:
    """Return the envelope (CELLS + 1,) of `sizes` (CELLS,), the greatest |Ŝ| of each cell, and `beyond`."""
    # Samples some nanometres apart miss a maximum by less than this share of it.
    from_here_on = 1.001 * np.maximum.accumulate(sizes[::-1])[::-1]
    # One cell late, so that a line between two values is above both.
    envelope = np.concatenate([from_here_on[:1], from_here_on])
    envelope[-1] = 0.0
    # |Ŝ| changes over 640 nm, the inverse of the visible wavenumbers: a hundredth covers what lies between.
    far_nm = np.linspace(END_NM - FADE_NM, 4.0 * END_NM, 481)
    far = 1.01 * np.abs(np.exp(2j * np.pi * far_nm[:, None] / wavelength_nm) @ weights).max()
    return envelope, float(max(far, from_here_on[-int(FADE_NM / STEP_NM)]))
