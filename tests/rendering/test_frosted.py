"""What a frosted pane makes of an edge behind it: the lobe of its facets, as wide as their slopes say."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit

# The shader's 16 directions, each averaged over its share, and what of the wall lies beside the picture.
EDGE_WITHIN = 0.04


def edge_seen(aside_m, behind_m, alpha):
    """Share of light from beyond an edge: facets at even shares of D·(N·H) turn it by 2θ_h, and weigh N·L."""
    share, turn = (np.arange(400) + 0.5) / 400, 2.0 * np.pi * (np.arange(200) + 0.5) / 200
    theta = 2.0 * np.arctan(alpha * np.sqrt(share / (1.0 - share)))
    theta = theta[theta < 0.5 * np.pi]
    weight = np.cos(theta)[:, None] * np.ones_like(turn)
    reach = behind_m * np.tan(theta)[:, None] * np.cos(turn)
    return np.array([np.sum(weight[x + reach > 0.0]) for x in aside_m]) / weight.sum()


@pytest.mark.parametrize(("roughness", "behind_m"), [(0.5, 0.25), (0.4, 0.4), (0.6, 0.15)])
def test_an_edge_is_blurred_by_the_lobe_of_the_facets(stage, props, furnace, roughness, behind_m):
    world = np.diag([4.0, 4.0, 1.0, 1.0])
    world[2, 3] = -behind_m
    black = props.quad(world=world @ np.diag([0.5, 1.0, 1.0, 1.0]))
    white = props.quad(world=black.world.copy(), material=1)
    black.world[0, 3], white.world[0, 3] = -2.0, 2.0
    paints = [Material(pbr=MetallicRoughness((c, c, c, 1.0)), unlit=Unlit()) for c in (0.0, 1.0)]
    frost = Material(
        pbr=MetallicRoughness(metallic_factor=0.0, roughness_factor=roughness),
        transmission=Transmission(factor=1.0),
        specular=Specular(factor=0.0),
    )
    frame = stage.draw(
        [black, white, props.quad(material=2)],
        [*paints, frost],
        environment=furnace,
        size=(128, 128),
        samples=0,
    )
    column = np.arange(48, 80)
    aside_m = (column + 0.5) / 64.0 - 1.0
    expected = edge_seen(aside_m, behind_m, roughness**2)
    assert np.ptp(expected) > 0.5
    assert np.abs(frame.rgba[64, column, 0] - expected).max() <= EDGE_WITHIN
