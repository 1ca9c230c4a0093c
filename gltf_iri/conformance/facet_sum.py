"""What a rough layer lets pass, as a plain sum over the angles that its facets are met at: the vectors' own.

T(λ, θ_i) = ∫ (1 − R(λ, θ_d)) F_α(θ_i, θ_d) dθ_d, Fourneau et al. 2024, Eq. 28. Panels of Gauss points end at
the peak of F_α (θ_i), where facets begin to end at the horizon (π/2 − θ_i), and where no light enters n1 any
more (grazing, or the critical angle of a host denser than n1). Each is halved until that moves T nowhere over
the spectrum: at resonances between the films, which sharpen towards grazing light, and where F_α is narrow.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.conformance.spectral_sum import NotSettledError
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import transmission_filter

__all__ = ["Facets", "Passing"]

Float64 = NDArray[np.float64]

_POINTS: Final = 10
_FIRST_PANELS: Final = 4  # between two of the ends that have a reason
_SAME_RAD: Final = 5e-8

# A panel is done when its halves move T by no more, at any of _PROBES wavelengths.
_PANEL_TOLERANCE: Final = 1e-13
_PROBES: Final = 200

# Beyond, a row takes too long to be worth its place.
_ANGLES_MAX: Final = 40_000

_VALUES_AT_ONCE: Final = 1 << 21  # bounds memory: angles × wavelengths


@dataclass(frozen=True, slots=True)
class Facets:
    """The facets of a layer in its host: N cells of n1, met first, and n2; n1 lies beyond the last."""

    host_ior: float
    n1: float
    n2: float
    d1_nm: float
    d2_nm: float
    cells: int
    alpha: float

    def reflectance(self, wavelength_nm: Float64, cos_theta: Float64, backend: Backend = "numpy") -> Float64:
        """Return (c, k), the mean of R_s and R_p at wavelengths (k,) and cosines (c,) in the host."""
        return bragg_reflectance(
            *(self.host_ior, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells),
            wavelength_nm,
            np.asarray(cos_theta, np.float64)[:, None],
            backend=backend,
        )


class Passing:
    """T of one layer for light at some angles."""

    def __init__(
        self,
        facets: Facets,
        cos_theta: Float64,
        backend: Backend = "numpy",
        tolerance: float = _PANEL_TOLERANCE,
    ) -> None:
        """Choose the angles; NotSettledError where no affordable number of them settles T.

        cos_theta : (c,) in the host.
        """
        self._facets, self._backend = facets, backend
        self._cosines = np.asarray(cos_theta, np.float64)
        self._theta, self._weights = np.zeros(0), np.zeros((len(self._cosines), 0))
        if facets.alpha > 0.0:
            self._choose(tolerance)

    @property
    def angles(self) -> int:
        """How many angles T is summed over."""
        return len(self._theta)

    def transmittance(self, wavelength_nm: Float64) -> Float64:
        """Return (c, k); a smooth layer's is 1 − R at the light's own angle."""
        if self._facets.alpha == 0.0:
            return 1.0 - self._facets.reflectance(wavelength_nm, self._cosines, self._backend)
        step = max(1, _VALUES_AT_ONCE // len(self._theta))
        parts = [
            self._weights @ self._passed(wavelength_nm[k : k + step], self._theta)
            for k in range(0, len(wavelength_nm), step)
        ]
        return np.concatenate(parts, axis=1)

    def _choose(self, tolerance: float) -> None:
        # Steps of the golden ratio: no wavelength stands where a film is half a wave by chance.
        probes = 360.0 + 470.0 * np.modf(np.arange(1, _PROBES + 1) * 0.6180339887498949)[0]
        panels = _first_panels(self._facets, np.arccos(self._cosines))
        sums = self._panel_sums(panels, probes)[2]
        kept: list[tuple[Float64, Float64]] = []
        count = 0
        while len(panels) > 0:
            count += 2 * len(panels) * _POINTS
            if count > _ANGLES_MAX:
                raise NotSettledError("What passes a layer moves with every halving of its panels of angles.")
            halves = _halved(panels)
            theta, weights, finer = self._panel_sums(halves, probes)
            moved = np.abs(finer[0::2] + finer[1::2] - sums).max(axis=(1, 2))
            # Not "moved > tolerance": a NaN must not count as settled.
            is_open = np.repeat(~(moved <= tolerance), 2)
            kept.append((theta[~is_open].reshape(-1), weights[:, ~is_open].reshape(len(weights), -1)))
            panels, sums = halves[is_open], finer[is_open]
        self._theta = np.concatenate([theta for theta, _ in kept])
        self._weights = np.concatenate([weights for _, weights in kept], axis=1)

    def _panel_sums(self, panels: Float64, wavelength_nm: Float64) -> tuple[Float64, Float64, Float64]:
        """Return angles (p, n), their weights (c, p, n), and what each panel adds to T (p, c, k)."""
        theta, step = _angles(panels)
        weights = np.zeros((len(self._cosines), *theta.shape))
        for row, cosine in zip(weights, self._cosines, strict=True):
            # Light along the surface is masked: G₁ = 0.
            if cosine > 0.0:
                row[:] = transmission_filter(cosine, theta, self._facets.alpha) * step
        sums = np.zeros((len(panels), len(weights), len(wavelength_nm)))
        at_once = max(1, _VALUES_AT_ONCE // (_POINTS * len(wavelength_nm)))
        for p in range(0, len(panels), at_once):
            part = slice(p, p + at_once)
            passed = self._passed(wavelength_nm, theta[part].reshape(-1))
            passed = passed.reshape(-1, _POINTS, len(wavelength_nm))
            sums[part] = np.einsum("cpn,pnk->pck", weights[:, part], passed)
        return theta, weights, sums

    def _passed(self, wavelength_nm: Float64, theta: Float64) -> Float64:
        return np.asarray(1.0 - self._facets.reflectance(wavelength_nm, np.cos(theta), self._backend))


def _first_panels(facets: Facets, theta_i: Float64) -> Float64:
    """Return (p, 5): a, b, c of θ = a + bu + cu², and where u begins and ends, over all angles that pass."""
    sine = facets.n1 / facets.host_ior
    last = float(np.arcsin(sine)) if sine < 1.0 else 0.5 * np.pi
    horizon = 0.5 * np.pi - theta_i
    ends = np.unique(np.clip(np.concatenate([[0.0], theta_i, horizon]), 0.0, last))
    # What an arc cosine rounds makes no panel: less than 1e-12 of T lies between such ends.
    ends = np.append(ends[np.append(True, np.diff(ends) > _SAME_RAD) & (ends < last - _SAME_RAD)], last)
    cuts = np.concatenate([np.linspace(a, b, _FIRST_PANELS, endpoint=False) for a, b in pairwise(ends)])
    panels = []
    for low, high in zip(cuts, np.append(cuts[1:], last), strict=True):
        if np.any(np.abs(low - horizon) <= _SAME_RAD):  # F_α grows from there as a square root
            panels.append((low, 0.0, 1.0, 0.0, np.sqrt(high - low)))
        elif high == last and sine < 1.0:  # the angle in n1 falls to grazing as one
            panels.append((last, 0.0, -1.0, np.sqrt(high - low), 0.0))
        else:
            panels.append((0.0, 1.0, 0.0, low, high))
    return np.array(panels)


def _halved(panels: Float64) -> Float64:
    halves = np.repeat(panels, 2, axis=0)
    middle = 0.5 * (panels[:, 3] + panels[:, 4])
    halves[0::2, 4] = middle
    halves[1::2, 3] = middle
    return halves


def _angles(panels: Float64) -> tuple[Float64, Float64]:
    """Return the Gauss angles (p, n) of `panels` and their steps in dθ."""
    nodes, gauss = leggauss(_POINTS)
    a, b, c, low, high = (column[:, None] for column in panels.T)
    u = low + (high - low) * (0.5 + 0.5 * nodes)
    theta, slope = a + b * u + c * u * u, b + 2.0 * c * u
    return np.clip(theta, 0.0, 0.5 * np.pi), slope * (0.5 * (high - low) * gauss)
