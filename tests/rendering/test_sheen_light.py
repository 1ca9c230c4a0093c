"""The sheen's table and prefiltered layers against the integrals that they stand for."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.sheen import SHEEN_ALPHA_MIN, d_charlie, sheen_alpha, v_sheen
from gltf_iri.rendering.environment_light import SHEEN_LAYERS
from gltf_iri.rendering.image_light import ImageLightStore
from gltf_iri.rendering.lobe_tables import compute_sheen_table
from gltf_iri.scene.model import Environment

SHEEN_ROUGHNESS_MIN = SHEEN_ALPHA_MIN**0.5


def integrated(n_dot_v, roughness):
    """∫ D·V·(N·L) dω by Gauss and Legendre's nodes over N·L = t⁵ and over the turn, each in two panels."""
    alpha = float(sheen_alpha(roughness))
    nodes, weights = np.polynomial.legendre.leggauss(96)
    nodes, weights = (nodes + 1.0) / 2.0, weights / 2.0
    low = 0.5 * nodes**5
    n_dot_l = np.concatenate([low, 1.0 - low])[:, None]
    share = np.tile(2.5 * nodes**4 * weights, 2)[:, None]
    turn = np.pi * (1.0 - nodes**3)  # towards π, behind the normal, the lobe is sharpest
    turn_share = 6.0 * np.pi * nodes**2 * weights
    across = np.sqrt((1.0 - n_dot_v**2) * (1.0 - n_dot_l**2))
    v_dot_l = across * np.cos(turn) + n_dot_v * n_dot_l
    n_dot_h = np.minimum((n_dot_v + n_dot_l) / np.sqrt(2.0 + 2.0 * v_dot_l), 1.0)
    sent = d_charlie(n_dot_h, alpha) * v_sheen(n_dot_l, n_dot_v, alpha) * n_dot_l
    return float(np.sum(sent * share * turn_share))


@pytest.fixture(scope="module")
def table(_session_context):
    texture = compute_sheen_table(_session_context)
    values = np.frombuffer(texture.read(), np.float32).reshape(texture.size[::-1]).astype(np.float64)
    texture.release()
    return values


@pytest.mark.usefixtures("gl_context")
def test_the_table_holds_the_integral_and_at_most_1(table):
    height, width = table.shape
    for row in range(0, height, 51):
        roughness = SHEEN_ROUGHNESS_MIN + (1.0 - SHEEN_ROUGHNESS_MIN) * row / (height - 1)
        for column in range(73, width, 73):
            expected = min(integrated((column / (width - 1)) ** 4, roughness), 1.0)
            assert table[row, column] == pytest.approx(expected, abs=2e-5)


@pytest.mark.usefixtures("gl_context")
def test_no_entry_sends_more_than_arrives(table):
    assert table.min() >= 0.0
    assert table.max() <= 1.0


def sheen_layers(gl_context, radiance):
    store = ImageLightStore(gl_context)
    texture = store.textures(Environment("sky", radiance), with_sheen=True)["u_environment_sheen"]
    width, height = texture.size
    layers = np.frombuffer(texture.read(), np.float32).reshape(SHEEN_LAYERS, height // SHEEN_LAYERS, width, 3)
    store.release()
    return layers[..., 0].astype(np.float64)


def test_a_white_sky_stays_white_whatever_the_size_of_its_map(gl_context):
    for height in (2, 64):
        layers = sheen_layers(gl_context, np.ones((height, 2 * height, 3), np.float32))
        assert np.abs(layers - 1.0).max() <= 1e-6


def test_fibres_blur_a_slanted_sky_by_their_lobe_s_mean_cosine(gl_context):
    """1 + y becomes 1 + k·N_y, k the mean of N·L under D·V·(N·L) for N = V."""
    up = np.cos((np.arange(64) + 0.5) / 64 * np.pi)
    sky = np.broadcast_to((1.0 + up)[:, None, None], (64, 128, 3)).astype(np.float32)
    layers = sheen_layers(gl_context, np.ascontiguousarray(sky))
    n_dot_l = (np.arange(20000) + 0.5) / 20000
    for number, layer in enumerate(layers):
        alpha = float(sheen_alpha(number / (SHEEN_LAYERS - 1)))
        lobe = d_charlie(np.sqrt(0.5 + 0.5 * n_dot_l), alpha) * v_sheen(n_dot_l, 1.0, alpha) * n_dot_l
        mean_cosine = np.sum(lobe * n_dot_l) / np.sum(lobe)
        normal_up = np.cos(np.linspace(0.0, np.pi, layer.shape[0]))[:, None]
        assert np.abs(layer - 1.0 - mean_cosine * normal_up).max() <= 5e-3


def test_the_tables_need_no_environment(gl_context):
    store = ImageLightStore(gl_context)
    assert set(store.tables()) == {"u_dfg"}
    assert set(store.tables(with_sheen=True)) == {"u_dfg", "u_sheen_albedo"}
    store.release()
