"""Limits, poles, edges and extremes: right, in range and without a warning, in float64 and in GLSL."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hard_cases import CASES, Case, FilmCase, MirrorCase, measure, measure_glsl

from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.film import film_reflectance
from gltf_iri.optics.stack import stack
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_OPTICS_MAX_ABS

# Beside what one ulp of the wavelength does, which no formula can know better.
FLOAT64_MAX_ABS = 1e-14
ULPS = 4.0

# Steps across a branch, in ulp of the number that is stepped.
STEPS = (-64, -2, -1, 0, 1, 2, 64)
CONTINUITY_FLOAT64 = 1e-12

EACH = pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)


@EACH
def test_float64_is_right_to_its_last_digits(case: Case) -> None:
    measured = measure(case)
    assert measured.error <= FLOAT64_MAX_ABS + ULPS * measured.per_ulp


@pytest.mark.parametrize("case", [case for case in CASES if case.glsl()], ids=lambda case: case.name)
def test_glsl_is_right_to_what_float32_leaves(case: Case, probe: Probe) -> None:
    """GLSL has no function for films and cells that absorb."""
    measured = measure_glsl(case, probe)
    assert measured is not None
    assert np.all((measured.reflectance >= 0.0) & (measured.reflectance <= 1.0))
    assert measured.error <= GLSL_OPTICS_MAX_ABS + ULPS * measured.per_ulp


@EACH
def test_nothing_is_lost_or_won(case: Case) -> None:
    """R + T + A = 1, A being what the waves leave in the films, and each share within 0 and 1."""
    R, T, A = case.powers()
    assert np.abs(R + T + A - 1.0).max() <= 1e-12
    for share in (R, T, A):
        assert np.all((share >= -1e-15) & (share <= 1.0 + 1e-15))
    reflectance = case.reflectance()
    assert np.all((reflectance >= 0.0) & (reflectance <= 1.0))


@pytest.mark.parametrize("name", ["absorbing film, 10⁴ wavelengths", "metal film, 10⁴ wavelengths"])
def test_a_thick_absorber_takes_all_that_it_does_not_reflect(name: str) -> None:
    R, T, A = next(case for case in CASES if case.name == name).powers()
    assert np.all(T == 0.0)
    assert np.abs(A - (1.0 - R)).max() <= 1e-12


def branches() -> Iterator[tuple[str, Case]]:
    """Cases, and around what number of theirs a formula might switch: (field, value) in the case itself."""
    critical = float(np.sqrt(1.0 - (1.2 / 1.5) ** 2))
    yield "cosine", FilmCase("critical angle of the film", 1.2, 1.5, 400.0, critical, 1.5)
    yield "cosine", FilmCase("critical angle of the base", 1.4, 1.2, 400.0, critical, 1.5)
    yield "cosine", FilmCase("critical angle, 1 mm", 1.2, 1.5, 1e6, critical, 1.5)
    yield "film", FilmCase("film = base", 1.5, 1.5, 400.0)
    yield "film", FilmCase("film = outside", 1.0, 1.5, 400.0)
    yield "base", FilmCase("base begins to absorb", 1.3, 1.5, 400.0)
    yield "cosine", FilmCase("flat light", 1.3, 1.5, 400.0, 1e-40)
    yield "thickness_nm", FilmCase("a quarter wave", 1.0, 1.5, 112.5, 1.0)
    yield "cosine", MirrorCase("critical angle of n2", 10, 1.5, 1.2, 315.0, 315.0, critical, 1.5)
    yield "n2", MirrorCase("n2 = n1", 10, n2=1.0)
    yield "host", MirrorCase("host = n1", 10)
    yield "cosine", MirrorCase("Brewster", 10, cosine=float(1.0 / np.sqrt(1.0 + 1.5**2)))
    for case in CASES:
        if case.name in ("band edge, N = 10", "band edge, N = 10³", "band centre, N = 10"):
            yield "wavelengths_nm", case


def stepped(case: Case, field: str, steps: int, number: type) -> Case:
    """The case with one of its numbers some ulp away, complex ones in their real part."""

    def away(value: float) -> float:
        return float(number(value) + number(steps) * np.spacing(number(value)))

    value = getattr(case, field)
    if field == "wavelengths_nm":
        return replace(case, wavelengths_nm=tuple(away(w) for w in value))
    is_complex = isinstance(value, complex)
    return replace(case, **{field: complex(away(value.real), value.imag) if is_complex else away(value)})


BRANCHES = pytest.mark.parametrize(
    ("field", "case"), list(branches()), ids=lambda value: getattr(value, "name", "")
)


@BRANCHES
def test_float64_is_continuous_across_branches(field: str, case: Case) -> None:
    """Against 50 digits on either side, where what is exact may itself run steeply."""
    errors = [measure(stepped(case, field, steps, np.float64)) for steps in STEPS]
    assert max(e.error - ULPS * e.per_ulp for e in errors) <= CONTINUITY_FLOAT64


@BRANCHES
def test_glsl_is_continuous_across_branches(field: str, case: Case, probe: Probe) -> None:
    measured = [measure_glsl(stepped(case, field, steps, np.float32), probe) for steps in STEPS]
    assert max(m.error - ULPS * m.per_ulp for m in measured if m is not None) <= GLSL_OPTICS_MAX_ABS


def test_absorption_begins_continuously() -> None:
    """From k = 0, where formulas take real numbers, to the smallest k, where they take complex ones."""
    wavelengths = np.linspace(400.0, 700.0, 61)
    for k in (5e-324, 1e-300, 1e-17):
        film = (film_reflectance(1.0, 1.3, 1.5 + 1j * i, 400.0, wavelengths, 0.6) for i in (0.0, k))
        assert np.abs(np.subtract(*film)).max() <= CONTINUITY_FLOAT64
        cells = (
            bragg_reflectance(1.0, 1.0, 1.5 + 1j * i, 315.0, 315.0, 10, wavelengths, 0.6) for i in (0.0, k)
        )
        assert np.abs(np.subtract(*cells)).max() <= CONTINUITY_FLOAT64


@pytest.mark.parametrize("place", range(6))
def test_nan_in_is_nan_out(place: int) -> None:
    film = [1.0, 1.3, 1.5, 400.0, 550.0, 0.6]
    film[place] = np.nan
    assert np.isnan(film_reflectance(*film))
    mirror = [1.0, 1.2, 1.5, 315.0, 315.0, 550.0, 0.6]
    mirror[place if place < 5 else 6] = np.nan
    assert np.isnan(bragg_reflectance(*mirror[:5], 10, *mirror[5:]))
    outside, index, base, nm, wavelength_nm, cosine = film
    layers = stack((outside, index, base), (nm,), wavelength_nm, cosine)
    assert np.isnan(layers.R_s) and np.isnan(layers.R_p)


def test_the_notes_name_every_case() -> None:
    notes = (Path(__file__).resolve().parents[2] / "spec" / "optics-notes.md").read_text(encoding="utf-8")
    section = notes.split("<!-- hard -->")[1].split("<!-- /hard -->")[0]
    named = [line.split("|")[1].strip() for line in section.splitlines() if line.startswith("| ")][1:]
    assert named == [case.name for case in CASES]
