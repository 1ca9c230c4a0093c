"""What a plan leaves out is neither uploaded nor compiled, and what it folds is not to be seen."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from gltf_iri.asset.texture import Texture
from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import OcclusionTextureInfo, TextureInfo
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.permutation import permutation, plan_scene_effects
from gltf_iri.rendering.programs import surface_sources
from gltf_iri.scene.load import Model, load
from gltf_iri.scene.model import Scene

RGBA = (51, 102, 153, 204)


class Images:
    """Stands for a document of 2 × 2 images, one for each colour or list of four; `asked` lists readings."""

    def __init__(self, *texels) -> None:
        self.pixels = [np.broadcast_to(np.uint8(of), (4, 4)).reshape(2, 2, 4) for of in texels]
        self.asked: list[int] = []

    def texture(self, index):
        return Texture(index)

    def image(self, index):
        self.asked.append(index)
        return SimpleNamespace(pixels=self.pixels[index])


def draw(stage, props, furnace, material, images, *, knows_images=True, method=None, **options):
    primitive = props.sphere(
        uvs=(np.zeros((len(props.sphere().positions), 2), np.float32),),
        tangents=np.tile(np.float32([1, 0, 0, 1]), (len(props.sphere().positions), 1)),
    )
    model = Model(Path("stage"), images, (material,), ())
    scene = Scene("", (primitive,), (), ())
    known = {"document": images, "scene": scene} if knows_images else {}
    plans = plan_materials(model.materials, method=method, **known)
    images.asked.clear()  # what is read from here on is uploaded
    view = props.camera(half_height=1.0)
    return stage.renderer.render(model, scene, plans, view, furnace, size=(32, 32), **options)


def test_only_what_varies_and_is_read_is_uploaded(stage, props, furnace):
    varying = [(0, 0, 0, 255), (255, 255, 255, 255)] * 2
    images = Images(RGBA, varying, varying, (255, 255, 255, 255))
    material = Material(
        pbr=MetallicRoughness(base_color_texture=TextureInfo(1), metallic_roughness_texture=TextureInfo(0)),
        specular=Specular(0.0, TextureInfo(2)),
        occlusion_texture=OcclusionTextureInfo(3),
        iridescence=Iridescence(0.0, TextureInfo(2), thickness_texture=TextureInfo(2)),
    )
    draw(stage, props, furnace, material, images)
    assert images.asked == [1]
    draw(stage, props, furnace, material, images, knows_images=False)
    assert sorted(images.asked) == [0, 1, 3]


MATERIALS = {
    "film": Material(
        pbr=MetallicRoughness((0.9, 0.8, 0.7, 1.0), TextureInfo(0), 0.9, 0.6, TextureInfo(0)),
        specular=Specular(0.9, TextureInfo(0), (1.0, 0.8, 0.6), TextureInfo(0)),
        iridescence=Iridescence(0.9, TextureInfo(0), 1.4, 100.0, 900.0, TextureInfo(0)),
        emissive_texture=TextureInfo(0),
        emissive_factor=(0.1, 0.2, 0.3),
    ),
    "layers": Material(
        pbr=MetallicRoughness(roughness_factor=0.8),
        anisotropy=Anisotropy(0.8, 0.3, TextureInfo(0)),
        clearcoat=Clearcoat(0.8, TextureInfo(0), 0.5, TextureInfo(0)),
        sheen=Sheen((0.5, 0.6, 0.7), TextureInfo(0), 0.9, TextureInfo(0)),
    ),
}


# Of 8 bits OpenGL may filter with no more than it stores, and decode sRGB to within half a step.
@pytest.mark.parametrize(("float_textures", "bound"), [(True, 1e-6), (False, 2e-3)])
@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
def test_folding_a_texture_changes_no_picture(
    stage, props, furnace, material, float_textures, bound, record_property
):
    images = Images(RGBA)
    sampled = draw(
        stage, props, furnace, material, images, knows_images=False, float_textures=float_textures
    ).rgba
    assert set(images.asked) == {0}
    folded = draw(stage, props, furnace, material, images).rgba
    assert images.asked == []
    difference = np.abs(folded - sampled).max()
    record_property("measured", f"folded textures move a picture by {difference:.1e}")
    assert difference < bound


@pytest.mark.parametrize("method", ["khr", "khr-guarded", "fourier"])
def test_one_channel_of_a_grey_base_stands_for_all(stage, props, furnace, method):
    pbr = MetallicRoughness((0.7, 0.7, 0.7, 1.0), metallic_factor=0.5, roughness_factor=0.3)
    material = Material(pbr=pbr, iridescence=Iridescence(1.0, film_ior=1.4))
    options = {"method": method}
    grey = draw(stage, props, furnace, material, Images(), **options).rgba
    plain = draw(stage, props, furnace, material, Images(), knows_images=False, **options).rgba
    assert np.abs(grey - plain).max() < 1e-6


def test_a_scene_without_lights_compiles_no_light():
    film = Material(iridescence=Iridescence(1.0), pbr=MetallicRoughness(metallic_factor=0.5))
    dark = Scene("", (), (), ())
    defines = permutation(plan_material(film, 0), (), plan_scene_effects(dark, None))
    files = {Path(file).name for source in surface_sources(defines) for file in source.files}
    text = "".join(source.text for source in surface_sources(defines))
    assert files.isdisjoint(
        {"punctual.glsl", "direct.glsl", "environment.glsl", "dfg.glsl", "lobes.glsl", "film.glsl"}
    )
    assert not [word for word in ("u_lights", "u_light_count", "u_environment", "u_dfg") if word in text]
    lit = permutation(plan_material(film, 0), (), {Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT})
    assert len("".join(source.text for source in surface_sources(lit))) > 2 * len(text)


@pytest.mark.parametrize(
    ("path", "left_out", "grey"),
    [
        ("iridescence/IridescenceSuzanne/glTF-Binary/IridescenceSuzanne.glb", set(), {"dielectric"}),
        ("plain/TransmissionRoughnessTest/TransmissionRoughnessTest.glb", {Effect.METAL}, set()),
    ],
)
def test_real_files_lose_what_their_textures_rule_out(shared_dir, path, left_out, grey):
    model = load(shared_dir / "assets" / path)
    informed = plan_materials(model.materials, document=model.document, scene=model.scene())
    blind = plan_materials(model.materials)
    pruned = [set(b.effects) - set(a.effects) for a, b in zip(informed, blind, strict=False)]
    assert set().union(*pruned) >= left_out
    assert {lobe for plan in informed for lobe in plan.grey} >= grey
