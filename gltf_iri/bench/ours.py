"""This package's own reflectances, as `bench optics` asks them: films, mirrors and general stacks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.bench.workloads import Workload
from gltf_iri.optics.airy import film_power
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.film import film_reflectance
from gltf_iri.optics.stack import stack_power

__all__ = ["OURS", "Own"]

Float64 = NDArray[np.float64]
Run = Callable[[], Float64]  # → reflectances (s, a, k), s and p averaged
Grids = MappingProxyType[str, tuple[int, int, int]]  # by Workload.alike


@dataclass(frozen=True, slots=True)
class Own:
    """A function of this package, on which workloads it stands, and how it is asked.

    grids : at most how many structures, angles and wavelengths it is given; the whole grid where none stand.
    backends : those it has.
    """

    name: str
    fits: Callable[[Workload], bool]
    prepare: Callable[[Workload, Backend], Run]
    grids: Grids
    backends: tuple[Backend, ...] = ("numpy", "numba")


def _film(workload: Workload, backend: Backend) -> Run:
    arguments = (
        workload.outside_ior,
        _by_structure(workload.cell_index[:, 0]).real,
        _by_structure(workload.exit_index),
        _by_structure(workload.cell_nm[:, 0]),
        workload.wavelength_nm,
        workload.cos_theta[:, None],
    )
    return lambda: film_reflectance(*arguments, backend=backend)


def _airy(workload: Workload, _: Backend) -> Run:
    media = (_by_structure(workload.cell_index[:, 0]), _by_structure(workload.exit_index))
    arguments = (
        workload.outside_ior,
        *media,
        _by_structure(workload.cell_nm[:, 0]),
        workload.wavelength_nm,
        workload.cos_theta[:, None],
    )

    def run() -> Float64:
        power = film_power(*arguments)
        return np.asarray(0.5 * (power.R_s + power.R_p))

    return run


def _bragg(workload: Workload, backend: Backend) -> Run:
    n1, n2 = (_by_structure(_real_where_possible(n)) for n in workload.cell_index.T)
    d1_nm, d2_nm = (_by_structure(d) for d in workload.cell_nm.T)
    host, cells, cosine = workload.outside_ior, workload.cells, workload.cos_theta[:, None]
    wavelength_nm = workload.wavelength_nm
    return lambda: bragg_reflectance(
        host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine, backend=backend
    )


def _stack(workload: Workload, backend: Backend) -> Run:
    written = [workload.layers(s) for s in range(workload.shape[0])]
    # The outside is one real number for all structures.
    indices: list[Any] = [
        workload.outside_ior,
        *(_by_structure(n) for n in np.array([n for n, _ in written]).T[1:]),
    ]
    thicknesses_nm = [_by_structure(d) for d in np.array([d for _, d in written]).T]
    wavelength_nm, cosine = workload.wavelength_nm, workload.cos_theta[:, None]

    def run() -> Float64:
        power = stack_power(indices, thicknesses_nm, wavelength_nm, cosine, backend=backend)
        return np.asarray(0.5 * (power.R_s + power.R_p))

    return run


def _by_structure(values: NDArray[Any]) -> NDArray[Any]:
    """Return (s,) in the shape of the answer's first axis, (s, 1, 1)."""
    return values[:, None, None]


def _absorbs(workload: Workload) -> bool:
    return bool(workload.cell_index.imag.any())


def _real_where_possible(index: NDArray[np.complex128]) -> NDArray[Any]:
    return index if index.imag.any() else index.real


_WHOLE: Final[Grids] = MappingProxyType({})

OURS: Final = (
    Own("film", lambda workload: workload.is_film and not _absorbs(workload), _film, _WHOLE),
    Own("airy", lambda workload: workload.is_film, _airy, _WHOLE, ("numpy",)),
    Own("bragg", lambda workload: not (workload.is_film or _absorbs(workload)), _bragg, _WHOLE),
    # Cells that absorb have no compiled loop: asked for one, `bragg_reflectance` takes numpy.
    Own("bragg", lambda workload: not workload.is_film and _absorbs(workload), _bragg, _WHOLE, ("numpy",)),
    Own(
        "stack",
        lambda _: True,
        _stack,
        MappingProxyType({"W4": (1, 13, 471), "W5": (500, 1, 81)}),
    ),
)
