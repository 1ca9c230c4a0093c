"""Under a white sky nothing shines brighter than the sky, and a mirror cannot be told from it."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.scene.model import Light

# The lobes' tables are right to this; everything else is rounding.
FURNACE_GAIN_MAX = 1e-3

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


FILMS = {
    "bare": None,
    "film": Iridescence(factor=1.0, film_ior=1.8, thickness_max_nm=400.0),
}

LAYERS = {
    "plain": {},
    "coat": {"clearcoat": Clearcoat(factor=1.0, roughness_factor=0.0)},
    "rough coat": {"clearcoat": Clearcoat(factor=1.0, roughness_factor=0.6)},
    "velvet": {"sheen": Sheen(color_factor=(1.0, 1.0, 1.0), roughness_factor=0.5)},
    "smooth fibres": {"sheen": Sheen(color_factor=(1.0, 1.0, 1.0), roughness_factor=0.05)},
    "coated velvet": {
        "sheen": Sheen(color_factor=(1.0, 0.5, 0.0), roughness_factor=0.3),
        "clearcoat": Clearcoat(factor=0.7, roughness_factor=0.2),
    },
    "brushed": {"anisotropy": Anisotropy(strength=1.0)},
    "thin glass": {"transmission": Transmission(factor=1.0)},
    "thick glass": {"transmission": Transmission(factor=1.0), "volume": Volume(thickness_factor_m=1.0)},
    "coated glass": {
        "transmission": Transmission(factor=0.6),
        "volume": Volume(thickness_factor_m=0.3),
        "clearcoat": Clearcoat(factor=1.0),
    },
}


# Through metal nothing passes: there, glass would be drawn once more as what is plain.
SURFACES = [
    *itertools.product(LAYERS, (0.0,)),
    *((name, 1.0) for name, layer in LAYERS.items() if "transmission" not in layer),
    ("plain", 0.5),
]


@pytest.mark.parametrize("film", FILMS)
@pytest.mark.parametrize(("layer", "metallic"), SURFACES)
def test_a_white_surface_sends_no_more_than_arrives(stage, props, furnace, layer, film, metallic):
    for roughness in (0.0, 0.3, 1.0):
        pbr = MetallicRoughness(metallic_factor=metallic, roughness_factor=roughness)
        white = Material(pbr=pbr, iridescence=FILMS[film], **LAYERS[layer])
        frame = stage.draw(
            props.sphere(), white, environment=furnace, seen_from=props.camera(), size=(40, 40), samples=0
        )
        assert np.isfinite(frame.rgba).all()
        assert frame.rgba[..., :3].min() >= 0.0
        assert frame.rgba[..., :3].max() <= 1.0 + FURNACE_GAIN_MAX


def test_the_background_of_a_white_sky_is_white_and_covers_nothing(stage, props, furnace):
    frame = stage.draw(props.sphere(), metal(0.0), environment=furnace, seen_from=props.camera())
    assert np.abs(frame.rgba[0, 0] - [1.0, 1.0, 1.0, 0.0]).max() <= 2e-7
    assert frame.rgba[32, 32, 3] == 1.0


def test_light_beyond_single_precision_is_told(stage, props):
    blinding = Material(emissive_factor=(1.0, 1.0, 1.0), emissive_strength=EmissiveStrength(3e38))
    sun = Light("sun", "directional", (1.0, 1.0, 1.0), 3e38, np.zeros(3), np.array([0.0, 0.0, -1.0]))
    frame = stage.draw(props.quad(), blinding, lights=[sun], seen_from=props.camera())
    assert any("beyond single precision" in note for note in frame.notes)
