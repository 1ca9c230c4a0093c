"""Plans within a budget count what the scene and the textures bring."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gltf_iri.budgets.choose import Asked
from gltf_iri.budgets.plans import plan_within, plans_within
from gltf_iri.budgets.search import UnkeptBudgetError
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
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


def test_why_nothing_keeps_a_budget_is_found_once_and_told_of_each(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def choose(reach: object, wanted: object, subject: str) -> None:
        asked.append(subject)
        raise UnkeptBudgetError("No way keeps it", subject, "the best is far.", 5.0)

    monkeypatch.setattr("gltf_iri.budgets.plans.choose_way", choose)
    film = Iridescence(1.0, None, 1.4, 200.0, 400.0)
    glass = [Material(name=name, iridescence=film) for name in ("a", "b")]
    model: Any = SimpleNamespace(materials=[*glass, Material(name="plain")], document=None)
    given = {"size_pixels": 100, "has_image_light": False}
    with pytest.raises(UnkeptBudgetError, match="No way keeps it for material 'a': the best is far"):
        plans_within(model, None, 0.3, **given)
    asked.clear()
    unkept: dict[int, UnkeptBudgetError] = {}
    plans = plans_within(model, None, 0.3, **given, unkept=unkept)
    assert asked == ["material 'a'"]
    assert {index: str(error) for index, error in unkept.items()} == {
        0: "No way keeps it for material 'a': the best is far.",
        1: "No way keeps it for material 'b': the best is far.",
    }
    assert [plan.method for plan in plans] == ["khr-guarded", "khr-guarded", None]
    assert [plan.way for plan in plans] == [None] * 3


def test_light_that_crosses_layers_is_asked_for_where_their_base_lets_it_through(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked = []
    monkeypatch.setattr(
        "gltf_iri.budgets.plans.choose_layers", lambda plan, wanted, _: asked.append(wanted) or plan
    )
    bragg = Bragg(1.0, layers=(MirrorLayer(ior_2=1.6, cells=3, roughness=0.4),))
    known: list[Any] = []
    for share, colour in ((None, 1.0), (0.5, 1.0), (0.5, 0.0), (0.7, 1.0)):
        pbr = MetallicRoughness((colour, colour, colour, 1.0), metallic_factor=0.0)
        glass = None if share is None else Transmission(factor=share)
        plan_within(
            Material(pbr=pbr, bragg=bragg, transmission=glass),
            0,
            Asked(1.0, 1e6, "glsl"),
            chosen_layers=known,
        )
    # A black base lets nothing through; how much another lets does not matter.
    assert [each.is_crossed for each in asked] == [False, True, False]
