"""Through balls and plates light goes as geometry has it, and roughness spreads it as facets do."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.transmission import dispersed_iors, exit_normal, path_inside, refraction_roughness


def refract(direction, normal, ratio):
    """Snell's law in vectors, towards the other side of `normal`; NaN where light is totally reflected."""
    cosine = -np.sum(direction * normal, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore"):
        return ratio * direction + (ratio * cosine - np.sqrt(1.0 - ratio**2 * (1.0 - cosine**2))) * normal


def rays(ior):
    """Unit directions onto points of the unit sphere from all sides, and the ways inside."""
    generator = np.random.default_rng(3)
    normals = generator.normal(size=(500, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    directions = generator.normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    directions *= -np.sign(np.sum(directions * normals, axis=1, keepdims=True))
    return normals, directions, refract(directions, normals, 1.0 / ior)


@pytest.mark.parametrize("ior", [1.1, 1.5, 2.4])
def test_a_ball_is_left_where_its_chord_ends(ior):
    entry, _, inside = rays(ior)
    cos_theta = -np.sum(entry * inside, axis=1)
    end = entry + path_inside(2.0, cos_theta, 1.0)[:, None] * inside
    assert np.abs(np.linalg.norm(end, axis=1) - 1.0).max() <= 1e-12
    assert np.abs(exit_normal(entry, inside, 1.0) - end).max() <= 1e-12


@pytest.mark.parametrize("ior", [1.1, 1.5, 2.4])
def test_a_plate_is_left_in_the_direction_of_arrival_at_its_far_side(ior):
    entry, arriving, inside = rays(ior)
    leaving = refract(inside, -exit_normal(entry, inside, 0.0), ior)
    assert np.abs(leaving - arriving).max() <= 1e-9
    path = path_inside(0.3, -np.sum(entry * inside, axis=1), 0.0)
    assert np.abs(np.sum(path[:, None] * inside * entry, axis=1) + 0.3).max() <= 1e-12


@pytest.mark.parametrize("roundness", np.linspace(0.0, 1.0, 9))
def test_whatever_the_shape_light_that_entered_can_leave(roundness):
    entry, _, inside = rays(2.4)
    normal = exit_normal(entry, inside, roundness)
    cosine = np.sum(normal * inside, axis=1)
    assert (cosine >= -np.sum(entry * inside, axis=1) - 1e-12).all()


def test_an_index_of_1_neither_spreads_nor_disperses():
    assert refraction_roughness([0.0, 0.5, 1.0], 1.0).tolist() == [0.0, 0.0, 0.0]
    assert dispersed_iors(1.0, 5.0).tolist() == [1.0, 1.0, 1.0]


def test_dispersion_parts_the_indices_by_what_the_abbe_number_says():
    """KHR_materials_dispersion: dispersion = 20 / V, V = (n_d − 1) / (n_F − n_C)."""
    red, green, blue = dispersed_iors(1.5, 20.0 / 40.0)
    assert green == 1.5
    assert (green - 1.0) / (blue - red) == pytest.approx(40.0)
    assert dispersed_iors(1.5, 1e3)[0] == 1.0


@pytest.mark.parametrize(("ior", "roughness"), [(1.33, 0.2), (1.5, 0.2), (1.5, 0.4), (1.8, 0.3), (2.4, 0.1)])
def test_two_rough_sides_spread_light_as_the_equivalent_mirror_does(ior, roughness):
    generator = np.random.default_rng(5)
    count, alpha = 100_000, roughness**2

    def facets():
        chance, turn = generator.random(count), 2.0 * np.pi * generator.random(count)
        slope = alpha * np.sqrt(chance / (1.0 - chance))
        normals = np.stack([slope * np.cos(turn), slope * np.sin(turn), np.ones(count)], axis=-1)
        return normals / np.linalg.norm(normals, axis=1, keepdims=True)

    inside = refract(np.array([0.0, 0.0, -1.0]), facets(), 1.0 / ior)
    outside = refract(inside, facets(), ior)
    found = np.nanmedian(np.arccos(np.clip(-outside[:, 2], -1.0, 1.0)))
    # The median of a mirror's facets has slope α and turns light by twice its angle.
    expected = 2.0 * np.arctan(refraction_roughness(roughness, ior) ** 2)
    assert found == pytest.approx(expected, rel=0.05)
