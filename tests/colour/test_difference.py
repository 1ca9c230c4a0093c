"""Colour differences are those of colour-science, also where the formula turns corners."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from gltf_iri.colour.difference import ciede2000, cielab, delta_e_2000
from gltf_iri.colour.spaces import rec709_to_xyz
from gltf_iri.colour.tables import import_colour_science

CHANNEL = st.floats(-128.0, 128.0)
LAB = st.tuples(st.floats(0.0, 150.0), CHANNEL, CHANNEL)


def of_colour_science(lab_1: NDArray[np.float64], lab_2: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(import_colour_science().delta_E(lab_1, lab_2, method="CIE 2000"))


def test_random_pairs_differ_by_what_colour_science_says() -> None:
    chance = np.random.default_rng(1)
    lab = chance.uniform((0.0, -128.0, -128.0), (150.0, 128.0, 128.0), (2, 20_000, 3))
    np.testing.assert_allclose(ciede2000(*lab), of_colour_science(*lab), rtol=1e-10, atol=1e-10)


def test_close_pairs_differ_by_what_colour_science_says() -> None:
    chance = np.random.default_rng(2)
    lab = chance.uniform((0.0, -128.0, -128.0), (100.0, 128.0, 128.0), (20_000, 3))
    other = lab + chance.normal(0.0, 0.1, lab.shape)
    np.testing.assert_allclose(ciede2000(lab, other), of_colour_science(lab, other), rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("chroma", [0.0, 1e-9, 2.5, 60.0])
def test_hues_on_both_sides_of_every_turn_agree(chroma: float) -> None:
    # 0.7°: no two hues add up to 360° exactly, where rounding would choose the side of a step.
    hue = np.radians(np.arange(0.7, 360.0, 3.0))
    lab = np.stack((50.0 + 0.0 * hue, chroma * np.cos(hue), chroma * np.sin(hue)), axis=-1)
    for turn in (1, 30, 59, 61, 90):
        other = np.roll(lab, turn, axis=0) * [1.0, 1.1, 1.1]
        np.testing.assert_allclose(ciede2000(lab, other), of_colour_science(lab, other), rtol=1e-8, atol=1e-8)


def test_a_grey_and_a_colour_agree() -> None:
    chance = np.random.default_rng(3)
    lab = chance.uniform((0.0, -90.0, -90.0), (100.0, 90.0, 90.0), (1000, 3))
    grey = lab * [1.0, 0.0, 0.0]
    np.testing.assert_allclose(ciede2000(lab, grey), of_colour_science(lab, grey), rtol=1e-10)
    np.testing.assert_allclose(ciede2000(grey, lab), of_colour_science(grey, lab), rtol=1e-10)


def test_lab_is_colour_sciences_from_black_to_beyond_white() -> None:
    colour = import_colour_science()
    rgb = np.concatenate(
        (np.geomspace(1e-6, 4.0, 300)[:, None] * [1.0, 0.7, 0.2], np.eye(3), np.zeros((1, 3)))
    )
    white = rec709_to_xyz(np.ones(3))
    theirs = colour.XYZ_to_Lab(rec709_to_xyz(rgb) / white[1], white[:2] / white.sum())
    np.testing.assert_allclose(cielab(rec709_to_xyz(rgb) / white), theirs, atol=1e-9)


@given(LAB, LAB)
def test_a_difference_is_a_number_and_the_same_both_ways(
    lab_1: tuple[float, float, float], lab_2: tuple[float, float, float]
) -> None:
    there, back = ciede2000(np.array(lab_1), np.array(lab_2)), ciede2000(np.array(lab_2), np.array(lab_1))
    assert np.isfinite(there)
    # Exactly opposite hues have no shorter way round: each direction takes its own.
    assert there == pytest.approx(back, rel=1e-6, abs=1e-9) or is_opposite(lab_1, lab_2)
    assert ciede2000(np.array(lab_1), np.array(lab_1)) == 0.0


def is_opposite(lab_1: tuple[float, float, float], lab_2: tuple[float, float, float]) -> bool:
    cross = lab_1[1] * lab_2[2] - lab_1[2] * lab_2[1]
    return abs(cross) <= 1e-6 * np.hypot(*lab_1[1:]) * np.hypot(*lab_2[1:]) + 1e-300


def test_negative_channels_count_as_none() -> None:
    assert delta_e_2000([-0.5, 0.2, 0.1], [0.0, 0.2, 0.1]) == 0.0
    assert delta_e_2000([1.0, 1.0, 1.0], [0.0, 0.0, 0.0]) == pytest.approx(100.0, abs=1e-9)
