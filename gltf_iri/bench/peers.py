"""The libraries that `bench optics --peers` compares with; nothing else here uses them.

Each is asked in the way that is its fastest for a grid. What it can be given beforehand (lists, materials) is
prepared outside the time that is measured. How much of a grid each is given is set by what it takes for it.
"""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.workloads import Workload

__all__ = ["PEERS", "Peer", "silent_peers"]

Float64 = NDArray[np.float64]
Run = Callable[[], Float64]  # → reflectances (s, a, k), s and p averaged
Prepare = Callable[[Any, Workload], Run]

_FULL: Final = (10**9, 10**9, 10**9)
_NM: Final = 1e-9


@dataclass(frozen=True, slots=True)
class Peer:
    """A library, how it is asked, and at most how many structures, angles and wavelengths it is given."""

    name: str
    package: str  # what pip installs
    module: str
    prepare: Prepare
    grids: MappingProxyType[str, tuple[int, int, int]]  # by Workload.alike

    def load(self) -> Any:
        """Import the library; ImportError where it is not installed or not whole."""
        return importlib.import_module(self.module)

    @property
    def version(self) -> str:
        """Return the installed version, "" where there is none."""
        try:
            return version(self.package)
        except PackageNotFoundError:
            return ""


@contextmanager
def silent_peers() -> Iterator[None]:
    """Keep the libraries' warnings about opaque layers, divisions and logarithms of zero to themselves."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        yield


def _tmm(tmm: Any, workload: Workload) -> Run:
    stacks = _all_with_ends(workload)
    angles_rad = np.deg2rad(workload.angle_deg)

    def run() -> Float64:
        values = [
            tmm.unpolarized_RT(n, d, angle, wavelength)["R"]
            for n, d in stacks
            for angle in angles_rad
            for wavelength in workload.wavelength_nm
        ]
        return np.reshape(values, workload.shape)

    return run


def _tmm_fast(tmm_fast: Any, workload: Workload) -> Run:
    stacks = _all_with_ends(workload)
    n = np.array([n for n, _ in stacks])[:, :, None] * np.ones(workload.shape[2])
    d_m = np.array([d for _, d in stacks]) * _NM
    angles_rad, wavelengths_m = np.deg2rad(workload.angle_deg), workload.wavelength_nm * _NM

    def run() -> Float64:
        s, p = (tmm_fast.coh_tmm(each, n, d_m, angles_rad, wavelengths_m)["R"] for each in "sp")
        return np.asarray(0.5 * (s + p))

    return run


def _tmm_faster(tmm_faster: Any, workload: Workload) -> Run:
    rows = np.ones((workload.shape[2], 1))
    stacks = [(rows * n, np.nan_to_num(d, posinf=0.0)) for n, d in _all_with_ends(workload)]

    def run() -> Float64:
        answers = [
            tmm_faster.calc_coherent(n, d, workload.angle_deg, workload.wavelength_nm)["R_avg"]
            for n, d in stacks
        ]
        return np.swapaxes(np.array(answers), 1, 2)

    return run


def _colour(phenomena: Any, workload: Workload) -> Run:
    stacks = [workload.layers(s) for s in range(workload.shape[0])]

    def run() -> Float64:
        answers = [
            phenomena.multilayer_tmm(n, d, workload.wavelength_nm, workload.angle_deg)[0] for n, d in stacks
        ]
        return np.swapaxes(np.array(answers)[:, :, :, 0, :].mean(axis=-1), 1, 2)

    return run


def _pymoosh(method: str) -> Prepare:
    def prepare(pymoosh: Any, workload: Workload) -> Run:
        structures = []
        for n, d in _all_with_ends(workload):
            kinds, order = np.unique(n, return_inverse=True)
            materials, thicknesses = list(kinds**2), list(np.nan_to_num(d, posinf=0.0))
            structures.append(pymoosh.Structure(materials, list(order), thicknesses, verbose=False))
        angles_rad, wavelengths = np.deg2rad(workload.angle_deg), workload.wavelength_nm
        sweep = getattr(pymoosh, f"spectrum_{method}_list")

        def run() -> Float64:
            values = [
                0.5
                * sum(
                    np.real(sweep(one, angle, polarisation, wavelengths.copy())[2]) for polarisation in (0, 1)
                )
                for one in structures
                for angle in angles_rad
            ]
            return np.reshape(values, workload.shape)

        return run

    return prepare


def _pystratify(planar: Any, workload: Workload) -> Run:
    stacks = _all_with_ends(workload)
    angles_rad = np.deg2rad(workload.angle_deg)

    def run() -> Float64:
        values = []
        for n, d in stacks:
            for angle in angles_rad:
                s, p = (
                    planar.coh_tmm_wavelength_sweep(
                        each, n, d, angle, workload.wavelength_nm, include_layer_absorption=False
                    )["R"]
                    for each in "sp"
                )
                values.append(0.5 * (s + p))
        return np.reshape(values, workload.shape)

    return run


def _all_with_ends(workload: Workload) -> list[tuple[NDArray[np.complex128], Float64]]:
    """Return each structure's indices and thicknesses, those of the outside and the exit infinite."""
    written = [workload.layers(s) for s in range(workload.shape[0])]
    return [(n, np.concatenate([[np.inf], d, [np.inf]])) for n, d in written]


def _grids(
    film: tuple[int, int, int],
    cells_10: tuple[int, int, int],
    cells_200: tuple[int, int, int],
    many: tuple[int, int, int],
) -> MappingProxyType[str, tuple[int, int, int]]:
    return MappingProxyType({"W1": film, "W3": cells_10, "W4": cells_200, "W5": many})


_THREE_ANGLES: Final = (1, 3, 471)
_SWEEPS: Final = (1, 13, 471), (1, 7, 471), _THREE_ANGLES

PEERS: Final = (
    Peer("tmm", "tmm", "tmm", _tmm, _grids((1, 11, 8), (1, 3, 4), (1, 2, 3), (1, 1, 81))),
    Peer("tmm-fast", "tmm-fast", "tmm_fast", _tmm_fast, _grids(_FULL, _FULL, _THREE_ANGLES, (200, 1, 81))),
    Peer(
        "tmm-faster", "tmm-faster", "tmm_faster", _tmm_faster,
        _grids(_FULL, _FULL, _THREE_ANGLES, (200, 1, 81)),
    ),
    Peer("PyMoosh, S", "PyMoosh", "PyMoosh", _pymoosh("S"), _grids(*_SWEEPS, (30, 1, 81))),
    Peer("PyMoosh, A", "PyMoosh", "PyMoosh", _pymoosh("A"), _grids(*_SWEEPS, (30, 1, 81))),
    Peer(
        "colour", "colour-science", "colour.phenomena", _colour,
        _grids(_FULL, _FULL, _THREE_ANGLES, (100, 1, 81)),
    ),
    Peer("pystratify", "pystratify", "pystratify.planar", _pystratify, _grids(*_SWEEPS, (50, 1, 81))),
)  # fmt: skip
