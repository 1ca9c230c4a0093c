"""What is compared with the reference, what is left out, and how its noise is told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.comparison.pixels import is_rough
from gltf_iri.comparison.reference_judge import is_see_through, noisy_error, same_problem, same_surface
from gltf_iri.comparison.rig import rig
from gltf_iri.comparison.steepness import moved
from gltf_iri.planning.effects import Effect
from gltf_iri.reference.rays import camera_rays
from gltf_iri.reference.render import ReferenceFrame
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Primitive, Scene
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE


def reference_of(inputs, depth_m: float = 1.0) -> ReferenceFrame:
    """A reference that sees what `inputs` show, `depth_m` away."""
    shape = inputs.material.shape
    rgba = np.concatenate([inputs.colour, np.ones((*shape, 1))], axis=-1).astype(np.float64)
    return ReferenceFrame(
        rgba=rgba,
        material=inputs.material.astype(np.int64),
        depth_m=np.full(shape, depth_m),
        standard_error=np.zeros((*shape, 3)),
        edge_px=np.full(shape, np.inf),
        notes=(),
    )


def test_the_same_surface_is_one_material_at_one_depth_off_its_edges(row_of_pixels, camera) -> None:
    inputs = row_of_pixels(5)
    reference = reference_of(inputs)
    reference.material[0, 1] = 1
    reference.depth_m[0, 2] = 1.001
    reference.material[0, 3], reference.depth_m[0, 3] = -1, np.inf
    reference.edge_px[0, 4] = 0.001
    expected = [[True, False, False, False, False]]
    np.testing.assert_array_equal(same_surface(inputs, reference, camera), expected)


def test_pixels_on_edges_are_counted_and_not_compared(row_of_pixels) -> None:
    inputs = row_of_pixels(3)
    reference = reference_of(inputs)
    reference.rgba[0, 1, :3] += 0.5
    everywhere = np.ones((1, 3), np.bool_)
    is_same = np.array([[True, False, True]])
    flat = np.zeros((1, 3))
    result = same_problem(inputs, (), reference, everywhere, is_same, flat)
    assert (result.rough.pixels, result.edges, result.steep) == (2, 1, 0)
    assert result.rough.max_relative == 0.0
    assert not same_problem(inputs, (), reference, everywhere, everywhere, flat).agrees


def test_pixels_that_hang_on_a_rounding_are_counted_and_not_compared(row_of_pixels) -> None:
    inputs = row_of_pixels(2)
    reference = reference_of(inputs)
    reference.rgba[0, 1, :3] += 0.5
    everywhere = np.ones((1, 2), np.bool_)
    result = same_problem(inputs, (), reference, everywhere, everywhere, np.array([[0.0, 0.1]]))
    assert (result.rough.pixels, result.edges, result.steep) == (1, 0, 1)
    assert result.agrees


def test_smooth_pixels_are_reported_but_not_judged(row_of_pixels) -> None:
    inputs = row_of_pixels(2, perceptual_roughness=0.1)
    reference = reference_of(inputs)
    reference.rgba[..., :3] += 1.0
    everywhere = np.ones((1, 2), np.bool_)
    result = same_problem(inputs, (), reference, everywhere, everywhere, np.zeros((1, 2)))
    assert result.agrees
    assert result.rough.pixels == 0
    assert result.smooth.max_abs > GLSL_PIXEL_RELATIVE


def test_a_smooth_coat_keeps_a_rough_base_from_being_judged(row_of_pixels) -> None:
    assert is_rough(row_of_pixels(clearcoat=0.5, clearcoat_roughness=0.3), ()).all()
    assert not is_rough(row_of_pixels(clearcoat=0.5, clearcoat_roughness=0.1), ()).any()
    assert is_rough(row_of_pixels(clearcoat=0, clearcoat_roughness=0.1), ()).all()


@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
def test_a_moved_camera_sees_what_lies_beside_the_middle(camera, kind) -> None:
    """What was 3 pixels to the right of the middle and 2 below it is now there; far and near alike."""
    size = (64, 48)
    lens = replace(camera, kind=kind, zfar_m=10.0, xmag_m=0.4, ymag_m=0.3)
    origins, directions, _ = camera_rays(lens, size)
    place = (48 // 2 + 2) * 64 + 64 // 2 + 3
    rays = camera_rays(moved(lens, size, (3.0, 2.0)), size)
    middle = 48 // 2 * 64 + 64 // 2
    for t in (0.0, 1.0):
        wanted = origins[place] + t * directions[place]
        # Turned, the picture's pixels are a little wider apart: 3 pixels are some 0.05 of the lens.
        np.testing.assert_allclose(rays[0][middle] + t * rays[1][middle], wanted, atol=2e-4)


def test_a_difference_of_one_standard_error_is_as_large_as_the_noise() -> None:
    mean, error = np.full((2, 2, 3), 0.25), np.full((2, 2, 3), 0.01)
    everywhere = np.ones((2, 2), np.bool_)
    result = noisy_error(mean + error, mean, error, everywhere, 1.0)
    assert result.noise_mean == pytest.approx(result.error.delta_e_mean)
    assert result.noise_mean > 0.1
    assert noisy_error(mean, mean, 0.0 * error, everywhere, 1.0).noise_p95 == 0.0


def test_what_transmits_or_blends_is_see_through(plan) -> None:
    assert is_see_through(plan(Effect.TRANSMISSION))
    assert is_see_through(plan(Effect.ALPHA_BLEND))
    assert not is_see_through(plan(Effect.DIELECTRIC, Effect.ALPHA_MASK))


def scene_around(middle: np.ndarray, radius_m: float) -> Scene:
    corners = middle + radius_m * np.array([[-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0]])
    normals = np.tile(np.float32([0, 0, 1]), (4, 1))
    faces = np.array([[0, 1, 2], [1, 0, 3]], np.uint32)
    shape = Primitive("/meshes/0", "", 0, corners.astype(np.float32), normals, faces, np.eye(4))
    return Scene("", (shape,), (), ())


@pytest.mark.parametrize("radius_m", [1e-3, 1.0, 1e3])
def test_the_rig_lights_a_scene_of_any_size_alike(camera, radius_m) -> None:
    middle = np.array([1.0, 2.0, 3.0])
    lights = rig(scene_around(middle, radius_m), camera)
    face_on = [arriving(light, middle[None])[1].max() for light in lights]
    np.testing.assert_allclose(face_on, [2.0, 2.0, 3.0], rtol=1e-3)
    assert {light.kind for light in lights} == {"directional", "point", "spot"}


def test_the_rig_turns_with_the_camera(camera) -> None:
    """From the other side of a model, the key light comes from the other side too."""
    scene = scene_around(np.zeros(3), 1.0)
    turned = replace(camera, view=camera.view @ np.diag([-1.0, 1.0, -1.0, 1.0]))
    for front, back in zip(rig(scene, camera), rig(scene, turned), strict=True):
        np.testing.assert_allclose(front.direction * [-1.0, 1.0, -1.0], back.direction, atol=1e-12)
