"""On the real axis F is the transmittance; above it, that seen through a Lorentzian, and poles."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.mirror_set import low_contrast_set, mirror_set
from gltf_iri.colour.wavenumber_rule import wavenumber_rule
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.bloch import BlochCell, gap_poles, shifted_reflectance
from gltf_iri.optics.bragg_cell import film_optics, host_optics

RULE = wavenumber_rule(16, "D65")
GRID = RULE.wavenumber_per_nm


def cell_of(mirror: Mirror) -> BlochCell:
    host, n1, cosine = mirror.host_ior, mirror.n1.real, mirror.cos_theta_h
    films = film_optics(host, n1, mirror.n2.real, mirror.d1_nm, mirror.d2_nm, cosine)
    return BlochCell.of(films, host_optics(host, n1, cosine), mirror.shape, RULE.step_per_nm)


def transmittance(mirror: Mirror, wavenumber_per_nm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (2, rows, k), s and p, by powers of the cell's characteristic matrix."""
    n1, n2, host, c, d1, d2 = (
        np.broadcast_to(a, mirror.shape).reshape(-1, 1)
        for a in (
            mirror.n1.real,
            mirror.n2.real,
            mirror.host_ior,
            mirror.cos_theta_h,
            mirror.d1_nm,
            mirror.d2_nm,
        )
    )
    result = []
    for is_p in (False, True):
        q_h = host * c
        q_1, q_2 = (np.sqrt(n * n - host * host + q_h * q_h) for n in (n1, n2))
        y_h, y_1, y_2 = (q / (n * n if is_p else 1.0) for q, n in ((q_h, host), (q_1, n1), (q_2, n2)))
        cell = np.eye(2)
        for y, path in ((y_1, q_1 * d1), (y_2, q_2 * d2)):
            phase = 2.0 * np.pi * path * wavenumber_per_nm
            rows = [[np.cos(phase), -1j * np.sin(phase) / y], [-1j * y * np.sin(phase), np.cos(phase)]]
            cell = cell @ np.moveaxis(np.array(rows), (0, 1), (-2, -1))
        m = np.linalg.matrix_power(cell, int(mirror.cells.max()))
        total = y_h * m[..., 0, 0] + y_h * y_1 * m[..., 0, 1] + m[..., 1, 0] + y_1 * m[..., 1, 1]
        result.append(4.0 * y_h * y_1 / np.abs(total) ** 2)
    return np.array(result)


MIRRORS = {
    "1 cell": mirror_set(1, 6),
    "5 cells": mirror_set(5, 6),
    "8 cells under a host": low_contrast_set(8, 6),
    "3 cells under a heavier host": Mirror.of(np.linspace(0.8, 1.0, 4), 1.3, 2.1, 150.0, 230.0, 3, 1.8),
}


@pytest.mark.parametrize("name", MIRRORS)
def test_on_the_real_axis_it_is_what_the_mirror_reflects(name: str) -> None:
    mirror = MIRRORS[name]
    cells = np.broadcast_to(mirror.cells, mirror.shape)
    height = 1e-13  # 1/nm, 10⁻⁹ of the grid's step
    nearly = shifted_reflectance(cell_of(mirror), cells, GRID, height)
    # A pole iρ/δ nearby adds ρ/δ to Im Q, and ρ a/δ² = a (Im Q)²/ρ to Re Q; ρ is some 1e-4 / nm.
    allowed = 1e-6 + 1e5 * height * nearly.imag**2
    assert np.all(np.abs(nearly.real - (1.0 - transmittance(mirror, GRID))) <= allowed)


@pytest.mark.parametrize("name", MIRRORS)
def test_above_it_reflectance_is_seen_through_a_lorentzian_less_the_poles(name: str) -> None:
    # ∫ R(ν') a/π/((ν − ν')² + a²) dν' over ν' in (−∞, ∞), with ν' = ν + a tan t and R even in ν'.
    mirror, height = MIRRORS[name], 4e-5
    cells = np.broadcast_to(mirror.cells, mirror.shape)
    middle = GRID[7]
    angle = (np.arange(20_000) + 0.5) / 20_000 * np.pi - 0.5 * np.pi
    seen = middle + height * np.tan(angle)
    near = np.abs(seen) < 0.4  # beyond, the Lorentzian holds 6e-5 of all
    smoothed = (1.0 - transmittance(mirror, np.abs(seen[near]))).mean(axis=-1).sum(axis=0)
    # Poles up to the same bound, on a grid of their own; T is even, and so are they.
    wide = np.linspace(1e-5, 0.4, 1 + int(0.4 / RULE.step_per_nm) * 2)
    rows, place, strength = gap_poles(cell_of(mirror), cells, wide)
    step = wide[1] - wide[0]
    at = wide[0] + step * place
    lorentzians = sum(
        step * strength * height / ((middle - sign * at) ** 2 + height**2) for sign in (1.0, -1.0)
    )
    poles = np.bincount(rows, lorentzians, minlength=len(cells))
    shifted = shifted_reflectance(cell_of(mirror), cells, GRID[7:8], height).real.sum(axis=(0, 2))
    assert np.abs(shifted + poles - smoothed).max() <= 2e-3


def test_a_gaps_pole_is_as_strong_as_its_area() -> None:
    # ρ = Z τ/b′ with b′ = 2π·300 nm: of many cells that is the gap's half width, of few N times as much less.
    for cells, rise in ((20, 1e-4), (10**5, 1e-3)):
        mirror = Mirror.of([1.0], 1.5, 1.5 + rise, 100.0, 100.0, cells)
        _, place, strength = gap_poles(cell_of(mirror), np.array([cells]), GRID)
        contrast = rise / 1.5
        assert GRID[0] + RULE.step_per_nm * place == pytest.approx(np.full(2, 1.0 / 600.0), rel=1e-3)
        width = contrast * min(1.0, cells * contrast) / (2.0 * np.pi * 300.0)
        assert strength * RULE.step_per_nm == pytest.approx(np.full(2, width), rel=5e-3)


def test_brewsters_angle_and_equal_films_have_no_poles() -> None:
    mirror = Mirror.of([1.0, 0.5], 1.4, 1.4, 200.0, 250.0, 50)
    _, _, strength = gap_poles(cell_of(mirror), np.array([50, 50]), GRID)
    assert len(strength) > 0
    assert np.abs(strength).max() == 0.0


def test_the_rules_weights_see_white_as_white_and_fringes_as_the_eye_does() -> None:
    rule = wavenumber_rule(32, "E")
    assert np.abs(rule.weights[0].sum(axis=0) - 1.0).max() <= 1e-12
    assert rule.gap_weights[0] == pytest.approx(np.zeros(3), abs=2e-3)
    assert rule.gap_weights[-1] == pytest.approx(np.zeros(3), abs=2e-3)
