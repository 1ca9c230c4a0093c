"""OpenGL and the rays see a pane of dichroic glass alike: under lamps on either side, and in a white room."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import moderngl
import numpy as np
import pytest

from gltf_iri.baking.layer_fill import bake_layers
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.transmission import Transmission
from gltf_iri.planning.layer_plan import LayerTables
from gltf_iri.reference.render import render_reference
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import white
from gltf_iri.scene.model import Light
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

SIZE = (16, 12)
LAYERS = (
    MirrorLayer(ior_2=1.9, period_max_nm=170.0, cells=4, roughness=0.3),
    MirrorLayer(ior_2=1.7, period_max_nm=220.0, cells=3, roughness=0.5),
)


def pane(factor: float) -> Material:
    """A thin wall that scatters, mirrors and lets through."""
    return Material(
        pbr=MetallicRoughness(
            base_color_factor=(0.9, 0.8, 0.7, 1.0), metallic_factor=0.1, roughness_factor=0.7
        ),
        transmission=Transmission(0.8),
        bragg=Bragg(factor=factor, host_ior=1.3, layers=LAYERS),
    )


def leaning(props: SimpleNamespace, factor: float, **options: Any) -> tuple[Any, ...]:
    """Return model, scene and plans of a square that leans from the viewer; its tables are of few numbers."""
    world = np.eye(4)
    world[:3, :3] = [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]]
    model, scene, (plan,) = props.scene_of(props.quad(world=world), pane(factor), **options)
    layers = replace(plan.layers, tables=LayerTables(8, False, 65, 1, "f4", 0.0))
    return model, scene, (replace(plan, layers=layers),)


@pytest.fixture(scope="module")
def filled() -> dict[int, Any]:
    return {}


@pytest.fixture
def tables(filled: dict[int, Any], props: SimpleNamespace) -> dict[int, Any]:
    """The tables of the layers, filled once."""
    if not filled:
        _, _, (plan,) = leaning(props, 1.0)
        filled[plan.index] = bake_layers(plan.layers, "D65")
    return filled


@pytest.fixture
def renderer(gl_context: moderngl.Context):
    made = Renderer(gl_context)
    yield made
    made.release()


def test_lamps_on_either_side_are_seen_alike(
    renderer: Renderer, props: SimpleNamespace, tables: dict[int, Any]
) -> None:
    front = Light("", "directional", (1.0, 0.9, 0.8), 2.0, np.zeros(3), np.array([0.6, -0.48, -0.64]))
    behind = replace(front, direction=np.array([-0.48, 0.36, 0.8]))
    model, scene, plans = leaning(props, 0.6, lights=(front, behind))
    drawn = renderer.render(
        *(model, scene, plans, props.camera(), None),
        **{"size": SIZE, "float_textures": True, "with_inputs": True, "layer_tables": tables},
    ).inputs
    assert drawn is not None
    mine, half = (
        render_reference(
            *(model, replace(scene, lights=lit), plans, props.camera(), None),
            **{"size": SIZE, "lighting": "punctual", "processes": 1},
            **{"layer_method": None, "layer_tables": tables},
        )
        for lit in (scene.lights, (front,))
    )
    both = (mine.material >= 0) & (drawn.material >= 0)
    assert both.sum() > 40
    colour = mine.rgba[both][:, :3]
    assert (colour - half.rgba[both][:, :3]).min() > 1e-3  # the one behind is seen through the pane
    assert (np.abs(colour - drawn.colour[both]) / np.maximum(1.0, colour)).max() < GLSL_PIXEL_RELATIVE


def test_a_white_room_is_seen_alike(
    renderer: Renderer, props: SimpleNamespace, tables: dict[int, Any]
) -> None:
    """The pane's mean colour: what facets mirror, what the base scatters, and what crosses all once."""
    model, scene, plans = leaning(props, 1.0)
    drawn = renderer.render(
        *(model, scene, plans, props.camera(), white()),
        **{"size": SIZE, "samples": 0, "float_textures": True, "layer_tables": tables},
    ).rgba[..., :3]
    mine = render_reference(
        *(model, scene, plans, props.camera(), white()),
        **{"size": SIZE, "paths": 256, "processes": 1, "layer_method": None, "layer_tables": tables},
    )
    seen = mine.material >= 0
    rays, other = mine.rgba[seen][:, :3], drawn[seen].astype(np.float64)
    error = np.sqrt(np.mean(mine.standard_error[seen] ** 2, axis=0) / len(rays))
    # Eight bands multiply by fewer numbers than the tables of a white sky, which hold whole spectra.
    assert np.all(np.abs(rays.mean(axis=0) - other.mean(axis=0)) < 4 * error + 5e-3)
    assert error.max() < 6e-3
    assert np.ptp(rays.mean(axis=0)) > 0.05
