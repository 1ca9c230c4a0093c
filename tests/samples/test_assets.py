"""Each sample, read back through the package's own road, shows what its README says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.samples import angle_fan, anodised_ramp, thickness_swatches
from gltf_iri.samples.collection import build_samples, write_samples
from gltf_iri.scene.load import load
from gltf_iri.scene.model import Primitive

SAMPLES = build_samples()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("samples")
    write_samples(path)
    return path


def primitives_of(path: Path) -> tuple[Primitive, ...]:
    return load(path).scene().primitives


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.name)
def test_sample_calls_for_films_or_layers_and_brings_a_camera(sample, folder: Path) -> None:
    model = load(folder / sample.file)
    shown = Effect.BRAGG if sample.fallback else Effect.IRIDESCENCE
    assert any(plan.calls_for(shown) for plan in plan_materials(model.materials))
    assert len(model.scene().cameras) == 1


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.name)
def test_triangles_face_the_way_their_normals_point(sample, folder: Path) -> None:
    for primitive in primitives_of(folder / sample.file):
        corners = primitive.positions[primitive.triangles].astype(np.float64)
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        shading = primitive.normals[primitive.triangles].sum(axis=1)
        assert np.all(np.sum(faces * shading, axis=-1) > 0.0)
        np.testing.assert_allclose(np.linalg.norm(primitive.normals, axis=-1), 1.0, atol=1e-5)


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.name)
def test_bitangent_points_up_in_the_texture(sample, folder: Path) -> None:
    """Along cross(normal, tangent)·w the texture coordinate v falls, as glTF's normal textures ask."""
    for primitive in primitives_of(folder / sample.file):
        if primitive.tangents is None:
            continue
        t = primitive.triangles
        edge_1 = (primitive.positions[t[:, 1]] - primitive.positions[t[:, 0]]).astype(np.float64)
        edge_2 = (primitive.positions[t[:, 2]] - primitive.positions[t[:, 0]]).astype(np.float64)
        uv = primitive.uvs[0].astype(np.float64)
        (u1, v1), (u2, v2) = (uv[t[:, 1]] - uv[t[:, 0]]).T, (uv[t[:, 2]] - uv[t[:, 0]]).T
        along_u = (edge_1 * v2[:, None] - edge_2 * v1[:, None]) / (u1 * v2 - u2 * v1)[:, None]
        along_v = (edge_2 * u1[:, None] - edge_1 * u2[:, None]) / (u1 * v2 - u2 * v1)[:, None]
        tangent = primitive.tangents[t[:, 0]].astype(np.float64)
        bitangent = np.cross(primitive.normals[t[:, 0]], tangent[:, :3]) * tangent[:, 3:]
        assert np.all(np.sum(along_u * tangent[:, :3], axis=-1) > 0.0)
        assert np.all(np.sum(along_v * bitangent, axis=-1) < 0.0)


def test_each_swatch_holds_its_exact_thickness(folder: Path) -> None:
    model = load(folder / "thickness-swatches" / "thickness-swatches.gltf")
    film = model.materials[0].iridescence
    texels = model.document.image(0).pixels[..., 1].astype(np.float64)
    span = film.thickness_max_nm - film.thickness_min_nm
    thickness_nm = film.thickness_min_nm + texels / 255.0 * span
    (swatches,) = model.scene().primitives
    u, v = swatches.uvs[0].T.astype(np.float64)
    height, width = texels.shape
    of_vertex = thickness_nm[np.floor(v * height).astype(int), np.floor(u * width).astype(int)]
    of_swatch = of_vertex.reshape(-1, 4)
    np.testing.assert_array_equal(of_swatch, of_swatch[:, :1] * np.ones(4))
    centre = swatches.positions.reshape(-1, 4, 3).mean(axis=1).round(2)
    page = np.lexsort((centre[:, 0], -centre[:, 1]))  # to the right, then down
    count = thickness_swatches.ROWS * thickness_swatches.COLUMNS
    np.testing.assert_allclose(of_swatch[page, 0], thickness_swatches.STEP_NM * np.arange(count), atol=1e-9)


def test_each_patch_of_the_fan_shows_its_angle(folder: Path) -> None:
    scene = load(folder / "angle-fan" / "angle-fan.glb").scene()
    towards_viewer = -np.linalg.inv(scene.cameras[0].view)[:3, :3] @ (0.0, 0.0, -1.0)
    for primitive in scene.primitives:
        cosines = np.unique(np.round(primitive.normals @ towards_viewer, 5))
        angles_deg = np.sort(np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))))
        np.testing.assert_allclose(angles_deg, angle_fan.ANGLES_DEG, atol=0.01)


def test_patches_of_the_fan_do_not_hide_each_other(folder: Path) -> None:
    for primitive in load(folder / "angle-fan" / "angle-fan.glb").scene().primitives:
        x = primitive.positions[:, 0].reshape(-1, 4)
        gaps = x[1:].min(axis=1) - x[:-1].max(axis=1)
        assert np.all(gaps > 0.0)


def test_a_place_on_the_rod_is_a_thickness(folder: Path) -> None:
    """u at the rod's ends is the centre of the first and last texel, so the ramp is linear between them."""
    model = load(folder / "anodised-ramp" / "anodised-ramp.gltf")
    texels = model.document.image(0).pixels[0, :, 1]
    np.testing.assert_array_equal(texels, np.arange(256))
    (rod,) = model.scene().primitives
    along = rod.positions[:, 0].astype(np.float64) / anodised_ramp.LENGTH_M + 0.5
    np.testing.assert_allclose(rod.uvs[0][:, 0] * 256.0 - 0.5, along * 255.0, atol=2e-2)
