"""Plans within a budget count what the scene and the textures bring."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from gltf_iri.budgets.choose import Asked
from gltf_iri.budgets.plans import plan_within, plans_within
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.planning.effects import Effect


def test_colours_of_vertices_are_bases_that_a_budget_holds_for() -> None:
    gold = MetallicRoughness((0.9, 0.6, 0.3, 1.0), metallic_factor=1.0)
    metal = Material(pbr=gold, iridescence=Iridescence(factor=1.0))
    model: Any = SimpleNamespace(materials=[metal], document=None)
    for colours in (None, np.array([[0.2, 0.3, 0.9, 1.0], [0.8, 0.3, 0.1, 1.0]])):
        primitive = SimpleNamespace(material=0, colours=colours)
        scene: Any = SimpleNamespace(primitives=[primitive], lights=[])
        (plan,) = plans_within(model, scene, 0.3, size_pixels=10**9, has_image_light=False)
        table = plan.table("metal")
        assert table is not None
        assert (table.axis("base_f0") is not None) == (colours is not None)


def test_a_thickness_that_varies_within_pixels_is_averaged_in_opengl_alone() -> None:
    film = Iridescence(1.0, None, 1.4, 200.0, 400.0, TextureInfo(0))
    glass = Material(pbr=MetallicRoughness(metallic_factor=0.0), iridescence=film)
    spread = Effect.IRIDESCENCE_THICKNESS_SPREAD
    assert plan_within(glass, 0, Asked(2.0, 1e6, "glsl")).calls_for(spread)
    assert not plan_within(glass, 0, Asked(2.0, 1e6, "numpy")).calls_for(spread)
