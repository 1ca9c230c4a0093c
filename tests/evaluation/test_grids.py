"""`spectral-grid` and `yeh-grid`: trapezoidal sums of exact reflectances over evenly spaced wavelengths."""

from __future__ import annotations

import numpy as np
import pytest
from tmm import unpolarized_RT

from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.colour.spaces import Light
from gltf_iri.colour.tables import import_colour_science
from gltf_iri.colour.wavelength_grid import grid_rule
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_dispersion, base_from_f0, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate

SAMPLES = (3, 4, 16, 31, 100, 471)


@pytest.mark.parametrize("white", ["D65", "E", Light("red", lambda nm: nm / 500.0)])
@pytest.mark.parametrize("samples", SAMPLES)
def test_white_is_white_on_every_grid(samples: int, white: str) -> None:
    assert grid_rule(samples, white).weights.sum(axis=0) == pytest.approx([1.0, 1.0, 1.0], abs=1e-13)
    film = Film.of(0.4, 300.0, 1.4, base_from_f0(np.ones(3)))
    assert evaluate("spectral-grid", film, white=white, parameters={"samples": samples}).rgb == pytest.approx(
        np.ones(3), abs=1e-13
    )


def test_colour_is_the_sum_that_colour_science_and_tmm_give() -> None:
    """47 wavelengths 10 nm apart, in another package's spectra, trapezoid and white; no code of ours."""
    colour = import_colour_science()
    nm = np.arange(360.0, 831.0, 10.0)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    power = colour.SDS_ILLUMINANTS["D65"]
    held = np.array([power[min(each, 780.0)] for each in nm])
    reflectance = np.array(
        [unpolarized_RT([1.0, 1.33, 1.8], [np.inf, 420.0, np.inf], np.arccos(0.6), each)["R"] for each in nm]
    )
    seen = np.array([observer[each] for each in nm]) * held[:, None]
    xyz = np.trapezoid(reflectance[:, None] * seen, nm, axis=0) / np.trapezoid(seen, nm, axis=0)
    space = colour.RGB_COLOURSPACES["sRGB"]
    white = colour.xy_to_XYZ(space.whitepoint)
    theirs = np.linalg.solve(space.matrix_RGB_to_XYZ, xyz * white)
    # 360 nm to 830 nm in steps of 10 nm.
    rgb = evaluate(
        "spectral-grid", Film.of(0.6, 420.0, 1.33, base_from_ior(1.8)), parameters={"samples": 48}
    ).rgb
    # The primaries' own rounding: sRGB's matrix in colour-science has four to seven digits.
    assert rgb == pytest.approx(theirs, abs=2e-4)


@pytest.mark.parametrize(
    ("grid", "truth", "subject"),
    [("spectral-grid", "spectral", film_set(100)), ("yeh-grid", "yeh-spectral", mirror_set(5, 30))],
)
def test_finer_grids_come_nearer_to_the_truth(grid: str, truth: str, subject: Film | Mirror) -> None:
    exact = evaluate(truth, subject).rgb
    errors = [
        np.abs(evaluate(grid, subject, parameters={"samples": n}).rgb - exact).mean()
        for n in (8, 16, 31, 95, 471)
    ]
    assert np.all(np.diff(errors) < 0.0)
    assert errors[-1] < 2e-4


def test_each_channel_has_its_base_and_each_wavelength_its_index() -> None:
    coloured = evaluate("spectral-grid", Film.of(0.7, 400.0, 1.4, base_from_f0([0.1, 0.5, 0.9]))).rgb
    for channel, f0 in enumerate((0.1, 0.5, 0.9)):
        grey = evaluate("spectral-grid", Film.of(0.7, 400.0, 1.4, base_from_f0([f0] * 3))).rgb
        assert coloured[channel] == pytest.approx(grey[channel], abs=1e-14)
    film = Film.of(
        0.7, 400.0, lambda nm: 1.4 + 5e3 / nm**2, base_from_dispersion(lambda nm: 0.2 + nm * 5e-3j)
    )
    finest = evaluate("spectral-grid", film, parameters={"samples": 471}).rgb
    assert finest == pytest.approx(evaluate("spectral", film).rgb, abs=5e-5)


def test_fine_fringes_alias() -> None:
    """What a fixed grid cannot do: 60 µm look coloured to 31 wavelengths, and are grey."""
    film = Film.of(1.0, 60_000.0, 1.5, base_from_ior(2.5))
    assert np.ptp(evaluate("spectral-grid", film).rgb) > 20.0 * np.ptp(evaluate("spectral", film).rgb)


def test_wavelengths_that_see_nothing_of_a_light_are_refused() -> None:
    line = Light("a narrow line", lambda nm: np.where(np.abs(nm - 500.0) < 5.0, 1.0, 0.0))
    with pytest.raises(UsageError, match="3 wavelengths"):
        evaluate(
            "spectral-grid",
            Film.of(1.0, 300.0, 1.4, base_from_ior(1.5)),
            white=line,
            parameters={"samples": 3},
        )
