"""Method `bloch`: a mirror's colour from a few samples of its reflectance beside the real axis.

Every fringe that the samples cannot resolve is damped away there, whatever the number of cells; the gaps,
poles on the axis, are added one by one. spec/decisions/bloch.md derives it, with its error bound.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.colour.spaces import White
from gltf_iri.colour.wavenumber_rule import GAP_STEPS, WavenumberRule, wavenumber_rule
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.bloch import BlochCell, gap_poles, shifted_reflectance
from gltf_iri.optics.bragg_cell import film_optics, host_optics

__all__ = ["BLOCH_SAMPLES", "bloch_table", "evaluate_bloch"]

Float64 = NDArray[np.float64]

BLOCH_SAMPLES: Final = 12

_ROWS_AT_ONCE: Final = 512  # keeps temporaries inside a core's cache


def evaluate_bloch(
    mirror: Mirror, white: White, *, samples: int = BLOCH_SAMPLES, backend: Backend = "numpy"
) -> Evaluation:
    """Return the colour from `samples` wavenumbers a polarisation.

    Raises UsageError for cells that absorb and for total reflection at a film that fades into it.
    """
    if not mirror.is_lossless:
        raise UsageError("The method 'bloch' wants cells that absorb nothing; use 'yeh-spectral'.")
    host_ior, n1, cosine = mirror.host_ior, mirror.n1.real, mirror.cos_theta_h
    films = film_optics(host_ior, n1, mirror.n2.real, mirror.d1_nm, mirror.d2_nm, cosine)
    is_trapped = np.broadcast_to(films.fades_in_2 & ~films.fades_in_1, mirror.shape)
    if is_trapped.any():
        steepest = np.broadcast_to(cosine, mirror.shape)[is_trapped].max()
        raise UsageError(
            "The method 'bloch' wants light that runs in both films, but it is totally reflected inside the"
            f" cells at cos θ = {steepest:g}; use 'yeh-spectral' there."
        )
    rule = wavenumber_rule(samples, white)
    rows = BlochCell.of(films, host_optics(host_ior, n1, cosine), mirror.shape, rule.step_per_nm)
    cells = np.broadcast_to(mirror.cells, mirror.shape).reshape(-1)
    rgb = np.zeros((len(cells), 3))
    if backend == "numba":
        from gltf_iri.compiled.bloch import bloch_colours

        grid = float(rule.wavenumber_per_nm[0]), rule.step_per_nm, rule.height_per_nm
        weights = np.ascontiguousarray(rule.weights.swapaxes(0, 1))
        bloch_colours(rows.paths_nm, rows.scans, rows.constants, cells, grid, weights, rule.gap_weights, rgb)
    else:
        for start in range(0, len(cells), _ROWS_AT_ONCE):
            part = slice(start, start + _ROWS_AT_ONCE)
            rgb[part] = _colours(rows.part(part), cells[part], rule)
    return Evaluation(rgb.reshape(*mirror.shape, 3), "bloch", str(white))


def _colours(cell: BlochCell, cells: NDArray[np.int64], rule: WavenumberRule) -> Float64:
    samples = shifted_reflectance(cell, cells, rule.wavenumber_per_nm, rule.height_per_nm).sum(axis=0)
    rgb = 0.5 * (samples.real @ rule.weights[0] + samples.imag @ rule.weights[1])
    rows, place, strength = gap_poles(cell, cells, rule.wavenumber_per_nm)
    np.add.at(rgb, rows, 0.5 * strength[:, None] * _gap_weight(place, rule))
    return np.asarray(rgb)


def _gap_weight(place: Float64, rule: WavenumberRule) -> Float64:
    """Return (g, 3): the rule's weights of poles at `place` (g,), in steps from the grid's first point."""
    entry = np.minimum((GAP_STEPS * place).astype(np.intp), len(rule.gap_weights) - 2)
    share = (GAP_STEPS * place - entry)[:, None]
    return np.asarray((1.0 - share) * rule.gap_weights[entry] + share * rule.gap_weights[entry + 1])


def bloch_table(white: White, samples: int = BLOCH_SAMPLES) -> NDArray[np.float32]:
    """Return (GAP_STEPS + 3, samples, 4) for the GLSL twin.

    Rows 0 and 1 weigh Re Q and Im Q of each sample; row 2 + j is a pole's weight j/GAP_STEPS of a step
    beyond it. The fourth channel of row 0 holds the grid: its first 1/λ, its step, the height (1/nm).
    """
    rule = wavenumber_rule(samples, white)
    table = np.zeros((GAP_STEPS + 3, samples, 4), dtype=np.float32)
    table[:2, :, :3] = rule.weights
    for column in range(samples - 1):
        first = GAP_STEPS * column
        table[2:, column, :3] = rule.gap_weights[first : first + GAP_STEPS + 1]
    table[0, :3, 3] = rule.wavenumber_per_nm[0], rule.step_per_nm, rule.height_per_nm
    return table
