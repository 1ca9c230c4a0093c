"""The nearest triangle that the rasteriser would draw is found, whatever float32 would have said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo

DOWN = np.array([0.0, 0.0, -1.0])


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def brute_force(corners, origins, directions):
    """Every ray with every triangle (Möller & Trumbore 1997); returns the nearest distance, ∞ for none."""
    a, b, c = corners[None, :, 0], corners[None, :, 1], corners[None, :, 2]
    o, d = origins[:, None], directions[:, None]
    p = np.cross(d, c - a)
    determinant = np.sum(p * (b - a), axis=-1)
    u = np.sum((o - a) * p, axis=-1) / determinant
    q = np.cross(o - a, b - a)
    v = np.sum(q * d, axis=-1) / determinant
    t = np.sum(q * (c - a), axis=-1) / determinant
    met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0)
    return np.where(met, t, np.inf).min(axis=1)


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e5])
@pytest.mark.parametrize("shift", [0.0, 3e3])
def test_the_nearest_of_a_soup_of_triangles_is_that_of_brute_force(props, trace, scale, shift):
    rng = np.random.default_rng(2)
    corners = (rng.normal(size=(300, 1, 3)) + 0.3 * rng.normal(size=(300, 3, 3))).astype(np.float32)
    world = np.diag([scale, scale, scale, 1.0])
    world[:3, 3] = shift * scale
    soup = props.triangles(corners.reshape(-1, 3), np.arange(900).reshape(-1, 3), world=world)
    origins = 5.0 * unit(rng.normal(size=(4000, 3)))
    directions = unit(0.8 * rng.normal(size=(4000, 3)) - origins)
    expected = brute_force(corners.astype(np.float64), origins, directions)
    hits = trace(soup, Material(double_sided=True)).first_hits(scale * (origins + shift), directions)
    assert np.array_equal(hits.valid, np.isfinite(expected))
    found = hits.valid
    # Positions keep 1e-16 of the shift, and grazing rays make more of it.
    assert np.abs(hits.distance[found] / scale - expected[found]).max() < 1e-9
    assert np.all(np.isinf(hits.distance[~found]))
    assert np.all(hits.barycentric[found] >= 0)
    assert np.abs(hits.barycentric[found].sum(axis=1) - 1).max() < 1e-12


def test_no_ray_slips_through_the_edges_and_corners_of_a_closed_mesh(props, trace):
    ball = props.sphere(stacks=40)
    tracer = trace(ball)
    corners = ball.positions.astype(np.float64)[ball.triangles]
    aims = np.concatenate([corners.reshape(-1, 3), 0.5 * (corners[:, 0] + corners[:, 1])])
    origins = 3.0 * np.random.default_rng(4).normal(size=aims.shape)
    origins += 3.0 * unit(aims)  # most of them outside of the ball
    outside = np.linalg.norm(origins, axis=1) > 1.1
    into = unit(-0.3 * aims - origins)
    through = unit(aims - origins)
    for way in (into, through):
        facing = outside & (np.sum(way * aims, axis=1) < -0.05)
        hits = tracer.first_hits(origins[facing], way[facing])
        assert facing.sum() > 1000
        assert np.all(hits.valid)
        assert np.all(hits.is_front)


def test_a_ray_that_starts_on_a_surface_leaves_it(props, trace):
    ball = props.sphere(stacks=40)
    tracer = trace(ball)
    origins = 4.0 * unit(np.random.default_rng(9).normal(size=(3000, 3)))
    first = tracer.first_hits(origins, unit(-origins))
    points = origins + first.distance[:, None] * unit(-origins)
    outwards = tracer.first_hits(points, unit(points), t_min=tracer.clearance_m, cull_back_faces=False)
    inwards = tracer.first_hits(points, unit(-points), t_min=tracer.clearance_m, cull_back_faces=False)
    assert not outwards.valid.any()
    assert inwards.valid.all()
    assert not inwards.is_front.any()
    assert inwards.distance.min() > 1.9


def test_back_faces_are_passed_unless_the_material_has_two_sides(props, trace):
    towards = np.array([[0.2, 0.1, -1.0]]), -DOWN[None]
    assert not trace(props.quad()).first_hits(*towards).valid[0]
    assert trace(props.quad()).first_hits(*towards, cull_back_faces=False).valid[0]
    hits = trace(props.quad(), Material(double_sided=True)).first_hits(*towards)
    assert hits.valid[0]
    assert not hits.is_front[0]


@pytest.mark.parametrize("flips", [(-1, 1, 1), (1, -1, 1), (-1, -1, 1), (-1, -1, -1)])
def test_mirroring_turns_the_winding_around(props, trace, flips):
    world = np.diag([*flips, 1.0])
    tracer = trace(props.quad(world=world))
    side = flips[2]  # the front of the quad points to +Z, wherever that goes
    seen = tracer.first_hits(np.array([[0.2, 0.1, 1.0 * side]]), side * DOWN[None])
    unseen = tracer.first_hits(np.array([[0.2, 0.1, -1.0 * side]]), -side * DOWN[None])
    assert seen.valid[0]
    assert seen.is_front[0]
    assert not unseen.valid[0]


def test_of_two_faces_at_the_same_place_the_one_that_is_seen_counts(props, trace):
    turned = props.quad(triangles=np.uint32([[2, 1, 0], [3, 2, 0]]))
    tracer = trace([turned, props.quad()])
    hits = tracer.first_hits(np.array([[0.3, 0.2, 1.0], [0.3, 0.2, -1.0]]), np.array([DOWN, -DOWN]))
    assert hits.primitive.tolist() == [1, 0]


def test_of_two_equal_faces_the_first_is_drawn(props, trace):
    hits = trace([props.quad(), props.quad()]).first_hits(np.array([[0.3, 0.2, 1.0]]), DOWN[None])
    assert hits.primitive[0] == 0


def masked(texture, cutoff=0.5):
    base = MetallicRoughness(base_color_texture=TextureInfo(texture))
    return Material(pbr=base, alpha_mode="MASK", alpha_cutoff=cutoff)


def test_rays_pass_where_the_alpha_lies_below_the_cutoff(props, trace):
    images = props.Images()
    holes = images.add([[(9, 9, 9, 255), (9, 9, 9, 127)]], mag_filter=9728, wrap_s=33071)
    world = np.eye(4)
    world[2, 3] = -1.0
    tracer = trace(
        [props.quad(), replace(props.quad(world=world), material=1)],
        [masked(holes), Material()],
        images=images,
    )
    hits = tracer.first_hits(np.array([[-0.5, 0.1, 1.0], [0.5, 0.1, 1.0]]), np.array([DOWN, DOWN]))
    assert hits.primitive.tolist() == [0, 1]
    assert np.abs(hits.distance - [1.0, 2.0]).max() < 1e-12


def test_a_stack_of_holes_is_passed_as_a_whole(props, trace):
    images = props.Images()
    nothing = images.add([[(0, 0, 0, 0)]])
    sheets = []
    for i in range(100):
        world = np.eye(4)
        world[2, 3] = -0.01 * i
        sheets.append(props.quad(world=world))
    world = np.eye(4)
    world[2, 3] = -2.0
    floor = replace(props.quad(world=world), material=1)
    tracer = trace([*sheets, floor], [masked(nothing), Material()], images=images)
    assert tracer.first_hits(np.array([[0.1, 0.2, 1.0]]), DOWN[None]).primitive[0] == 100


def test_hits_lie_between_the_two_bounds(props, trace):
    tracer = trace(props.quad(), Material(double_sided=True))
    origin, way = np.array([[0.1, 0.2, 1.0]] * 4), np.array([DOWN] * 4)
    near, far = np.array([0.0, 1.0, 1.01, 0.0]), np.array([np.inf, 1.0, np.inf, 0.99])
    assert tracer.first_hits(origin, way, t_min=near, t_max=far).valid.tolist() == [True, True, False, False]


def test_without_embreex_the_message_says_what_to_install(props, trace, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "embreex.rtcore_scene", None)
    with pytest.raises(MissingCapabilityError, match=r"pip install 'gltf-iri\[reference\]'"):
        trace(props.quad())
