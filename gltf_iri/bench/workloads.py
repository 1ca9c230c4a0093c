"""Workloads of `bench optics`: grids of wavelengths and angles over one structure, or over many.

W1 to W5 are what every library for thin films can do. The others are the general domain, where closed forms
for lossless cells and real sines do not reach: absorption, and total reflection inside.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.fifty_digits import mirror_50_digits, stack_50_digits

__all__ = ["WORKLOADS", "Workload", "error_max_abs"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

# How large a grid each peer can finish is known for these; the general rows take the one of their like.
Alike = Literal["W1", "W3", "W4", "W5"]


@dataclass(frozen=True, slots=True)
class Workload:
    """`cells` equal cells between the outside and the exit medium, at every wavelength and angle.

    wavelength_nm : (k,); angle_deg : (a,), outside, between 0 and 90.
    cell_index, cell_nm : (s, m), the films of each of s structures' cell, in the order light meets them.
    exit_index : (s,). Answers have the shape (s, a, k), s and p averaged.
    targets : how many times faster than the fastest correct peer each backend is meant to be.
    """

    name: str
    about: str
    alike: Alike
    wavelength_nm: Float64
    angle_deg: Float64
    outside_ior: float
    cell_index: Complex128
    cell_nm: Float64
    cells: int
    exit_index: Complex128
    targets: tuple[tuple[str, float], ...] = ()

    @property
    def cos_theta(self) -> Float64:
        """Cosines of the angles outside, (a,)."""
        return np.asarray(np.cos(np.deg2rad(self.angle_deg)))

    @property
    def shape(self) -> tuple[int, int, int]:
        """Structures, angles, wavelengths."""
        return len(self.exit_index), len(self.angle_deg), len(self.wavelength_nm)

    @property
    def evaluations(self) -> int:
        """How many reflectances one run of it asks for."""
        return int(np.prod(self.shape))

    @property
    def is_film(self) -> bool:
        """True for a single film, False for a mirror of two films a cell."""
        return bool(self.cell_index.shape[1] == 1)

    def thinned(self, structures: int, angles: int, wavelengths: int) -> Workload:
        """Return the workload on so many structures, angles and wavelengths, evenly taken, ends included."""
        s, a, k = (
            _spread(n, want) for n, want in zip(self.shape, (structures, angles, wavelengths), strict=True)
        )
        return replace(
            self,
            wavelength_nm=self.wavelength_nm[k],
            angle_deg=self.angle_deg[a],
            cell_index=self.cell_index[s],
            cell_nm=self.cell_nm[s],
            exit_index=self.exit_index[s],
        )

    def layers(self, structure: int) -> tuple[Complex128, Float64]:
        """Return a structure written out: indices with outside and exit (m·cells + 2,), thicknesses in nm."""
        inside = np.tile(self.cell_index[structure], self.cells)
        indices = np.concatenate([[self.outside_ior], inside, [self.exit_index[structure]]])
        return indices.astype(np.complex128), np.tile(self.cell_nm[structure], self.cells)

    def truth(self) -> NDArray[Any]:
        """Return the reflectances to 50 digits, (s, a, k) objects; a millisecond each."""
        answer = np.zeros(self.shape, dtype=object)
        for s, a, k in np.ndindex(*self.shape):
            first, *second = zip(self.cell_index[s].tolist(), self.cell_nm[s].tolist(), strict=True)
            where = float(self.wavelength_nm[k]), float(self.cos_theta[a])
            if second:  # the exit medium of a mirror is its n1
                (n1, d1), (n2, d2) = first, second[0]
                powers = mirror_50_digits(self.outside_ior, n1, n2, d1, d2, self.cells, *where)
            else:
                media = [self.outside_ior, first[0], complex(self.exit_index[s])]
                powers = stack_50_digits(media, [first[1]], *where)
            answer[s, a, k] = powers.reflected
        return answer


def error_max_abs(values: NDArray[np.float64], truth: NDArray[Any]) -> float:
    """Return max |value − truth|, NaN where a value is; the differences are taken before they are rounded."""
    differences = [float(abs(t - float(v))) for v, t in zip(values.flat, truth.flat, strict=True)]
    return float(np.max(differences))


def _spread(length: int, wanted: int) -> NDArray[np.intp]:
    return np.unique(np.rint(np.linspace(0, length - 1, min(wanted, length))).astype(np.intp))


def _film(name: str, about: str, film: complex, exit_index: complex, **more: Any) -> Workload:
    return _grid(name, about, "W1", [film], [400.0], 1, exit_index, **more)


def _mirror(name: str, about: str, cells: int, n2: complex, **more: Any) -> Workload:
    n1 = more.get("outside_ior", 1.0)
    alike: Alike = "W3" if cells < 100 else "W4"
    return _grid(name, about, alike, [n1, n2], [315.0, 315.0], cells, n1, **more)


def _grid(
    name: str,
    about: str,
    alike: Alike,
    indices: list[complex],
    films_nm: list[float],
    cells: int,
    exit_index: complex,
    *,
    outside_ior: float = 1.0,
    targets: tuple[tuple[str, float], ...] = (),
) -> Workload:
    return Workload(
        name,
        about,
        alike,
        np.arange(360.0, 831.0),
        np.linspace(0.0, 89.0, 91),
        outside_ior,
        np.array([indices], dtype=np.complex128),
        np.array([films_nm]),
        cells,
        np.array([exit_index], dtype=np.complex128),
        targets,
    )


def _many_mirrors() -> Workload:
    g = np.random.default_rng(0)
    count = 10_000
    n2, d1_nm, d2_nm = (g.uniform(low, high, count) for low, high in ((1.3, 2.5), (100, 500), (100, 500)))
    n1 = np.ones(count, dtype=np.complex128)
    return Workload(
        "W5",
        "10,000 mirrors of 10 cells, one angle",
        "W5",
        np.linspace(380.0, 780.0, 81),
        np.array([30.0]),
        1.0,
        np.stack([n1, n2], axis=1),
        np.stack([d1_nm, d2_nm], axis=1),
        10,
        n1,
        (("numpy", 200.0), ("numba", 1000.0)),
    )


def _targets(numpy: float, numba: float) -> dict[str, Any]:
    return {"targets": (("numpy", numpy), ("numba", numba))}


WORKLOADS: Final[dict[str, Workload]] = {
    each.name: each
    for each in (
        _film("W1", "film 1.3 of 400 nm on 1.5", 1.3, 1.5, **_targets(35.0, 300.0)),
        _film("W2", "film 1.3 of 400 nm on the metal 1.1 + 1.5i", 1.3, 1.1 + 1.5j, **_targets(45.0, 400.0)),
        _mirror("W3", "10 cells of 1.0 and 1.5, 315 nm each", 10, 1.5, **_targets(150.0, 1000.0)),
        _mirror("W4", "the same, 200 cells", 200, 1.5, **_targets(2000.0, 15_000.0)),
        _many_mirrors(),
        _film("lossy-film", "film 1.5 + 0.1i of 400 nm on the metal 1.1 + 1.5i", 1.5 + 0.1j, 1.1 + 1.5j),
        _film("tir-film", "gap of 400 nm between 1.5 and 1.5", 1.0, 1.5, outside_ior=1.5),
        _mirror("lossy-cells", "200 cells of 1.0 and 1.5 + 0.01i", 200, 1.5 + 0.01j),
        _mirror("tir-cells", "10 cells of 1.5 and 1.0 under 1.5", 10, 1.0, outside_ior=1.5),
    )
}
