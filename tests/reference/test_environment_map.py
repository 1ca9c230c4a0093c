"""The CPU's environment map against sums by hand and against its own density."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.low_discrepancy import net, shifted, standard_error
from gltf_iri.scene.environment import studio, white
from gltf_iri.scene.model import Environment


def _uneven(height: int = 8) -> Environment:
    rng = np.random.default_rng(5)
    return Environment("uneven", (rng.random((height, 2 * height, 3)) ** 4).astype(np.float32))


def _even_directions(count: int) -> np.ndarray:
    u, v = shifted(net(count), np.random.default_rng(1), 1)[0].T
    cosine = 1.0 - 2.0 * v
    sine = np.sqrt(1.0 - cosine**2)
    return np.column_stack([sine * np.cos(2 * np.pi * u), cosine, sine * np.sin(2 * np.pi * u)])


def test_texel_centres_return_their_texels() -> None:
    environment = _uneven()
    rows, columns = (a.ravel() for a in np.mgrid[0:8, 0:16])
    azimuth, polar = 2 * np.pi * ((columns + 0.5) / 16 - 0.5), np.pi * (rows + 0.5) / 8
    directions = np.column_stack(
        [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)]
    )
    expected = environment.radiance[rows, columns]
    assert_allclose(EnvironmentMap(environment).radiance(directions), expected, atol=1e-12)


def test_the_map_stands_as_its_convention_says() -> None:
    radiance = np.zeros((64, 128, 3), np.float32)
    radiance[:2] = (1, 0, 0)  # +Y
    radiance[31:33, 63:65] = (0, 1, 0)  # +X, the middle column
    radiance[31:33, 95:97] = (0, 0, 1)  # +Z, to its right
    seen = EnvironmentMap(Environment("axes", radiance)).radiance(np.eye(3)[[1, 0, 2]])
    assert_allclose(seen, np.eye(3), atol=1e-12)


def test_density_is_that_of_a_distribution() -> None:
    directions = _even_directions(1 << 16)
    for environment in (_uneven(), studio(), white()):
        mass = 4 * np.pi * EnvironmentMap(environment).density(directions).mean()
        assert abs(mass - 1.0) < 2e-3, environment.name


def test_directions_lie_as_the_density_says() -> None:
    lighting = EnvironmentMap(_uneven())
    count = 1 << 14
    drawn = lighting.sample(shifted(net(count), np.random.default_rng(2), 1)[0])
    assert_allclose(np.linalg.norm(drawn, axis=1), 1.0, atol=1e-12)
    # The share of directions in each texel against the density's integral over it.
    u = 0.5 + np.arctan2(drawn[:, 2], drawn[:, 0]) / (2 * np.pi)
    v = np.arccos(drawn[:, 1]) / np.pi
    seen = np.histogram2d(v, u, bins=(8, 16), range=((0, 1), (0, 1)))[0] / count
    edges = np.cos(np.pi * np.arange(9) / 8)
    solid_angle = (edges[:-1] - edges[1:])[:, None] * (2 * np.pi / 16)
    rows, columns = (a.ravel() for a in np.mgrid[0:8, 0:16])
    azimuth, polar = 2 * np.pi * ((columns + 0.5) / 16 - 0.5), np.pi * (rows + 0.5) / 8
    middles = np.column_stack(
        [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)]
    )
    expected = lighting.density(middles).reshape(8, 16) * solid_angle
    assert_allclose(seen, expected, atol=2e-3)


def test_a_drawn_sky_has_the_mean_of_the_whole_sky() -> None:
    lighting = EnvironmentMap(_uneven())
    everywhere = 4 * np.pi * lighting.radiance(_even_directions(1 << 16)).mean(axis=0)
    estimates = []
    for places in shifted(net(1 << 10), np.random.default_rng(3), 8):
        drawn = lighting.sample(places)
        estimates.append((lighting.radiance(drawn) / lighting.density(drawn)[:, None]).mean(axis=0))
    mean, error = standard_error(np.array(estimates))
    assert np.all(np.abs(mean - everywhere) < 5 * error + 1e-3 * everywhere)


def test_darkness_is_drawn_evenly() -> None:
    dark = EnvironmentMap(Environment("dark", np.zeros((4, 8, 3), np.float32)))
    drawn = dark.sample(shifted(net(64), np.random.default_rng(4), 1)[0])
    assert_allclose(dark.density(drawn), 1 / (4 * np.pi))


def test_every_block_of_the_net_holds_one_point() -> None:
    points = net(256) / 2.0**32
    for columns in (1, 4, 16, 64, 256):
        counts = np.histogram2d(*points.T, bins=(columns, 256 // columns), range=((0, 1), (0, 1)))[0]
        assert np.all(counts == 1)
