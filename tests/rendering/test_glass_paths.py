"""How far light runs inside of a body that is seen aslant, and where it leaves, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.scene.model import Environment
from gltf_iri.scene.studio import directions

INDEX = 1.5
KEPT = np.array([0.8, 0.5, 0.1])  # of each metre


def body(thickness_m):
    return Material(
        pbr=MetallicRoughness(metallic_factor=0.0, roughness_factor=0.0),
        transmission=Transmission(factor=1.0),
        specular=Specular(factor=0.0),
        ior=Ior(INDEX),
        volume=Volume(thickness_m, attenuation_distance_m=1.0, attenuation_color=tuple(KEPT)),
    )


def clear(thickness_m):
    return replace(body(thickness_m), volume=Volume(thickness_m))


def metres(rgb):
    """Beer's law backwards, one length for each channel."""
    return np.log(rgb) / np.log(KEPT)


@pytest.mark.parametrize("tilt_deg", [30.0, 60.0, 75.0])
def test_the_way_through_a_plate_is_slanted_as_snell_bends_it(stage, props, furnace, tilt_deg):
    angle = np.radians(tilt_deg)
    world = np.eye(4)
    world[0, [0, 2]], world[2, [0, 2]] = (np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))
    seen = stage.draw(props.quad(world=world), body(0.4), environment=furnace).rgba[32, 32, :3]
    inside = np.arcsin(np.sin(angle) / INDEX)
    assert metres(seen) == pytest.approx(np.full(3, 0.4 / np.cos(inside)), rel=1e-4)


@pytest.mark.parametrize(
    ("thickness_m", "exponent"),
    [(2.0, 1.0), (1.5, 0.5), (1.0, 0.0), (0.5, -0.5)],
    ids=["ball", "nearly", "straight", "bowl"],
)
def test_a_body_is_a_ball_as_far_as_its_curvature_fits_its_thickness(
    stage, props, furnace, thickness_m, exponent
):
    """On the unit sphere, along parallel rays: the way is thickness · cosθ^(2k − 1), k = thickness / 2."""
    frame = stage.draw(props.sphere(), body(thickness_m), environment=furnace, size=(128, 128), samples=0)
    column = np.arange(70, 118)
    beside = (column + 0.5) / 64.0 - 1.0
    inside = np.sqrt(1.0 - (np.hypot(beside, 0.5 / 64.0) / INDEX) ** 2)
    found = metres(frame.rgba[64, column, :3])
    # The curvature is that of the mesh's interpolated normals between neighbouring pixels.
    assert found == pytest.approx(np.outer(thickness_m * inside**exponent, np.ones(3)), rel=0.01)


@pytest.fixture(scope="module")
def slopes():
    """A sky whose colour is ½ + ½ · direction; one object, so that it is prefiltered once."""
    return Environment("slopes", (0.5 + 0.5 * directions(256)).astype(np.float32))


def test_light_leaves_a_ball_bent_twice_and_a_plate_as_it_came(stage, props, slopes):
    """It turns by θ − θ′ at each side of a ball, both ways towards the axis."""
    view = {"environment": slopes, "size": (128, 128), "samples": 0}
    ball = stage.draw(props.sphere(), clear(2.0), **view).rgba
    column = np.arange(66, 122)
    beside = (column + 0.5) / 64.0 - 1.0
    turn = 2.0 * (np.arcsin(beside) - np.arcsin(beside / INDEX))
    expected = np.stack([-np.sin(turn), 0.0 * turn, -np.cos(turn)], axis=-1)
    assert 2.0 * ball[64, column, :3] - 1.0 == pytest.approx(expected, abs=0.02)

    angle = np.radians(50.0)
    world = np.eye(4)
    world[0, [0, 2]], world[2, [0, 2]] = (np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))
    plate = stage.draw(props.quad(world=world), clear(0.4), **view).rgba
    assert 2.0 * plate[64, 64, :3] - 1.0 == pytest.approx([0.0, 0.0, -1.0], abs=0.01)


def test_light_that_a_body_bends_sees_the_sky_and_not_the_backdrop(stage, props, slopes):
    """A backdrop is what is shown straight behind the scene: through a pane it is seen, bent it is not."""
    before_paper = replace(slopes, backdrop=(0.25, 0.75, 0.5))
    view = {"environment": before_paper, "samples": 0}
    pane = stage.draw(props.quad(), replace(clear(0.4), volume=None), **view).rgba[32, 32, :3]
    assert pane == pytest.approx(before_paper.backdrop, abs=1e-6)
    ball = stage.draw(props.sphere(), clear(2.0), **view).rgba[32, 32, :3]
    assert 2.0 * ball - 1.0 == pytest.approx([0.0, 0.0, -1.0], abs=0.03)
