"""Under a white sky nothing shines brighter than the sky, and a mirror cannot be told from it."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.scene.model import Light

ROUGHNESSES = (0.0, 0.06, 0.125, 0.3, 0.5, 1.0)


def metal(roughness, colour=(1.0, 1.0, 1.0), **more):
    return Material(
        pbr=MetallicRoughness((*colour, 1.0), metallic_factor=1.0, roughness_factor=roughness), **more
    )


def lit(stage, props, material, furnace, **options):
    frame = stage.draw(
        props.sphere(), material, environment=furnace, seen_from=props.camera(), with_inputs=True, **options
    )
    return frame.inputs, frame.inputs.material == 0


@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_a_white_metal_reflects_a_plus_b_and_no_more(stage, props, furnace, roughness):
    inputs, seen = lit(stage, props, metal(roughness), furnace)
    assert seen.sum() > 1000
    albedo = (inputs.dfg_a + inputs.dfg_b)[seen]
    assert np.abs(inputs.colour[seen] - albedo[:, None]).max() <= 2e-7
    assert albedo.max() <= 1.0 + 2e-7


@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_a_white_sky_is_one_in_every_direction_and_blur(stage, props, furnace, roughness):
    inputs, seen = lit(stage, props, metal(roughness), furnace)
    assert np.abs(inputs.reflected_radiance[seen] - 1.0).max() <= 2e-7
    assert np.abs(inputs.irradiance[seen] - 1.0).max() <= 2e-7


def test_a_perfect_mirror_disappears(stage, props, furnace):
    inputs, seen = lit(stage, props, metal(0.0), furnace)
    facing = seen & (inputs.normal[..., 2] > 0.2)
    assert np.abs(inputs.colour[facing] - 1.0).max() <= 1e-3


@pytest.mark.parametrize("metallic", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
def test_a_filmed_white_surface_sends_no_more_than_arrives(stage, props, furnace, metallic, roughness):
    film = Iridescence(factor=1.0, film_ior=1.8, thickness_max_nm=400.0)
    pbr = MetallicRoughness(metallic_factor=metallic, roughness_factor=roughness)
    inputs, seen = lit(stage, props, Material(pbr=pbr, iridescence=film), furnace)
    assert inputs.colour[seen].min() >= 0.0
    assert inputs.colour[seen].max() <= 1.0 + 1e-6


def test_the_background_of_a_white_sky_is_white_and_covers_nothing(stage, props, furnace):
    frame = stage.draw(props.sphere(), metal(0.0), environment=furnace, seen_from=props.camera())
    assert np.abs(frame.rgba[0, 0] - [1.0, 1.0, 1.0, 0.0]).max() <= 2e-7
    assert frame.rgba[32, 32, 3] == 1.0


def test_light_beyond_single_precision_is_told(stage, props):
    blinding = Material(emissive_factor=(1.0, 1.0, 1.0), emissive_strength=EmissiveStrength(3e38))
    sun = Light("sun", "directional", (1.0, 1.0, 1.0), 3e38, np.zeros(3), np.array([0.0, 0.0, -1.0]))
    frame = stage.draw(props.quad(), blinding, lights=[sun], seen_from=props.camera())
    assert any("beyond single precision" in note for note in frame.notes)
