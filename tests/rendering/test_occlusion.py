"""Occlusion keeps the environment from every layer of a surface, and nothing else from any."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.texture import OcclusionTextureInfo
from gltf_iri.scene.model import Light

LAYERS = {
    "paint": {},
    "film": {"iridescence": Iridescence(factor=1.0, film_ior=1.6, thickness_max_nm=400.0)},
    "brushed": {"anisotropy": Anisotropy(0.7)},
    "fibres": {"sheen": Sheen((1.0, 0.8, 0.6), roughness_factor=0.6)},
    "coat": {"clearcoat": Clearcoat(factor=1.0, roughness_factor=0.3)},
}


def occluded(props, red, **layers):
    images = props.Images()
    texture = OcclusionTextureInfo(images.add([[(red, 255, 255, 255)]]))
    pbr = MetallicRoughness((0.8, 0.6, 0.4, 1.0), metallic_factor=0.5, roughness_factor=0.4)
    return images, Material(pbr=pbr, occlusion_texture=texture, **layers)


@pytest.mark.parametrize("layer", LAYERS)
def test_where_no_light_of_the_environment_arrives_no_layer_sends_any(stage, props, furnace, layer):
    images, open_to_it = occluded(props, 255, **LAYERS[layer])
    assert stage.draw(props.quad(), open_to_it, images=images, environment=furnace).rgba[..., 0].min() > 0.1
    images, hidden = occluded(props, 0, **LAYERS[layer])
    seen = stage.draw(props.quad(), hidden, images=images, environment=furnace).rgba
    assert seen[32, 32].tolist() == [0.0, 0.0, 0.0, 1.0]


@pytest.mark.parametrize("layer", LAYERS)
def test_light_of_the_scene_is_not_occluded(stage, props, layer):
    sun = Light("sun", "directional", (1.0, 1.0, 1.0), 3.0, np.zeros(3), np.array([0.0, 0.0, -1.0]))
    pictures = []
    for red in (0, 255):
        images, material = occluded(props, red, **LAYERS[layer])
        pictures.append(stage.draw(props.quad(), material, images=images, lights=[sun]).rgba)
    np.testing.assert_array_equal(*pictures)
    assert pictures[0].max() > 0.1
