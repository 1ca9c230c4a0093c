"""The DFG table against the integral that it stands for, by another quadrature in float64."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.facet_mean import mean_cosine
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN, v_smith_ggx_correlated
from gltf_iri.rendering.lobe_tables import compute_dfg_table


def integrated(n_dot_v, roughness):
    """A and B as 4 ∫ V·D·(N·L)(V·H) {1 − Fc, Fc} over facets: θ_h by the distribution of D·N·H, φ evenly."""
    alpha = max(roughness**2, ALPHA_MIN)
    t = (np.arange(800) + 0.5) / 800
    height, share = 1.0 - (1.0 - t) ** 2, 2.0 * (1.0 - t)
    turn = np.pi * (np.arange(1600) + 0.5) / 1600
    cos2 = ((1.0 - height) / (1.0 + (alpha**2 - 1.0) * height))[:, None]
    n_dot_h, sin_h = np.sqrt(cos2), np.sqrt(1.0 - cos2)
    v_dot_h = np.sqrt(1.0 - n_dot_v**2) * sin_h * np.cos(turn) + n_dot_v * n_dot_h
    n_dot_l = 2.0 * v_dot_h * n_dot_h - n_dot_v
    lit = (n_dot_l > 0.0) & (v_dot_h > 0.0)
    visibility = v_smith_ggx_correlated(np.where(lit, n_dot_l, 1.0), n_dot_v, alpha)
    weight = np.where(lit, 4.0 * visibility * n_dot_l * v_dot_h / n_dot_h, 0.0)
    grazing = (1.0 - v_dot_h) ** 5
    weight = weight * share[:, None]
    return np.mean(weight * (1.0 - grazing)), np.mean(weight * grazing)


@pytest.fixture
def table(gl_context):
    texture = compute_dfg_table(gl_context)
    values = np.frombuffer(texture.read(), np.float32).reshape(*texture.size[::-1], 4).astype(np.float64)
    texture.release()
    return values


def look_up(table, n_dot_v, roughness):
    """What bilinear filtering gives at (⁴√(N·V), √roughness), each from where it is held at its least."""
    rows, columns = table.shape[:2]
    first = np.array([ALPHA_MIN, N_DOT_V_MIN]) ** 0.25
    y, x = (np.array([roughness**0.5, n_dot_v**0.25]) - first) / (1.0 - first) * [rows - 1, columns - 1]
    j, i = min(int(y), rows - 2), min(int(x), columns - 2)
    fy, fx = y - j, x - i
    upper = table[j, i] * (1 - fx) + table[j, i + 1] * fx
    lower = table[j + 1, i] * (1 - fx) + table[j + 1, i + 1] * fx
    return upper * (1 - fy) + lower * fy


@pytest.mark.parametrize("roughness", [0.1, 0.25, 0.4, 0.63, 0.87, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.02, 0.11, 0.3, 0.55, 0.8, 1.0])
def test_the_table_holds_the_integral(table, n_dot_v, roughness):
    assert look_up(table, n_dot_v, roughness)[:2] == pytest.approx(integrated(n_dot_v, roughness), abs=1e-4)


def test_no_entry_reflects_more_than_arrives(table):
    assert table.min() >= 0.0
    assert table[..., :2].sum(axis=-1).max() <= 1.0 + 1e-7  # the rounding of two float32 terms


@pytest.mark.parametrize("roughness", [0.05, 0.2, 0.4, 0.63, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.02, 0.11, 0.3, 0.55, 0.8, 1.0])
def test_the_table_holds_the_cosine_at_which_facets_are_seen(table, n_dot_v, roughness):
    # A film of 1 µm turns by 0.01 of its colour in some 0.003.
    assert look_up(table, n_dot_v, roughness)[2] == pytest.approx(mean_cosine(n_dot_v, roughness), abs=2e-4)
