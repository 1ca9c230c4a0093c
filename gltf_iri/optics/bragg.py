"""The exact reflectance of a Bragg mirror: N equal cells of two films, under any host, absorbing or not.

The films of a cell are n1, met first, and n2; beyond the last cell lies n1 again (Fourneau et al. 2024,
whose Appendix D leaves the exit medium n1). With a host the order of the films is visible. Lossless cells
take Yeh's closed form (`yeh`), absorbing ones the powers of a complex matrix (`lossy_bragg`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import Backend
from gltf_iri.optics.bragg_cell import Films, Host, film_optics, host_optics
from gltf_iri.optics.grid import Grid, Tile
from gltf_iri.optics.lossy_bragg import lossy_powers
from gltf_iri.optics.yeh import SCRATCH_ARRAYS, half_phases, transmittance

__all__ = ["BraggPowers", "bragg_powers", "bragg_reflectance"]

Float64 = NDArray[np.float64]


class BraggPowers(NamedTuple):
    """Shares of the incident power: reflected, carried into the exit medium, absorbed; R + T + A = 1."""

    R_s: Float64
    R_p: Float64
    T_s: Float64
    T_p: Float64
    A_s: Float64
    A_p: Float64


def bragg_reflectance(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cells: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_h: ArrayLike,
    *,
    backend: Backend = "numpy",
) -> Float64:
    """Return the mean of R_s and R_p, in [0, 1]; arrays broadcast, NaN gives NaN.

    host_ior : real; n1, n2 : n + ik, k ≥ 0; cells : whole numbers ≥ 1. Fast where the last axis is that of
    the wavelengths and every other argument has length 1 there. Cells that absorb are numpy's on either
    backend.
    """
    grid = Grid(wavelength_nm, (host_ior, n1, n2, d1_nm, d2_nm, cells, cos_theta_h), SCRATCH_ARRAYS)
    reflected = grid.zeros(is_turned=backend == "numpy")
    for tile, powers in _lossy_tiles(grid):
        tile.put(0.5 * (powers.R_s + powers.R_p), reflected)
    if backend == "numba":
        _reflect_compiled(grid, reflected)
    else:
        for tile, t_s, t_p in _lossless_tiles(grid):
            mean = np.add(t_s, t_p, out=t_s)
            mean *= -0.5
            mean += 1.0
            tile.put(mean, reflected)
    return grid.shaped(reflected)


def bragg_powers(
    host_ior: ArrayLike,
    n1: ArrayLike,
    n2: ArrayLike,
    d1_nm: ArrayLike,
    d2_nm: ArrayLike,
    cells: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_h: ArrayLike,
) -> BraggPowers:
    """Return R, T and A of both polarisations; arguments as for `bragg_reflectance`.

    T is the flux into the exit medium, 0 where light fades there; A is the flux that enters the cells less T.
    """
    grid = Grid(wavelength_nm, (host_ior, n1, n2, d1_nm, d2_nm, cells, cos_theta_h), SCRATCH_ARRAYS)
    shares = [grid.zeros() for _ in BraggPowers._fields]
    for tile, powers in _lossy_tiles(grid):
        for share, values in zip(shares, powers, strict=True):
            tile.put(values, share)
    for tile, t_s, t_p in _lossless_tiles(grid):
        for share, values in zip(shares, (1.0 - t_s, 1.0 - t_p, t_s, t_p), strict=False):
            tile.put(values, share)
    return BraggPowers(*(grid.shaped(share) for share in shares))


def _lossy_tiles(grid: Grid) -> Iterator[tuple[Tile, BraggPowers]]:
    """Yield the tiles whose cells absorb."""
    host, n1, n2, d1, d2, cells, cosine = grid.columns
    for tile in grid.tiles(grid.rows_where(_absorbs(n1, n2))):
        of = tile.of_rows
        shares = lossy_powers(
            of(host), of(n1), of(n2), of(d1), of(d2), of(cells), tile.wavelength_nm, of(cosine)
        )
        yield tile, BraggPowers(*shares)


def _lossless_tiles(grid: Grid) -> Iterator[tuple[Tile, Float64, Float64]]:
    """Yield the tiles whose cells do not absorb, with T_s and T_p."""
    is_lossless, films, host = _constants(grid)
    cells = grid.columns[5]
    # One number for all is doubled along its own bits; else every row goes through the bits of the greatest.
    count = int(cells[0]) if np.all(cells == cells[:1]) else None
    for is_fading in (False, True):
        rows = grid.rows_where(is_lossless & ~films.fades_in_1 & (films.fades_in_2 == is_fading))
        for tile in grid.tiles(rows):
            of, scratch = tile.of_rows, tile.scratch
            phases = half_phases(
                of(films.path_1_nm), of(films.path_2_nm), tile.wavelength_nm, scratch, is_frustrated=is_fading
            )
            number = of(cells.astype(np.int64)) if count is None else count
            host_s = None if host is None else (of(host.r_s), of(host.t_s))
            host_p = None if host is None else (of(host.r_p), of(host.t_p))
            with np.errstate(over="ignore"):  # deep in a gap R/T overflows, and T is 0
                t_s = transmittance(
                    phases, of(films.contrast_s), of(films.imbalance_s), number, host_s, scratch
                )
                t_p = transmittance(
                    phases, of(films.contrast_p), of(films.imbalance_p), number, host_p, scratch
                )
            yield tile, t_s, t_p
    _, _, n2, d1, d2, _, _ = grid.columns
    for tile in grid.tiles(grid.rows_where(is_lossless & films.fades_in_1)):
        # Light fades in n1 and beyond the mirror: all is reflected; only a NaN passes.
        nothing = 0.0 * (tile.of_rows(n2.real + d1 + d2) * tile.wavelength_nm)
        yield tile, nothing, nothing.copy()


def _reflect_compiled(grid: Grid, reflected: Float64) -> None:
    """Put the mean of R_s and R_p of the cells that do not absorb into `reflected`, by compiled loops."""
    from gltf_iri.compiled.bragg import bragg_rows, bragg_rows_in_host
    from gltf_iri.compiled.bragg_cell import CONSTANTS, write_constants

    host, n1, n2, d1, d2, cells, cosine = grid.columns
    rows = grid.rows_where(~_absorbs(n1, n2))
    given = grid.table((host, n1.real, n2.real, d1, d2, cosine, cells), rows)
    constants, wavelength_nm = np.zeros((CONSTANTS, given.shape[1])), grid.wavelengths_of(rows)
    values = reflected if isinstance(rows, slice) else np.zeros((given.shape[1], reflected.shape[1]))
    is_general = write_constants(given[:6], constants)
    (bragg_rows_in_host if is_general else bragg_rows)(
        constants, given[6].astype(np.int64), wavelength_nm, values
    )
    if values is not reflected:
        reflected[rows] = values


def _absorbs(n1: NDArray[np.complex128], n2: NDArray[np.complex128]) -> NDArray[np.bool_]:
    if not (np.iscomplexobj(n1) or np.iscomplexobj(n2)):
        return np.zeros(1, dtype=np.bool_)
    return np.asarray((n1.imag != 0.0) | (n2.imag != 0.0))


def _constants(grid: Grid) -> tuple[NDArray[np.bool_], Films, Host | None]:
    """Return which rows absorb nothing, their films' constants, and their host's where one is not n1."""
    host, n1, n2, d1, d2, _, cosine = grid.columns
    is_lossless = ~_absorbs(n1, n2)
    films = film_optics(host, n1.real, n2.real, d1, d2, cosine)
    return is_lossless, films, None if np.all(host == n1) else host_optics(host, n1.real, cosine)
