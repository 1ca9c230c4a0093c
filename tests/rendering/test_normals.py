"""Which side of a surface is out, and which way bumps lean, whatever mirrors the mesh or its coordinates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import NormalTextureInfo

GREY = Material(pbr=MetallicRoughness(metallic_factor=0.0))
TWO_SIDED = Material(pbr=MetallicRoughness(metallic_factor=0.0), double_sided=True)


def encoded(x, y, z):
    return [[[round((c + 1) / 2 * 255) for c in (x, y, z)] + [255]]]


def middle(frame):
    assert frame.inputs.material[32, 32] == 0
    return frame.inputs.normal[32, 32]


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1)])
def test_no_mirrored_sphere_is_inside_out(stage, props, scale):
    ball = props.sphere(world=np.diag([*(0.9 * np.array(scale)), 1.0]))
    inputs = stage.draw(ball, GREY, with_inputs=True).inputs
    seen = inputs.material == 0
    assert seen.mean() > 0.6
    assert inputs.position[seen][:, 2].min() >= -1e-3  # the near half
    outwards = inputs.position[seen] / np.linalg.norm(inputs.position[seen], axis=-1, keepdims=True)
    assert np.sum(outwards * inputs.normal[seen], axis=-1).min() > 0.99


def test_uneven_scales_keep_normals_square_to_the_surface(stage, props):
    axes = np.array([0.9, 0.4, -0.3])
    inputs = stage.draw(props.sphere(world=np.diag([*axes, 1.0])), GREY, with_inputs=True).inputs
    seen = inputs.material == 0
    gradient = inputs.position[seen] / axes**2
    gradient /= np.linalg.norm(gradient, axis=-1, keepdims=True)
    assert np.sum(gradient * inputs.normal[seen], axis=-1).min() > 0.99


def test_a_scale_of_zero_leaves_finite_normals(stage, props):
    flat = props.sphere(world=np.diag([0.9, 0.9, 0.0, 1.0]))
    inputs = stage.draw(flat, TWO_SIDED, with_inputs=True).inputs
    assert np.isfinite(inputs.normal).all()
    assert np.abs(middle(stage.draw(flat, TWO_SIDED, with_inputs=True)) - [0, 0, 1]).max() < 1e-6


def test_back_faces_are_culled_unless_the_material_is_double_sided(stage, props):
    turned = props.quad(world=np.diag([-1.0, 1.0, -1.0, 1.0]))  # half a turn about +Y
    assert (stage.draw(turned, GREY, with_inputs=True).inputs.material == -1).all()
    assert middle(stage.draw(turned, TWO_SIDED, with_inputs=True)).tolist() == [0, 0, 1]


def with_bump(props, bump, **changes):
    images = props.Images()
    material = Material(
        pbr=MetallicRoughness(metallic_factor=0.0),
        normal_texture=NormalTextureInfo(images.add(encoded(*bump))),
        double_sided=True,
    )
    return props.quad(**changes), material, images


def tangents(x, handedness):
    return {"tangents": np.tile(np.float32([x, 0, 0, handedness]), (4, 1))}


def flipped(props, *factors):
    return (props.quad().uvs[0] * np.float32(factors) + np.float32([f < 0 for f in factors]),)


# u to the right and v down; mirrored in u; mirrored in v; turned by half.
@pytest.mark.parametrize(("u", "v"), [(1, 1), (-1, 1), (1, -1), (-1, -1)])
@pytest.mark.parametrize("has_tangents", [False, True])
def test_red_leans_along_u_and_green_against_v(stage, props, u, v, has_tangents):
    # glTF 2.0 §3.7.2.1: bitangent = cross(normal, tangent) · w; here it must be −∂P/∂v = (0, v, 0).
    vertex = tangents(u, u * v) if has_tangents else {}
    for bump, expected in (((0.6, 0, 0.8), (0.6 * u, 0, 0.8)), ((0, 0.6, 0.8), (0, 0.6 * v, 0.8))):
        primitive, material, images = with_bump(props, bump, uvs=flipped(props, u, v), **vertex)
        found = middle(stage.draw(primitive, material, images=images, with_inputs=True))
        assert np.abs(found - expected).max() <= 0.01


@pytest.mark.parametrize("has_tangents", [False, True])
@pytest.mark.parametrize("scale", [(-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, 1)])
def test_a_mirrored_mesh_shows_the_mirrored_bumps(stage, props, scale, has_tangents):
    vertex = tangents(1, 1) if has_tangents else {}
    bump = np.array([0.48, 0.36, 0.8])
    primitive, material, images = with_bump(props, bump, world=np.diag([*map(float, scale), 1.0]), **vertex)
    found = middle(stage.draw(primitive, material, images=images, with_inputs=True))
    mirrored = bump * scale
    assert np.abs(found - mirrored * np.sign(mirrored[2])).max() <= 0.01


def test_the_normal_scale_flattens_both_slopes_alike(stage, props):
    primitive, material, images = with_bump(props, (0.48, 0.36, 0.8))
    half = replace(material, normal_texture=replace(material.normal_texture, scale=0.5))
    expected = np.array([0.24, 0.18, 0.8]) / np.linalg.norm([0.24, 0.18, 0.8])
    assert (
        np.abs(middle(stage.draw(primitive, half, images=images, with_inputs=True)) - expected).max() <= 0.01
    )


def test_without_texture_coordinates_there_are_no_bumps(stage, props):
    primitive, material, images = with_bump(props, (0.6, 0, 0.8), uvs=())
    assert middle(stage.draw(primitive, material, images=images, with_inputs=True)).tolist() == [0, 0, 1]
