"""The slow integration, for spectra that one polynomial over the whole range does not resolve.

Gauss–Legendre panels between the kinks of the observer, halved where halving still moves the colour: narrow
resonances (grazing light between a film and a bright metal), films of many micrometres, kinked index tables.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.observer import observer_table
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.tolerances import COLOUR_CONVERGENCE

__all__ = ["integrate_adaptive"]

Float64 = NDArray[np.float64]
Rows = NDArray[np.intp]
Reflectance = Callable[[Rows, Float64], Float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

# A panel may start with this much of the fringes' phase: eight points then see what they do not resolve.
_PHASE_PER_PANEL_RAD: Final = 8.0

# Some two thousand panels share a row's tolerance.
_PANEL_TOLERANCE: Final = COLOUR_CONVERGENCE / 2048.0

_PANELS_AT_ONCE: Final = 1 << 13  # bounds the temporaries of one evaluation
_OPEN_PANELS: Final = 1 << 17  # rows are taken in groups that start with about as many panels
_MOST_FIRST_PANELS: Final = 1 << 23  # a metre of path difference: a minute or two
_MOST_PANELS: Final = 1 << 20  # noise leaves every half open; a spectrum with features leaves ever fewer
_MAX_HALVINGS: Final = 40  # a panel of 1e-12 nm: narrower than any feature that float64 can place


def integrate_adaptive(reflectance: Reflectance, rows: Rows, *, white: White, opd_nm: Float64) -> Float64:
    """Return linear Rec.709 (r, 3) of the spectra numbered `rows` (r,) with path differences `opd_nm` (r,).

    Raises UsageError where a spectrum stays unresolved.
    """
    result = np.zeros((len(rows), 3))
    order = np.argsort(opd_nm, kind="stable")
    while len(order) > 0:
        edges_nm = _first_edges(float(opd_nm[order[0]]))
        group = order[: max(1, _OPEN_PANELS // len(edges_nm))]
        edges_nm = _first_edges(float(opd_nm[group[-1]]))
        for start in range(0, len(edges_nm) - 1, _OPEN_PANELS):
            part = edges_nm[start : start + _OPEN_PANELS + 1]
            result[group] += _integrate_group(reflectance, rows[group], part, white)
        order = order[len(group) :]
    return result


def _integrate_group(reflectance: Reflectance, rows: Rows, edges_nm: Float64, white: White) -> Float64:
    rgb = np.zeros((len(rows), 3))
    position = np.repeat(np.arange(len(rows)), len(edges_nm) - 1)
    low, high = (np.tile(e, len(rows)) for e in (edges_nm[:-1], edges_nm[1:]))
    coarse = _panels(reflectance, rows[position], low, high, white)
    for _ in range(_MAX_HALVINGS):
        middle = 0.5 * (low + high)
        left = _panels(reflectance, rows[position], low, middle, white)
        right = _panels(reflectance, rows[position], middle, high, white)
        fine = left + right
        # Not "moved ≥ tolerance": a NaN must not count as settled.
        is_open = ~(np.abs(fine - coarse).max(axis=-1) < _PANEL_TOLERANCE)
        np.add.at(rgb, position[~is_open], fine[~is_open])
        if not is_open.any():
            return rgb
        if 2 * np.count_nonzero(is_open) > _MOST_PANELS:
            break
        position = np.tile(position[is_open], 2)
        low, high = (
            np.concatenate([low[is_open], middle[is_open]]),
            np.concatenate([middle[is_open], high[is_open]]),
        )
        coarse = np.concatenate([left[is_open], right[is_open]])
    raise UsageError(
        f"The spectra of {len(np.unique(position))} films do not settle to a colour near {low[0]:.1f} nm:"
        " make the film thinner or its index tables smoother."
    )


def _panels(reflectance: Reflectance, rows: Rows, low: Float64, high: Float64, white: White) -> Float64:
    """Return each panel's share (p, 3) of its row's colour."""
    shares = []
    for start in range(0, len(rows), _PANELS_AT_ONCE):
        part = slice(start, start + _PANELS_AT_ONCE)
        half = 0.5 * (high[part] - low[part])[:, None]
        wavelength_nm = low[part][:, None] + half * (1.0 + _NODES)
        weights = colour_density(wavelength_nm, white) * (half * _WEIGHTS)[..., None]
        values = reflectance(rows[part], wavelength_nm)
        values = values if values.ndim == 3 else values[..., None]
        shares.append((values * weights).sum(axis=1))
    return np.concatenate(shares)


def _first_edges(opd_nm: float) -> Float64:
    """Return the observer's 1 nm steps, cut evenly where the fringes run faster than a panel may."""
    knots = observer_table()[:, 0]
    phase_rad = 2.0 * np.pi * opd_nm * (1.0 / knots[:-1] - 1.0 / knots[1:])
    wanted = np.maximum(1.0, np.ceil(phase_rad / _PHASE_PER_PANEL_RAD))
    if wanted.sum() > _MOST_FIRST_PANELS:
        raise UsageError(
            f"A path difference of {opd_nm:.3g} nm has too many fringes to be summed: take thinner films."
        )
    cuts = wanted.astype(np.intp)
    steps = [
        np.linspace(a, b, n, endpoint=False) for a, b, n in zip(knots[:-1], knots[1:], cuts, strict=True)
    ]
    return np.concatenate([*steps, knots[-1:]])
