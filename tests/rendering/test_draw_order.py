"""See-through surfaces are drawn from far to near, and share captures unless they lie over each other."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_material
from gltf_iri.rendering.draw import Draw
from gltf_iri.rendering.programs import ProgramStore
from gltf_iri.rendering.see_through import MAX_CAPTURES, group_sheets, sheets_in_order

GLASS = Material(transmission=Transmission(factor=1.0), pbr=MetallicRoughness(metallic_factor=0.0))
VEIL = Material(alpha_mode="BLEND")


def draw(primitive, material, at, size=1.0):
    world = np.diag([size, size, size, 1.0])
    world[:3, 3] = at
    return Draw(replace(primitive, world=world), plan_material(material, 0), {}, {}, {})


def groups(draws, camera):
    return list(group_sheets(sheets_in_order(draws, camera, (100, 100))))


def test_glasses_side_by_side_share_one_capture(props):
    row = [draw(props.sphere(), GLASS, (x, y, z), 0.2) for x, y, z in ((-1, 0, 0), (0, 0, 1), (1, 1, -1))]
    found = groups(row, props.camera(10.0))
    assert [group.is_capturing for group in found] == [True]
    assert len(found[0].sheets) == 3


def test_each_glass_behind_another_costs_one_capture(props):
    nest = [draw(props.sphere(), GLASS, (0, 0, 0), size) for size in (0.5, 1.0, 0.75)]
    found = groups(nest, props.camera(10.0))
    assert [group.is_capturing for group in found] == [True] * 3
    sizes = [group.sheets[0].draw.primitive.world[0, 0] for group in found]
    assert sizes == [0.5, 0.75, 1.0]


def test_a_veil_behind_glass_is_captured_and_one_before_it_is_not(props):
    found = groups(
        [
            draw(props.quad(), VEIL, (0, 0, 1)),
            draw(props.quad(), GLASS, (0, 0, 0)),
            draw(props.quad(), VEIL, (0, 0, -1)),
        ],
        props.camera(10.0),
    )
    assert [[s.draw.is_transmissive for s in group.sheets] for group in found] == [[False], [True, False]]
    assert [group.is_capturing for group in found] == [False, True]


def test_a_thin_wall_shows_its_far_faces_first_and_a_body_its_near_ones_alone(props):
    thin = replace(GLASS, double_sided=True)
    assert [
        [s.culled for s in g.sheets] for g in groups([draw(props.sphere(), thin, (0, 0, 0))], props.camera())
    ] == [
        ["front"],
        ["back"],
    ]
    body = replace(thin, volume=Volume(thickness_factor_m=1.0))
    (group,) = groups([draw(props.sphere(), body, (0, 0, 0))], props.camera())
    assert [sheet.culled for sheet in group.sheets] == [None]


def test_the_number_of_captures_is_bounded(props):
    panes = [draw(props.quad(), GLASS, (0, 0, 0.01 * i)) for i in range(2 * MAX_CAPTURES)]
    found = groups(panes, props.camera(10.0))
    assert sum(group.is_capturing for group in found) == MAX_CAPTURES
    assert sum(len(group.sheets) for group in found) == len(panes)


def test_a_bound_that_is_reached_is_told(stage, props):
    def frame(count):
        panes = [
            props.quad(world=draw(props.quad(), GLASS, (0, 0, 0.01 * i)).primitive.world)
            for i in range(count)
        ]
        return stage.draw(panes, GLASS, size=(8, 8), samples=0)

    assert any("deep" in note for note in frame(MAX_CAPTURES).notes)
    assert not any("deep" in note for note in frame(MAX_CAPTURES - 1).notes)


def test_what_reaches_behind_the_eye_may_cover_everything(props):
    around = [draw(props.sphere(), GLASS, (0, 0, 0), 20.0), draw(props.sphere(), GLASS, (3, 3, 0), 0.1)]
    assert [group.is_capturing for group in groups(around, props.camera(4.0))] == [True, True]


def test_more_textures_than_opengl_takes_at_once_are_told_with_the_material():
    weak = ProgramStore(SimpleNamespace(info={"GL_MAX_TEXTURE_IMAGE_UNITS": 2}))
    defines = ("HAS_DIELECTRIC", "HAS_BASE_COLOR_TEXTURE", "HAS_NORMAL_TEXTURE", "HAS_OCCLUSION_TEXTURE")
    with pytest.raises(MissingCapabilityError, match=r"'varnish' samples \d textures at once.* takes 2"):
        weak.get(defines, material="varnish")
