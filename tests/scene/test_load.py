from __future__ import annotations

import dataclasses
import re

import numpy as np
import pytest

from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.extensions import supported_extensions
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.load import load

MATERIAL_EXTENSIONS = {
    "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_iridescence", "KHR_materials_specular", "KHR_materials_transmission",
    "KHR_materials_unlit", "KHR_materials_volume",
}  # fmt: skip


def test_every_extension_of_the_readme_may_be_required(triangle):
    names = {*MATERIAL_EXTENSIONS, "KHR_texture_transform", "KHR_lights_punctual", "EXT_texture_webp"}
    assert names <= set(supported_extensions())
    triangle.json["extensionsUsed"] = triangle.json["extensionsRequired"] = sorted(supported_extensions())
    assert len(triangle.load().scene().primitives) == 1


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("KHR_draco_mesh_compression", "without mesh compression"),
        ("EXT_meshopt_compression", "without mesh compression"),
        ("KHR_texture_basisu", "PNG, JPEG or WebP"),
        ("VENDOR_materials_magic", "export it without"),
    ],
)
def test_a_required_extension_that_is_not_read_is_refused_by_name(triangle, name, advice):
    triangle.json["extensionsUsed"] = triangle.json["extensionsRequired"] = ["KHR_materials_ior", name]
    with pytest.raises(AssetError, match=f"{name}.*{advice}") as caught:
        triangle.load()
    assert caught.value.pointer == "/extensionsRequired/1"
    assert caught.value.file == triangle.path


def test_an_optional_extension_that_is_not_read_is_noted(triangle):
    triangle.json["extensionsUsed"] = ["VENDOR_materials_magic", "KHR_materials_ior"]
    assert triangle.load().notes == (
        "Drawn without 'VENDOR_materials_magic', which this program does not read.",
    )


@pytest.mark.parametrize("name", ["KHR_animation_pointer", "KHR_materials_variants"])
def test_what_is_passed_over_is_noted(triangle, name):
    triangle.json["extensionsUsed"] = triangle.json["extensionsRequired"] = [name]
    assert [note for note in triangle.load().notes if note.startswith(name)]


def test_animations_are_noted(triangle):
    times, places = triangle.accessor([0.0, 1.0]), triangle.accessor([[0, 0, 0], [1, 0, 0]])
    sampler, target = {"input": times, "output": places}, {"node": 0, "path": "translation"}
    channel = {"sampler": 0, "target": target}
    triangle.json["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    assert any("not played" in note for note in triangle.load().scene().notes)


def test_a_file_that_does_not_exist_is_a_wrong_call(tmp_path):
    with pytest.raises(UsageError, match="absent"):
        load(tmp_path / "absent.glb")


def test_a_model_cannot_be_changed(triangle):
    with pytest.raises(dataclasses.FrozenInstanceError):
        triangle.load().notes = ()


def test_every_reference_asset_that_has_its_buffers_becomes_a_sound_scene(shared_dir):
    loaded = 0
    for path in sorted((shared_dir / "assets").glob("*/**/*.gl*")):
        if path.suffix not in (".glb", ".gltf"):
            continue
        if path.stem in ("CompareIridescence", "IridescenceMetallicSpheres"):
            missing = re.escape(f"'{path.stem}.bin' is missing")
            with pytest.raises(AssetError, match=missing):
                load(path).scene()
            continue
        model = load(path)
        scene = model.scene()
        loaded += 1
        for primitive in scene.primitives:
            assert primitive.triangles.max() < len(primitive.positions), path
            length = np.linalg.norm(primitive.normals.astype(np.float64), axis=1)
            np.testing.assert_allclose(length, 1, atol=1e-6, err_msg=str(path))
            assert primitive.material < len(model.materials), path
        assert np.all(np.isfinite(frame_scene(scene, aspect=1.5).view)), path
    assert loaded >= 19


def test_the_mirrored_reference_asset_has_mirrored_nodes(shared_dir):
    scene = load(shared_dir / "assets/plain/NegativeScaleTest/NegativeScaleTest.glb").scene()
    assert {p.is_mirrored for p in scene.primitives} == {False, True}
