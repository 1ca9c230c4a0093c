"""Colour tables, sensitivities, differences, quadrature."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.observer import colour_matching, illuminant
from gltf_iri.colour.quadrature import colour_density, colour_rule
from gltf_iri.colour.sensitivity import GAUSSIANS, SENSITIVITY_WHITE, eval_sensitivity
from gltf_iri.colour.spaces import rec709_to_xyz, xyz_to_rec709
from gltf_iri.colour.tables import import_colour_science


def test_observer_is_colour_sciences() -> None:
    observer = import_colour_science().MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    assert np.array_equal(colour_matching(observer.wavelengths), observer.values)
    assert observer.wavelengths[[0, -1]].tolist() == [360.0, 830.0]


def test_d65_is_colour_sciences_and_its_last_value_is_held() -> None:
    d65 = import_colour_science().SDS_ILLUMINANTS["D65"]
    assert np.array_equal(illuminant(d65.wavelengths, "D65"), d65.values)
    assert illuminant(830.0, "D65") == d65.values[-1]
    assert illuminant(362.5, "D65") == pytest.approx((d65[360] + d65[365]) / 2, rel=1e-15)


def test_nothing_is_seen_outside_the_table() -> None:
    assert not np.any(colour_matching([359.9, 830.1]))


def test_unit_free_sensitivity_has_the_known_constants() -> None:
    """Amplitudes, wavelengths and decay lengths computed apart from the text's SI constants."""
    expected = [
        (0.84659, 594.884, 2419.28),
        (1.00022, 557.010, 1649.95),
        (1.00112, 452.817, 1957.27),
        (0.15387, 446.449, 2365.1),
    ]
    found = [(g.amplitude, g.wavelength_nm, g.length_nm) for g in GAUSSIANS]
    assert np.allclose(found, expected, rtol=2e-5, atol=0.0)


def test_sensitivities_white_is_not_the_constant_terms() -> None:
    assert np.allclose(SENSITIVITY_WHITE, (1.20537, 0.94832, 0.91001), rtol=0.0, atol=1e-5)
    assert np.array_equal(eval_sensitivity(0.0, np.zeros(3)), SENSITIVITY_WHITE)


def test_half_turn_of_phase_turns_the_fringe_over() -> None:
    opd_nm = np.linspace(0.0, 3000.0, 31)
    turned = eval_sensitivity(opd_nm, np.full(3, np.pi))
    assert np.abs(turned + eval_sensitivity(opd_nm, np.zeros(3))).max() <= 1e-14


def test_matrix_and_its_inverse_cancel() -> None:
    rgb = np.random.default_rng(0).uniform(-1, 2, (50, 3))
    assert np.abs(xyz_to_rec709(rec709_to_xyz(rgb)) - rgb).max() <= 1e-13


@pytest.mark.parametrize("white", ["D65", "E"])
def test_doubled_rule_repeats_its_nodes(white: str) -> None:
    for degree in (32, 64, 128):
        coarse, fine = colour_rule(degree, white), colour_rule(2 * degree, white)
        assert np.array_equal(coarse.wavelength_nm, fine.wavelength_nm[::2])
    assert coarse.wavelength_nm[[0, -1]] == pytest.approx([360.0, 830.0], rel=1e-15)


@pytest.mark.parametrize("white", ["D65", "E"])
@pytest.mark.parametrize("power", [0, 1, 5, 20])
def test_rule_is_exact_for_polynomials_in_wavenumber(white: str, power: int) -> None:
    rule = colour_rule(32, white)
    # Gauss–Legendre on every nanometre, ten points: exact far beyond what is compared.
    nodes, gauss = np.polynomial.legendre.leggauss(10)
    wavelength_nm = (np.arange(360, 830)[:, None] + 0.5 + 0.5 * nodes).reshape(-1)
    weights = colour_density(wavelength_nm, white) * np.tile(0.5 * gauss, 470)[:, None]
    expected = (500.0 / wavelength_nm) ** power @ weights
    assert np.abs((500.0 / rule.wavelength_nm) ** power @ rule.weights - expected).max() <= 1e-12


def test_equal_colours_do_not_differ_and_negative_channels_count_as_black() -> None:
    rgb = np.random.default_rng(0).uniform(0, 1.5, (20, 3))
    assert not np.any(delta_e_2000(rgb, rgb))
    assert delta_e_2000([-0.5, 0.2, 0.1], [0.0, 0.2, 0.1]) == 0.0
    assert delta_e_2000([1.2, 1.2, 1.2], [1.0, 1.0, 1.0]) > 1.0


def test_greys_differ_by_lightness_alone() -> None:
    """ΔE00 of two greys is |ΔL*|/S_L with S_L = 1 + 0.015(L̄ − 50)²/√(20 + (L̄ − 50)²)."""
    dark, light = 0.18, 0.20
    l_1, l_2 = (116.0 * np.cbrt(y) - 16.0 for y in (dark, light))
    middle = (0.5 * (l_1 + l_2) - 50.0) ** 2
    expected = (l_2 - l_1) / (1.0 + 0.015 * middle / np.sqrt(20.0 + middle))
    assert delta_e_2000([dark] * 3, [light] * 3) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize(
    ("lab_a", "lab_b", "expected"),
    [  # Sharma, Wu & Dalal 2005, Table 1: pairs 1, 7, 17, 25 and 34
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 0.0, 0.0), (50.0, -1.0, 2.0), 2.3669),
        ((50.0, 2.5, 0.0), (73.0, 25.0, -18.0), 27.1492),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
    ],
)
def test_published_pairs(lab_a: tuple[float, ...], lab_b: tuple[float, ...], expected: float) -> None:
    """Pairs outside Rec.709 lose their negative channels; those inside come out as printed."""
    rgb = [lab_to_rec709(np.array(lab)) for lab in (lab_a, lab_b)]
    theirs = float(import_colour_science().delta_E(lab_a, lab_b, method="CIE 2000"))
    assert theirs == pytest.approx(expected, abs=5e-5)
    if np.min(rgb) >= 0.0:
        assert delta_e_2000(*rgb) == pytest.approx(expected, abs=5e-4)


def lab_to_rec709(lab: np.ndarray) -> np.ndarray:
    f_y = (lab[0] + 16.0) / 116.0
    f = np.array([f_y + lab[1] / 500.0, f_y, f_y - lab[2] / 200.0])
    ratio = np.where(f > 6.0 / 29.0, f**3, 3.0 * (6.0 / 29.0) ** 2 * (f - 4.0 / 29.0))
    return xyz_to_rec709(ratio * rec709_to_xyz(np.ones(3)))
