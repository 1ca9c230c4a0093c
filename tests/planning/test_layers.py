"""What is planned of Bragg layers: the simpler of two cases that look the same, and why."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.layers import plan_layers
from gltf_iri.planning.reach import Span

ROUGH = MirrorLayer(ior_2=1.5, period_min_nm=200.0, period_max_nm=300.0, cells=10, roughness=0.4)
BLACK = MetallicRoughness(base_color_factor=(0.0, 0.0, 0.0, 1.0), metallic_factor=0.0)
WHITE = MetallicRoughness(metallic_factor=0.0)


def planned(*layers: MirrorLayer, pbr: MetallicRoughness = WHITE, **bragg: object) -> LayersPlan:
    made = Bragg(1.0, layers=layers, **bragg)  # type: ignore[arg-type]
    plan = plan_layers(Material(pbr=pbr, bragg=made))
    assert plan is not None
    return plan


def test_no_layers_is_plain_pbr() -> None:
    for bragg in (
        None,
        Bragg(1.0),
        Bragg(0.0, layers=(ROUGH,)),
    ):
        assert plan_layers(Material(bragg=bragg)) is None
        assert plan_material(Material(bragg=bragg), 0).layers is None


def test_a_smooth_layer_that_mirrors_nothing_is_left_out_among_others() -> None:
    plan = planned(MirrorLayer(ior_2=1.0), ROUGH, MirrorLayer(fill=1.0))
    assert [layer.source for layer in plan.layers] == [1]
    assert any("layer 0 is left out" in told for told in plan.simpler)
    assert [layer.source for layer in planned(MirrorLayer(ior_2=1.0), MirrorLayer(ior_2=1.0)).layers] == [1]


def test_rough_facets_that_mirror_nothing_still_mask_each_other() -> None:
    plan = planned(MirrorLayer(ior_2=1.0, roughness=0.5), ROUGH)
    assert [layer.source for layer in plan.layers] == [0, 1]
    colours = layer_colours("layers-bands", planned_stack(plan))
    grazing = np.array([0.1])
    masked = 2.0 * 0.1 / (0.1 + np.sqrt(0.0625 + 0.9375 * 0.01))  # Smith's G₁ at α = 1/4
    alone = layer_colours("layers-bands", planned_stack(planned(MirrorLayer(ior_2=1.0, roughness=0.5))))
    assert alone.entering(grazing) == pytest.approx(masked, abs=1e-6)
    assert np.all(colours.entering(grazing) < masked)


def test_one_cell_in_a_host_of_its_own_is_a_film() -> None:
    film = MirrorLayer(ior_2=1.5, period_min_nm=400.0, period_max_nm=400.0, fill=0.25, roughness=0.4)
    assert any("300 nm of n2 = 1.5" in told for told in planned(film).simpler)
    assert planned(MirrorLayer(ior_1=1.4, roughness=0.4)).simpler == ()


def test_cells_without_a_first_film_are_one_slab_of_the_second() -> None:
    cells = MirrorLayer(ior_2=1.5, period_min_nm=60.0, period_max_nm=80.0, fill=0.0, cells=5, roughness=0.4)
    plan = planned(cells, period_texture=TextureInfo(0))
    assert (plan.layers[0].cells, plan.layers[0].period_nm) == (1, (300.0, 400.0))
    assert any("layer 0 is a film: 5 cells" in told and "300 to 400 nm" in told for told in plan.simpler)
    bending = planned(replace(cells, ior_1=1.4))
    assert bending.layers[0].cells == 1 and any("one slab" in told for told in bending.simpler)


def test_a_slab_of_cells_reflects_as_the_cells_do() -> None:
    layer = MirrorLayer(ior_2=1.5, period_max_nm=80.0, fill=0.0, cells=5)
    (slab,) = planned(layer).layers
    one, many = (
        Mirror.of([1.0, 0.6, 0.1], slab.n1, 1.5, 0.0, nm, cells)
        for nm, cells in ((slab.period_nm[0], slab.cells), (80.0, 5))
    )
    assert evaluate("yeh-spectral", one).rgb == pytest.approx(evaluate("yeh-spectral", many).rgb, abs=1e-12)


def test_a_smooth_layer_has_the_least_roughness() -> None:
    plan = planned(MirrorLayer(ior_2=1.5, cells=10))
    assert plan.layers[0].alpha == ALPHA_MIN
    assert any("unfiltered" in told for told in plan.simpler)


def test_nothing_passes_to_a_black_base() -> None:
    assert planned(ROUGH, ROUGH, pbr=BLACK).under == "nothing"
    assert planned(ROUGH, ROUGH).under == "base"
    # A metal of F0 = 0 still mirrors what grazes it.
    assert planned(ROUGH, pbr=MetallicRoughness(base_color_factor=(0.0, 0.0, 0.0, 1.0))).under == "base"


def test_what_passes_is_asked_for_where_light_comes_from_behind() -> None:
    bragg = Bragg(1.0, layers=(ROUGH,))
    for pbr, under in ((WHITE, "base"), (BLACK, "nothing")):
        plan = plan_layers(Material(pbr=pbr, bragg=bragg, transmission=Transmission(1.0)))
        assert plan is not None and plan.under == under


def test_one_layer_on_black_needs_its_colour_alone() -> None:
    alone, two = planned(ROUGH, pbr=BLACK), planned(ROUGH, ROUGH, pbr=BLACK)
    assert alone.tables is not None and alone.tables.is_colour
    assert two.tables is not None and not two.tables.is_colour and two.tables.bands == 16


def test_periods_vary_where_a_texture_can_move_them() -> None:
    texture = TextureInfo(0)
    plan = planned(ROUGH, period_texture=texture)
    assert plan.texel == Span(0.0, 1.0) and plan.layers[0].period_nm == (200.0, 300.0)
    assert plan.tables is not None and plan.tables.period_nodes > 1
    still = MirrorLayer(ior_2=1.5, period_min_nm=300.0, period_max_nm=300.0, cells=10)
    assert planned(still, period_texture=texture).texel.is_point
    assert planned(ROUGH).layers[0].period_nm == (300.0, 300.0)


@pytest.mark.parametrize(
    ("method", "has_tables"),
    [("layers-bands", True), ("layers-rgb", True), ("layers-single-table", True), ("layers-single", False)],
)
def test_a_method_for_layers_is_kept_to(method: str, has_tables: bool) -> None:
    material = Material(pbr=WHITE, bragg=Bragg(1.0, layers=(ROUGH, ROUGH)))
    layers = plan_material(material, 0, method=method).layers
    assert layers is not None
    assert layers.method == method and layers.reason == "asked for"
    assert (layers.tables is not None) == has_tables


def test_tables_of_colours_are_told_as_the_exact_ones_they_are() -> None:
    material = Material(pbr=WHITE, bragg=Bragg(1.0, layers=(ROUGH, ROUGH)))
    layers = plan_layers(material, method="layers-rgb")
    assert layers is not None and layers.parameters == {"reflectance": "yeh-spectral"}
    with pytest.raises(UsageError, match="exact colours: leave 'reflectance' out"):
        plan_layers(material, method="layers-rgb", parameters={"reflectance": "bloch"})


def test_a_method_for_films_leaves_layers_to_the_plan() -> None:
    material = Material(pbr=WHITE, bragg=Bragg(1.0, layers=(ROUGH,)))
    layers = plan_material(material, 0, method="spectral").layers
    assert layers is not None and layers.method == "layers-bands"


def test_the_plan_is_told_as_json() -> None:
    told = plan_material(Material(pbr=WHITE, bragg=Bragg(1.0, layers=(ROUGH,))), 0).to_json()["layers"]
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    assert told["method"] == "layers-bands" and told["tables"]["bytes"] > 0
    assert plan_material(Material(), 0).to_json()["layers"] is None
