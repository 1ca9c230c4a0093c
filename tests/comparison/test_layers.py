"""GLSL against Python and against rays on every layer of a material, textured, under both kinds of light."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.comparison.reference_run import against_reference
from gltf_iri.comparison.rig import RIG, rig
from gltf_iri.comparison.run import compare
from gltf_iri.planning.decide import plan_materials
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sphere import sphere
from gltf_iri.scene.environment import white
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.load import load
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

SIZE = (64, 64)

FILM = {
    "KHR_materials_iridescence": {
        "iridescenceFactor": 0.8,
        "iridescenceIor": 1.5,
        "iridescenceThicknessMinimum": 200.0,
        "iridescenceThicknessMaximum": 500.0,
        "iridescenceThicknessTexture": {"index": 0},
    }
}
GLASS = {"KHR_materials_transmission": {"transmissionFactor": 0.9, "transmissionTexture": {"index": 0}}}
BODY = {
    "KHR_materials_volume": {
        "thicknessFactor": 1.2,
        "thicknessTexture": {"index": 0},
        "attenuationDistance": 0.8,
        "attenuationColor": [0.9, 0.5, 0.3],
    }
}
PRISM = {"KHR_materials_dispersion": {"dispersion": 2.0}, "KHR_materials_ior": {"ior": 1.7}}
COAT = {
    "KHR_materials_clearcoat": {
        "clearcoatFactor": 0.9,
        "clearcoatTexture": {"index": 0},
        "clearcoatRoughnessFactor": 0.6,
        "clearcoatRoughnessTexture": {"index": 0},
        "clearcoatNormalTexture": {"index": 1},
    }
}
CLOTH = {
    "KHR_materials_sheen": {
        "sheenColorFactor": [0.9, 0.4, 0.6],
        "sheenColorTexture": {"index": 0},
        "sheenRoughnessFactor": 0.7,
        "sheenRoughnessTexture": {"index": 0},
    }
}
BRUSHED = {
    "KHR_materials_anisotropy": {
        "anisotropyStrength": 0.8,
        "anisotropyRotation": 0.6,
        "anisotropyTexture": {"index": 1},
    }
}

# Metalness, and what lies on it.
OPAQUE = {
    "a coat over paint": (0.0, COAT),
    "a coat over a film": (0.6, COAT | FILM),
    "fibres over a film": (0.2, CLOTH | FILM),
    "a film on brushed metal": (0.9, BRUSHED | FILM),
    "every opaque layer": (0.3, CLOTH | BRUSHED | COAT | FILM),
}
GLASSES = {
    "thin glass": (0.0, GLASS),
    "a film on thin glass": (0.0, GLASS | FILM),
    "a film on thick glass that disperses": (0.0, GLASS | BODY | PRISM | FILM),
    "every layer": (0.3, GLASS | BODY | CLOTH | BRUSHED | COAT | FILM),
}
LAYERS = OPAQUE | GLASSES


def ball(folder: Path, name: str, roughness: float = 0.45) -> Path:
    """A ball of radius 1 m with layers of `LAYERS`, textures painted all over."""
    metallic, extensions = LAYERS[name]
    builder = GLTFBuilder("ball")
    u, v = texel_centres(16, 16)
    waves = [0.65 + 0.35 * np.sin(2.0 * np.pi * (n * u + v)) for n in (1, 2, 3)]
    builder.texture("waves", encode_png(to_bytes(np.stack(waves, axis=-1))), repeat=True)
    # A direction that turns once around the ball, and as a normal map slopes of up to 20°.
    turn = 2.0 * np.pi * u
    slopes = np.stack([0.5 + 0.15 * np.cos(turn), 0.5 + 0.15 * np.sin(turn), 0.95 + 0.0 * v], axis=-1)
    builder.texture("slopes", encode_png(to_bytes(slopes)), repeat=True)
    material = builder.material(
        name, base_color=(0.8, 0.5, 0.3), metallic=metallic, roughness=roughness, extensions=extensions
    )
    builder.mesh("ball", sphere(1.0, rings=24, segments=48), material)
    (content,) = builder.to_glb().values()
    path = folder / "ball.glb"
    path.write_bytes(content)
    return path


def staged(path: Path) -> tuple[Any, ...]:
    """Return model, scene under the rig, plans and camera, as both comparisons take them."""
    model = load(path)
    scene = model.scene()
    camera = frame_scene(scene, aspect=1.0)
    plans = plan_materials(model.materials)
    assert not plans[0].not_drawn
    return model, replace(scene, lights=rig(scene, camera)), plans, camera


@pytest.mark.parametrize("name", LAYERS)
def test_glsl_is_python_whatever_lies_on_a_material(
    gl_context, renderer, studio_light, tmp_path, name, record_property
) -> None:
    comparison = compare(renderer, *staged(ball(tmp_path, name)), studio_light, size=SIZE)
    rough = comparison.whole.glsl_vs_python.rough
    record_property("measured", f"GLSL − Python, {name}: {rough.max_relative} on {rough.pixels} pixels")
    assert rough.pixels > 0.5 * SIZE[0] * SIZE[1]
    assert rough.within(GLSL_PIXEL_RELATIVE)


@pytest.mark.parametrize("name", OPAQUE)
def test_rays_see_what_glsl_draws_of_punctual_light(
    gl_context, renderer, tmp_path, name, record_property
) -> None:
    held = against_reference(renderer, *staged(ball(tmp_path, name)), None, size=SIZE)
    rough = held.same_problem.rough
    record_property("measured", f"GLSL − rays, {name}: {rough.max_relative} on {rough.pixels} pixels")
    assert rough.pixels > 0.5 * SIZE[0] * SIZE[1]
    assert held.same_problem.edges < 0.01 * rough.pixels
    assert held.agrees


def test_under_a_white_sky_the_split_sum_is_nearly_exact(gl_context, renderer, tmp_path) -> None:
    """What is left is that the base's share is taken at N·V, not facet by facet."""
    model, scene, plans, camera = staged(ball(tmp_path, "a coat over paint"))
    scene = replace(scene, lights=())
    held = against_reference(renderer, model, scene, plans, camera, white(), size=(32, 32), image_samples=512)
    assert held.lights == RIG
    assert held.whole.noise_mean < 0.5
    assert held.whole.error.delta_e_mean < held.whole.noise_mean + 0.5
