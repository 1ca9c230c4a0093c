"""The transmission filter as weights on fixed angles, for facets whose reflectance fringes finely.

A layer's facets are sampled once, at Gauss points on panels of θ_d that their fringes ask for; on each panel
the reflectance is the polynomial through them. What F_α makes of such polynomials is integrated for every θ_i
by itself: panels are cut where F_α has its peak and where facets begin to end at the horizon, and beyond that
θ_d = π/2 − θ_i + t² takes the square root out of it. Weights at fixed angles serve all wavelengths at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from gltf_iri.optics.rough_bragg import transmission_filter

__all__ = ["FilterPanels"]

Float64 = NDArray[np.float64]

POINTS: Final = 16

# Halvings of the last panel towards grazing angles, where resonances between the films sharpen as cosθ.
_HALVINGS: Final = 6

# Panels halve towards the peak of F_α until they are as narrow as this many α.
_PEAK_WIDTHS: Final = 1.0


@dataclass(frozen=True, slots=True)
class FilterPanels:
    """Panels of θ_d on [0, π/2], with POINTS Gauss points each.

    edges_rad : (p + 1,); cosines : (p·POINTS,) of the points, to sample 1 − R at.
    """

    edges_rad: Float64
    cosines: Float64

    @classmethod
    def of(cls, count: int) -> FilterPanels:
        """Return `count` even panels, the last of them halved towards grazing angles."""
        even = np.linspace(0.0, 0.5 * np.pi, count + 1)
        last = even[-1] - (even[-1] - even[-2]) * 0.5 ** np.arange(1, _HALVINGS + 1)
        edges = np.concatenate([even[:-1], last, even[-1:]])
        points, _ = _gauss()
        theta = edges[:-1, None] + np.diff(edges)[:, None] * points
        return cls(edges, np.cos(theta).reshape(-1))

    def weights(self, cos_theta_i: Float64, alpha: float) -> Float64:
        """Return (n, p·POINTS), T(θ_i) = Σ weights·(1 − R) of light at `cos_theta_i` (n,), Eq. 28.

        alpha : in (0, 1]. Exact to rounding for polynomials on each panel; Σ weights = G₁(θ_i).
        """
        return np.stack([self._weights_of(float(c), alpha) for c in np.maximum(cos_theta_i, 1e-9)])

    def _weights_of(self, cosine: float, alpha: float) -> Float64:
        theta_i = float(np.arccos(cosine))
        horizon = 0.5 * np.pi - theta_i
        cuts = self._cuts(theta_i, horizon, alpha)
        low, length = cuts[:-1], np.diff(cuts)
        points, gauss = _gauss()
        panel = np.searchsorted(self.edges_rad, low, side="right") - 1
        at_horizon = np.searchsorted(self.edges_rad, horizon, side="right") - 1
        # A square root is felt a panel beyond its own.
        bends = (low >= horizon) & (panel <= at_horizon + 1)
        start, stop = np.sqrt(np.maximum(low - horizon, 0.0)), np.sqrt(np.maximum(cuts[1:] - horizon, 0.0))
        t = start[:, None] + (stop - start)[:, None] * points
        theta = np.where(bends[:, None], horizon + t * t, low[:, None] + length[:, None] * points)
        step = np.where(bends[:, None], 2.0 * t * (stop - start)[:, None], length[:, None]) * gauss
        share = transmission_filter(cosine, np.minimum(theta, 0.5 * np.pi), alpha) * step
        width = np.diff(self.edges_rad)[panel]
        is_whole = ~bends & (length == width)
        weights = np.zeros((len(self.edges_rad) - 1, POINTS))
        weights[panel[is_whole]] = share[is_whole]
        cut = ~is_whole
        place = (theta[cut] - self.edges_rad[panel[cut], None]) / width[cut, None]
        np.add.at(weights, panel[cut], np.einsum("cs,csn->cn", share[cut], _lagrange(place)))
        return weights.reshape(-1)

    def _cuts(self, theta_i: float, horizon: float, alpha: float) -> Float64:
        """Return the edges of panels and, between them, those that F_α asks for."""
        widest = float(np.diff(self.edges_rad).max())
        halvings = max(0, int(np.ceil(np.log2(2.0 * widest / (_PEAK_WIDTHS * alpha)))) + 1)
        offsets = _PEAK_WIDTHS * alpha * 2.0 ** np.arange(halvings)
        peak = np.concatenate([theta_i - offsets, [theta_i], theta_i + offsets])
        extra = np.append(peak, horizon)
        extra = extra[(extra > 0.0) & (extra < 0.5 * np.pi)]
        return np.union1d(self.edges_rad, extra)


@cache
def _gauss() -> tuple[Float64, Float64]:
    nodes, weights = leggauss(POINTS)
    return 0.5 + 0.5 * nodes, 0.5 * weights


@cache
def _barycentric() -> Float64:
    points, _ = _gauss()
    differences = points[:, None] - points + np.eye(POINTS)
    return np.asarray(1.0 / differences.prod(axis=1))


def _lagrange(place: Float64) -> Float64:
    """Return (..., POINTS), the Lagrange polynomials of the points at `place` (...) in [0, 1] of a panel."""
    points, _ = _gauss()
    difference = place[..., None] - points
    # At a point itself 0/0: so near to it all digits agree.
    difference = np.where(np.abs(difference) < 1e-14, 1e-14, difference)
    terms = _barycentric() / difference
    return np.asarray(terms / terms.sum(axis=-1, keepdims=True))
