"""Films and mirrors at which formulas break: limits, poles, edges, and sizes that overflow.

`python tests/hard/hard_cases.py` prints the table between <!-- hard --> and <!-- /hard --> in
spec/optics-notes.md, measured anew on the machine at hand.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.fifty_digits import mirror_50_digits, stack_50_digits
from gltf_iri.optics.bragg import bragg_powers, bragg_reflectance
from gltf_iri.optics.film import film_reflectance
from gltf_iri.optics.stack import stack

__all__ = ["CASES", "Case", "FilmCase", "Measured", "MirrorCase", "measure", "measure_glsl"]

Float64 = NDArray[np.float64]

TINY = 5e-324
WAVELENGTHS_NM = (450.0, 555.5, 650.25)


@dataclass(frozen=True)
class FilmCase:
    """A film on a base, as `optics/film` and `optics/stack` know it."""

    name: str
    film: complex
    base: complex
    thickness_nm: float
    cosine: float = 0.6
    outside: float = 1.0
    wavelengths_nm: tuple[float, ...] = WAVELENGTHS_NM

    def single(self) -> FilmCase:
        """The film that float32 holds."""
        return replace(
            self,
            film=complex(np.complex64(self.film)),
            base=complex(np.complex64(self.base)),
            thickness_nm=float(np.float32(self.thickness_nm)),
            cosine=float(np.float32(self.cosine)),
            outside=float(np.float32(self.outside)),
            wavelengths_nm=tuple(float(np.float32(w)) for w in self.wavelengths_nm),
        )

    def exact(self, wavelength_nm: float) -> float:
        indices = (self.outside, self.film, self.base)
        return float(stack_50_digits(indices, (self.thickness_nm,), wavelength_nm, self.cosine).reflected)

    def reflectance(self) -> Float64:
        wavelengths = np.array(self.wavelengths_nm)
        if self.film.imag:  # `optics/film` is for films that absorb nothing
            return self.powers()[0]
        return film_reflectance(
            self.outside, self.film.real, self.base, self.thickness_nm, wavelengths, self.cosine
        )

    def powers(self) -> tuple[Float64, Float64, Float64]:
        """Return R, T, A, the means of both polarisations."""
        indices = (self.outside, self.film, self.base)
        r = stack(indices, (self.thickness_nm,), np.array(self.wavelengths_nm), self.cosine)
        absorbed = 0.5 * (r.absorbed_s + r.absorbed_p).sum(axis=0)
        return 0.5 * (r.R_s + r.R_p), 0.5 * (r.T_s + r.T_p), absorbed

    def glsl(self) -> tuple[str, str, list[Any]] | None:
        if self.film.imag:
            return None
        numbers = (self.outside, self.film.real, self.base.real, self.base.imag, self.thickness_nm)
        return "film_reflectance", "optics/film.glsl", [*numbers, np.array(self.wavelengths_nm), self.cosine]


@dataclass(frozen=True)
class MirrorCase:
    """A mirror, as `optics/bragg` knows it."""

    name: str
    cells: int
    n1: complex = 1.0
    n2: complex = 1.5
    d1_nm: float = 315.0
    d2_nm: float = 315.0
    cosine: float = 0.6
    host: float = 1.0
    wavelengths_nm: tuple[float, ...] = WAVELENGTHS_NM

    def single(self) -> MirrorCase:
        """The mirror that float32 holds."""
        numbers = {key: float(np.float32(getattr(self, key))) for key in ("d1_nm", "d2_nm", "cosine", "host")}
        return replace(
            self,
            n1=complex(np.complex64(self.n1)),
            n2=complex(np.complex64(self.n2)),
            wavelengths_nm=tuple(float(np.float32(w)) for w in self.wavelengths_nm),
            **numbers,
        )

    def exact(self, wavelength_nm: float) -> float:
        arguments = (self.host, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells)
        return float(mirror_50_digits(*arguments, wavelength_nm, self.cosine).reflected)

    def reflectance(self) -> Float64:
        arguments = (self.host, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells)
        return bragg_reflectance(*arguments, np.array(self.wavelengths_nm), self.cosine)

    def powers(self) -> tuple[Float64, Float64, Float64]:
        arguments = (self.host, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells)
        p = bragg_powers(*arguments, np.array(self.wavelengths_nm), self.cosine)
        return 0.5 * (p.R_s + p.R_p), 0.5 * (p.T_s + p.T_p), 0.5 * (p.A_s + p.A_p)

    def glsl(self) -> tuple[str, str, list[Any]] | None:
        if self.n1.imag or self.n2.imag:
            return None
        numbers = [self.host, self.n1.real, self.n2.real, self.d1_nm, self.d2_nm, float(self.cells)]
        return (
            "bragg_reflectance",
            "optics/bragg.glsl",
            [*numbers, np.array(self.wavelengths_nm), self.cosine],
        )


Case = FilmCase | MirrorCase

# At normal incidence cos KΛ = cos a cos b − ½(X + 1/X) sin a sin b with a = k₁d₁, b = k₂d₂ and X = n₂/n₁.
_QUARTER = MirrorCase("", 1, d1_nm=150.0, d2_nm=100.0, cosine=1.0)  # both films a quarter of 600 nm
# The first gap's edges of the quarter-wave mirror: cos²φ = (X − 1)²/(X + 1)² at φ = ½π · 600 nm/λ.
_EDGE_NM = float(0.5 * np.pi * 600.0 / np.arccos(0.2))
_BREWSTER = float(1.0 / np.sqrt(1.0 + 1.5**2))

CASES: tuple[Case, ...] = (
    FilmCase("grazing, cos θ = 0", 1.3, 1.5, 400.0, 0.0),
    FilmCase("grazing, cos θ = 0, on metal", 1.3, 1.1 + 1.5j, 400.0, 0.0),
    FilmCase("nearly grazing, cos θ = 1e-8", 1.3, 1.5, 400.0, 1e-8),
    FilmCase("nearly grazing, cos θ = 1e-8, on metal", 1.3, 1.1 + 1.5j, 400.0, 1e-8),
    FilmCase("straight on, cos θ = 1", 1.3, 1.5, 400.0, 1.0),
    FilmCase("no thickness", 1.3, 1.5, 0.0),
    FilmCase("thickness 1e-6 nm", 1.3, 1.5, 1e-6),
    FilmCase("thickness 1 mm", 1.3, 1.5, 1e6),
    FilmCase("thickness 1 mm on metal", 1.3, 1.1 + 1.5j, 1e6),
    FilmCase("film = base", 1.5, 1.5, 400.0),
    FilmCase("film = outside", 1.0, 1.5, 400.0),
    FilmCase("nothing at all", 1.0, 1.0, 400.0),
    FilmCase("nothing at all, grazing", 1.0, 1.0, 400.0, 0.0),
    FilmCase("frustrated, 400 nm", 1.0, 1.5, 400.0, 0.5, outside=1.5),
    FilmCase("frustrated, 20 µm", 1.0, 1.5, 2e4, 0.5, outside=1.5),
    FilmCase("total reflection at the base", 1.3, 1.0, 400.0, 0.5, outside=1.5),
    FilmCase("critical angle of the film", 1.2, 1.5, 400.0, 0.6, outside=1.5),
    FilmCase(
        "Brewster, film to base",
        1.3,
        1.5,
        400.0,
        float(np.sqrt(1 - (1.3 * 1.5) ** 2 / (1.3**2 + 1.5**2))),
        1.3,
    ),
    FilmCase("base F0 = 1e-12", 1.3, 1.000002, 400.0),
    FilmCase("base F0 = 1 − 4e-8", 1.3, 1e8, 400.0),
    FilmCase("absorbing film, 10⁴ wavelengths", 1.3 + 0.2j, 1.5, 5.5e6),
    FilmCase("metal film, 10⁴ wavelengths", 0.2 + 3.4j, 1.5, 5.5e6),
    FilmCase("denormal thickness", 1.3, 1.5, TINY),
    FilmCase("denormal cosine", 1.3, 1.5, 400.0, TINY),
    FilmCase("denormal extinction", 1.3, 1.5 + TINY * 1j, 400.0),
    MirrorCase("N = 1", 1),
    MirrorCase("N = 10³", 1000),
    MirrorCase("N = 10⁶", 10**6),
    MirrorCase("N = 10, grazing", 10, cosine=0.0),
    MirrorCase("N = 10, cos θ = 1e-8", 10, cosine=1e-8),
    MirrorCase("N = 10⁶, cos θ = 1e-8", 10**6, cosine=1e-8),
    replace(_QUARTER, name="band centre, N = 10", cells=10, wavelengths_nm=(600.0,)),
    replace(_QUARTER, name="band centre, N = 10⁶", cells=10**6, wavelengths_nm=(600.0,)),
    replace(_QUARTER, name="band edge, N = 10", cells=10, wavelengths_nm=(_EDGE_NM,)),
    replace(_QUARTER, name="band edge, N = 10³", cells=1000, wavelengths_nm=(_EDGE_NM,)),
    replace(_QUARTER, name="band edge, N = 10⁶", cells=10**6, wavelengths_nm=(_EDGE_NM,)),
    MirrorCase("Brewster, all gaps closed", 10, cosine=_BREWSTER),
    MirrorCase("Brewster, N = 10⁶", 10**6, cosine=_BREWSTER),
    MirrorCase("n2 = n1", 10, n2=1.0),
    MirrorCase("n2 = n1 under a host", 10, n1=1.5, n2=1.5),
    MirrorCase("n2 < n1, total reflection inside", 10, 1.5, 1.0, 315.0, 315.0, 0.6, 1.5),
    MirrorCase("n2 < n1, total reflection, 100 nm", 10**6, 1.5, 1.0, 315.0, 100.0, 0.6, 1.5),
    MirrorCase("host denser than n1", 10, 1.2, 1.6, 100.0, 100.0, 0.3, 1.5),
    MirrorCase("no thickness, N = 10⁶", 10**6, d1_nm=0.0, d2_nm=0.0),
    MirrorCase("films of 1 mm", 10, d1_nm=1e6, d2_nm=1e6),
    MirrorCase("denormal thicknesses", 10, d1_nm=TINY, d2_nm=TINY),
    MirrorCase("absorbing cells, N = 10⁶", 10**6, n2=1.5 + 0.01j),
    MirrorCase("gap metals, N = 10³", 1000, n2=0.2 + 3.4j),
)


@dataclass(frozen=True)
class Measured:
    """What one number format makes of a case."""

    reflectance: Float64
    error: float  # against 50 digits
    per_ulp: float  # how far one ulp of the wavelength moves the reflectance


def measure(case: Case) -> Measured:
    """Return what Python's float64 makes of `case`."""
    return _against(case, np.asarray(case.reflectance()), np.float64)


def measure_glsl(case: Case, probe: Any) -> Measured | None:
    """Return what GLSL makes of `case` as float32 holds it; None where it has no function for it."""
    single = case.single()
    call = single.glsl()
    if call is None:
        return None
    function, file, arguments = call
    values = probe.call(function, file, arguments, "float", argument_types=["float"] * len(arguments))
    return _against(single, np.asarray(values, dtype=np.float64), np.float32)


def _against(case: Case, values: Float64, number: type) -> Measured:
    exact = np.array([case.exact(w) for w in case.wavelengths_nm])
    beside = np.array(
        [case.exact(float(np.nextafter(number(w), number(np.inf)))) for w in case.wavelengths_nm]
    )
    return Measured(values, float(np.abs(values - exact).max()), float(np.abs(beside - exact).max()))


def _rows(probe: Any) -> Iterator[str]:
    yield "| case | float64 | one ulp of λ | GLSL float32 | one ulp of λ |"
    yield "|---|---|---|---|---|"
    for case in CASES:
        double, single = measure(case), measure_glsl(case, probe)
        glsl = "– | –" if single is None else f"{single.error:.0e} | {single.per_ulp:.0e}"
        yield f"| {case.name} | {double.error:.0e} | {double.per_ulp:.0e} | {glsl} |"


if __name__ == "__main__":
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.probe import Probe

    sys.stdout.write("\n".join(_rows(Probe(create_context()))) + "\n")
