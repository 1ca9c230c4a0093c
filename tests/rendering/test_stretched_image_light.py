"""Stretched facets under an environment: from where, on average, the light comes that they collect."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.optics.microfacet import anisotropic_alphas, v_smith_ggx_anisotropic
from gltf_iri.scene.model import Environment
from gltf_iri.scene.studio import directions

SLOPE = 0.9  # of a radiance 1 + slope · direction, a component a channel: its mean tells the mean direction
# Length of what the mean direction may be off by, by roughness: round lobes stand for sections that are not
# round. Without the shift towards the normal it is off by up to 0.06, 0.28 and 0.60.
OFF_MAX = {0.3: 0.05, 0.5: 0.14, 0.8: 0.17}


@pytest.fixture(scope="module")
def gradient():
    return Environment("gradient", (1.0 + SLOPE * directions(64)).astype(np.float32))


def mean_direction(view, alpha_t, alpha_b, count=256):
    """∫ L D V (N·L) dω / ∫ D V (N·L) dω over facets of even shares of D (N·H), along T, B and N, (3,)."""
    share, turn = np.meshgrid((np.arange(count) + 0.5) / count, 2 * np.pi * (np.arange(count) + 0.5) / count)
    steepness = np.sqrt(share / (1.0 - share))
    half = np.stack(
        [alpha_t * steepness * np.cos(turn), alpha_b * steepness * np.sin(turn), np.ones_like(turn)], axis=-1
    )
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    v_dot_h = half @ view
    light = 2.0 * v_dot_h[..., None] * half - view
    met = (v_dot_h > 0.0) & (light[..., 2] > 0.0)
    light, v_dot_h, n_dot_h = light[met], v_dot_h[met], half[..., 2][met]
    seen = v_smith_ggx_anisotropic(
        light[:, 2], view[2], light[:, 0], light[:, 1], view[0], view[1], alpha_t, alpha_b
    )
    return np.average(light, axis=0, weights=seen * light[:, 2] * v_dot_h / n_dot_h)


@pytest.mark.parametrize("tilt_deg", [20, 40, 65])
@pytest.mark.parametrize("roughness", [0.3, 0.5, 0.8])
@pytest.mark.parametrize("rotation_rad", [0.0, np.pi / 2], ids=["along the view", "across the view"])
def test_stretched_facets_collect_light_from_where_their_integral_does(
    stage, props, gradient, roughness, tilt_deg, rotation_rad
):
    cosine, sine = np.cos(np.radians(tilt_deg)), np.sin(np.radians(tilt_deg))
    world = np.eye(4)
    world[:3, :3] = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]
    tilted = props.quad(world=world)
    for strength in (0.3, 0.8, 1.0):
        brushed = Material(
            pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness),
            anisotropy=Anisotropy(strength=strength, rotation_rad=rotation_rad),
        )
        inputs = stage.draw(tilted, brushed, environment=gradient, size=(17, 17), with_inputs=True).inputs
        normal = inputs.normal[8, 8].astype(float)
        tangent = inputs.anisotropy_tangent[8, 8].astype(float)
        frame = np.stack([tangent, np.cross(normal, tangent), normal])
        expected = mean_direction(frame[:, 2], *map(float, anisotropic_alphas(roughness**2, strength)))
        found = frame @ (inputs.reflected_radiance[8, 8] - 1.0) / SLOPE
        assert np.linalg.norm(found - expected) <= OFF_MAX[roughness], (strength, found, expected)
