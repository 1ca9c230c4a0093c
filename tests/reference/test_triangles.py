"""Where a ray meets a triangle: against 50 digits, and without a gap between neighbours."""

from __future__ import annotations

import mpmath
import numpy as np

from gltf_iri.reference.triangles import intersect, world_triangles


def exact(corners, origin, direction):
    """Distance and barycentrics from Cramer's rule on o + t d = Σ wᵢ pᵢ, in 50 digits."""
    with mpmath.workdps(50):
        p = [[mpmath.mpf(float(x)) for x in corner] for corner in corners]
        o, d = [mpmath.mpf(float(x)) for x in origin], [mpmath.mpf(float(x)) for x in direction]
        rows = [[p[0][k], p[1][k], p[2][k], -d[k], o[k]] for k in range(3)] + [[1, 1, 1, 0, 1]]
        matrix = mpmath.matrix([row[:4] for row in rows])
        weights = mpmath.lu_solve(matrix, mpmath.matrix([row[4] for row in rows]))
        return float(weights[3]), [float(w) for w in weights[:3]]


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def test_distances_and_barycentrics_are_those_of_50_digits():
    rng = np.random.default_rng(11)
    corners = rng.normal(size=(60, 3, 3)) * 10.0 ** rng.uniform(-3, 3, (60, 1, 1))
    inside = np.einsum("nc,nck->nk", rng.dirichlet((1, 1, 1), 60), corners)
    size = np.abs(corners - inside[:, None]).max(axis=(1, 2))
    directions = unit(rng.normal(size=(60, 3)))
    origins = inside - directions * size[:, None]
    distance, weights, _ = intersect(corners, origins, directions)
    for i in range(60):
        t, w = exact(corners[i], origins[i], directions[i])
        assert abs(distance[i] - t) < 1e-11 * size[i]
        assert np.abs(weights[i] - w).max() < 1e-10


def test_rays_aimed_beside_a_triangle_pass_it():
    rng = np.random.default_rng(5)
    corners = rng.normal(size=(200, 3, 3))
    outside = rng.dirichlet((1, 1, 1), 200)
    outside[:, 0] = -0.001
    outside[:, 1:] *= (1.001 / outside[:, 1:].sum(axis=1))[:, None]
    aim = np.einsum("nc,nck->nk", outside, corners)
    directions = unit(rng.normal(size=(200, 3)))
    assert np.all(np.isnan(intersect(corners, aim - directions, directions)[0]))


def test_no_ray_slips_between_two_triangles_with_a_common_edge():
    rng = np.random.default_rng(7)
    edge, apexes = rng.normal(size=(5000, 2, 3)), rng.normal(size=(5000, 2, 3))
    # Judged where the two lie on both sides of the edge as the ray sees it: it must then meet one.
    directions = unit(rng.normal(size=(5000, 3)))
    along = edge[:, 1] - edge[:, 0]
    across = np.cross(directions, along)
    side = np.sum(across * (apexes - edge[:, :1]).transpose(1, 0, 2), axis=-1)
    apart = side[0] * side[1] < 0
    aim = edge[:, 0] + rng.uniform(size=(5000, 1)) * along
    origins = aim - 3.0 * directions
    left = np.stack([edge[:, 0], edge[:, 1], apexes[:, 0]], axis=1)
    right = np.stack([edge[:, 1], edge[:, 0], apexes[:, 1]], axis=1)
    met = [~np.isnan(intersect(side, origins, directions)[0]) for side in (left, right)]
    assert apart.sum() > 1000
    assert np.all((met[0] | met[1])[apart])


def test_the_side_that_turns_counter_clockwise_is_told():
    corners = np.array([[[-1, -1, 0], [1, -1, 0], [0, 1, 0]]] * 2, float)
    origins, directions = np.array([[0, 0, 1], [0, 0, -1.0]]), np.array([[0, 0, -1], [0, 0, 1.0]])
    assert intersect(corners, origins, directions)[2].tolist() == [True, False]


def test_triangles_without_area_are_never_met():
    corners = np.array([[[-1, 0, 0], [0, 0, 0], [1, 0, 0]], [[0, 0, 0]] * 3], float)
    origins, directions = np.array([[0.5, 0, 1], [0, 0, 1.0]]), np.array([[0, 0, -1.0]] * 2)
    assert np.all(np.isnan(intersect(corners, origins, directions)[0]))


def test_faces_with_the_same_corners_share_a_place(props):
    scene = props.scene_of([props.quad(), props.quad(triangles=np.uint32([[2, 1, 0], [3, 2, 0]]))])[1]
    found = world_triangles(scene)
    places = [found.members[a:b].tolist() for a, b in zip(found.first[:-1], found.first[1:], strict=True)]
    assert sorted(places) == [[0, 2], [1, 3]]
