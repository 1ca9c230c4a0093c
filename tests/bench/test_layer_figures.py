"""Figures of layered mirrors: their printed parameters, and that each kind of picture can be drawn."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "spec" / "figures"


@pytest.fixture
def layers(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    if not SCRIPTS.is_dir():
        pytest.skip("the figures' scripts belong to a checkout")
    monkeypatch.syspath_prepend(SCRIPTS)
    return importlib.import_module("fourneau_layers")


def test_figures_of_lines_and_directions_are_drawn(layers: ModuleType, tmp_path: Path) -> None:
    layers.main(tmp_path, (6, 9), 8)
    assert (tmp_path / "fourneau-6.png").stat().st_size > 1000
    assert (tmp_path / "fourneau-9.webp").stat().st_size > 1000


def test_spheres_are_drawn_by_either_way(
    layers: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(layers, "FIGURE_7", {"A on black": layers.FIGURE_7["A on black"]})
    monkeypatch.setattr(layers.spheres, "ALPHAS_8", (0.1,))
    layers.main(tmp_path, (7, 8), 12)
    for number in (7, 8):
        assert (tmp_path / f"fourneau-{number}.webp").stat().st_size > 500


def test_parameters_are_the_printed_ones(layers: ModuleType) -> None:
    spheres = layers.spheres
    angles = [np.pi / 32.0, np.pi / 4.0, 7.0 * np.pi / 16.0]
    assert list(layers.ANGLES_6.values()) == angles
    assert [layers.AREAS[area] for area in layers.AREAS] == [
        (1.59, 1.67, 160.0, 0.51, 8),
        (1.60, 1.68, 190.0, 0.51, 8),
        (1.60, 1.68, 205.0, 0.51, 6),
    ]
    assert layers.ALPHA_9 == 0.05
    assert layers.CIRCLES_DEG == (5.0, 30.0, 60.0, 90.0)
    coated = layers.FIGURE_7["A' on ρ 0.5"]
    assert float(coated.host_ior) == float(coated.layers[0].n1) == 1.35
    assert set(np.diff(spheres.PERIODS_10)) == {30.0}
    assert spheres.TOP_12 == (141.0, 329.0, 3)
    assert spheres.BOTTOM_12 == (98.0, 882.0, 10)


def test_a_layer_of_the_renderer_has_the_thicknesses_that_it_was_given(layers: ModuleType) -> None:
    made = layers.spheres.layer(1.0, 1.5, 98.0, 882.0, 10, 0.1)
    assert made.fill * made.period_max_nm == pytest.approx(98.0)
    assert (1.0 - made.fill) * made.period_max_nm == pytest.approx(882.0)
    assert made.roughness**2 == pytest.approx(0.1)


def test_a_white_sky_on_the_cuticle_is_what_converges(layers: ModuleType) -> None:
    at = np.array([1.0, 0.7, 0.4])
    coarse, fine = (layers.white_sky("green/blue (a)", at, turns=n) for n in (48, 96))
    np.testing.assert_allclose(coarse, fine, atol=2e-4)
    # Facets so smooth hardly average: near the smooth mirror's own colour, spec/optics-notes.md at 0°.
    np.testing.assert_allclose(fine[0], [0.0624, 0.0817, 0.0645], atol=2e-3)
