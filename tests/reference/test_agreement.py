"""OpenGL and the ray caster see the same points with the same properties, and light them alike."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np
import pytest

from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import (
    NormalTextureInfo,
    OcclusionTextureInfo,
    TextureInfo,
    TextureTransform,
)
from gltf_iri.reference.gather import gather_surface
from gltf_iri.reference.points import gather_points
from gltf_iri.reference.rays import camera_rays
from gltf_iri.reference.render import render_reference
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.tracer import Tracer
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.model import Light
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

SIZE = (96, 72)
MIRROR, CLAMP = 33648, 33071

# float32 interpolation, of values up to a few units; at a grazing angle some pixels lose more.
INTERPOLATION = 2e-5
GRAZING = 1e-3

# OpenGL snaps corners to 1/256 pixel, and triangles are 3 pixels wide: nearer to an edge it may see another.
NEAR_AN_EDGE = 5e-3


def lights():
    sun = Light("", "directional", (1.0, 0.9, 0.8), 2.0, np.zeros(3), np.array([0.6, -0.48, -0.64]))
    lamp = Light("", "point", (0.5, 0.7, 1.0), 20.0, np.array([2.0, 2.0, 2.0]), np.array([0, 0, -1.0]))
    spot = replace(
        lamp, kind="spot", position=np.array([-2.0, 1.0, 2.5]), direction=np.array([0.6, -0.0, -0.8])
    )
    return sun, replace(lamp, range_m=9.0), replace(spot, inner_cone_rad=0.2, outer_cone_rad=0.5)


def dressed(images):
    """A material that reads every texture of the core and of the film, each its own way."""
    rng = np.random.default_rng(8)

    def image(**sampler):
        return images.add(rng.integers(40, 216, (9, 7, 4)), **sampler)

    turn = TextureTransform(offset=(0.2, -0.3), rotation_rad=0.4, scale=(1.5, 0.7))
    bumps = np.full((9, 7, 4), 255)
    bumps[..., :2] = rng.integers(90, 166, (9, 7, 2))
    return Material(
        pbr=MetallicRoughness(
            base_color_texture=TextureInfo(image(wrap_s=MIRROR), 1, turn),
            metallic_factor=0.7,
            metallic_roughness_texture=TextureInfo(image(wrap_t=CLAMP)),
        ),
        normal_texture=NormalTextureInfo(images.add(bumps), 0, turn, scale=0.8),
        occlusion_texture=OcclusionTextureInfo(image(), strength=0.5),
        emissive_texture=TextureInfo(image(mag_filter=9729), transform=turn),
        emissive_factor=(0.1, 0.2, 0.3),
        emissive_strength=EmissiveStrength(2.0),
        specular=Specular(0.9, TextureInfo(image()), (0.8, 1.5, 1.0), TextureInfo(image())),
        iridescence=Iridescence(0.8, TextureInfo(image()), 1.4, 150.0, 500.0, TextureInfo(image(), 1)),
    )


def ball(props, **changes):
    """A sphere of uneven scale with both UV sets, vertex colours, and a turned, mirrored node."""
    made = props.sphere()
    second = np.stack([made.uvs[0][:, 1], made.uvs[0][:, 0]], axis=1) * np.float32([2.5, 1.5])
    colours = np.column_stack([0.5 + 0.5 * made.positions, np.ones(len(made.positions))]).astype(np.float32)
    turn = np.array([[0.8, 0.0, 0.6, 0.2], [0, 1, 0, -0.1], [-0.6, 0, 0.8, 0.3], [0, 0, 0, 1]])
    world = turn @ np.diag([-0.9, 0.6, 1.1, 1.0])
    return replace(made, uvs=(made.uvs[0], second), colours=colours, world=world, **changes)


def tangents(primitive):
    """Any field of unit vectors in the surface, with both hands."""
    across = np.cross(primitive.normals.astype(np.float64), [0.3, 0.9, -0.2])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return np.column_stack([across, np.full(len(across), -1.0)]).astype(np.float32)


@pytest.fixture
def draw(gl_context: moderngl.Context):
    """Draw what `scene_of` returns with every input beside."""
    renderer = Renderer(gl_context)

    def drawn(scene, camera):
        return renderer.render(
            *scene, camera, None, size=SIZE, float_textures=True, sharp_textures=True, with_inputs=True
        ).inputs

    yield drawn
    renderer.release()


def seen(scene, camera):
    """Return the mask of pixels that see a surface, that surface, and which of its points lie off edges."""
    stage = build_stage(*scene)
    origins, directions, lengths = camera_rays(camera, SIZE)
    hits = Tracer(stage).first_hits(origins, directions, t_max=lengths)
    rows = hits.valid
    points = gather_points(
        stage.scene, hits.primitive[rows], hits.triangle[rows], hits.barycentric[rows], hits.is_front[rows]
    )
    is_inside = hits.barycentric[rows].min(axis=1) > NEAR_AN_EDGE
    return rows.reshape(SIZE[::-1]), gather_surface(stage, 0, points, -directions[rows]), is_inside


def scenes(props, kind, images):
    material = dressed(images)
    with_tangents = ball(props, tangents=tangents(ball(props)))
    inside_out = replace(ball(props), triangles=ball(props).triangles[:, ::-1].copy())
    return {
        "derived tangents": lambda: (ball(props), material),
        "the mesh's tangents": lambda: (with_tangents, material),
        "back faces": lambda: (inside_out, replace(material, double_sided=True)),
    }[kind]()


KINDS = ("derived tangents", "the mesh's tangents", "back faces")
VIEWS = {"perspective": {}, "orthographic": {"half_height": 1.3}}
PROPERTIES = (
    *("position", "normal", "base_color", "metallic", "perceptual_roughness", "emission"),
    *("dielectric_f0", "specular_weight", "iridescence_factor"),
)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("kind", KINDS)
def test_both_see_the_same_points_with_the_same_properties(draw, props, kind, view):
    images = props.Images()
    scene = props.scene_of(*scenes(props, kind, images), images=images, lights=lights())
    camera = props.camera(**VIEWS[view])
    inputs = draw(scene, camera)
    mask, surface, is_inside = seen(scene, camera)
    assert np.count_nonzero(mask != (inputs.material >= 0)) <= 2  # silhouettes
    rows = is_inside & (inputs.material >= 0)[mask]
    both = mask.copy()
    both[mask] = rows
    assert both.sum() > 1000
    for name in PROPERTIES:
        error = np.abs(getattr(surface, name)[rows] - getattr(inputs, name)[both])
        assert np.quantile(error, 0.99) < INTERPOLATION, name
        assert error.max() < GRAZING, name
    thickness = np.abs(surface.iridescence_thickness_nm[rows] - inputs.iridescence_thickness_nm[both])
    assert thickness.max() < 500 * GRAZING


@pytest.mark.parametrize("kind", KINDS)
def test_both_light_what_they_see_alike(draw, props, kind):
    images = props.Images()
    scene = props.scene_of(*scenes(props, kind, images), images=images, lights=lights())
    inputs = draw(scene, props.camera())
    mine = render_reference(*scene, props.camera(), None, size=SIZE, lighting="punctual", processes=1)
    both = (mine.material >= 0) & (inputs.material >= 0)
    colour = mine.rgba[both][:, :3]
    deviation = np.abs(colour - inputs.colour[both]) / np.maximum(1.0, colour)
    assert np.quantile(colour, 0.99) > 0.1
    # The rest are pixels on an edge, where OpenGL may see the neighbour.
    assert np.quantile(deviation, 0.995) < GLSL_PIXEL_RELATIVE


def test_both_cut_the_same_holes(draw, props):
    images = props.Images()
    holes = np.random.default_rng(2).integers(0, 256, (8, 8, 4))
    base = MetallicRoughness(base_color_texture=TextureInfo(images.add(holes)))
    material = Material(pbr=base, alpha_mode="MASK", alpha_cutoff=0.45)
    behind = np.eye(4)
    behind[:3, 3] = (0.1, 0.1, -0.7)
    scene = props.scene_of(
        [props.quad(), replace(props.quad(world=behind), material=1)], [material, Material()], images=images
    )
    inputs = draw(scene, props.camera())
    mine = render_reference(*scene, props.camera(), None, size=SIZE, lighting="punctual", processes=1)
    assert {*np.unique(mine.material)} == {-1, 0, 1}
    assert np.count_nonzero(mine.material != inputs.material) <= 3


def test_a_coats_normals_are_its_own(props):
    images = props.Images()
    tilted = images.add([[(180, 128, 220, 255)]])
    coat = Clearcoat(1.0, roughness_factor=0.3, normal_texture=NormalTextureInfo(tilted))
    scene = props.scene_of(props.quad(), Material(clearcoat=coat), images=images)
    _, surface, _ = seen(scene, props.camera(half_height=1.0))
    expected = 2.0 * np.array([180, 128, 220]) / 255 - 1.0
    assert np.abs(surface.normal - [0, 0, 1]).max() < 1e-15
    assert np.abs(surface.clearcoat_normal - expected / np.linalg.norm(expected)).max() < 1e-12
