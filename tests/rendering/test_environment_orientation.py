"""From the bytes of a file to the pixel: one direction of light for mirrors, rough metal, chalk and eyes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.microfacet import d_ggx, v_smith_ggx_correlated
from gltf_iri.scene.environment import read_environment

HEIGHT = 32

# Of some 13 that the lean moves the light; in a mirrored map it would lie twice as far off.
BACKGROUND_WITHIN_PX = 3.0

DIRECTIONS = {
    "+X": (1, 0, 0),
    "+Y": (0, 1, 0),
    "-Z": (0, 0, -1),
    "left above behind": (-0.5, 0.6, -0.62),
}


def texels(direction):
    """Directions and solid angles of a map's texels, and which lie within 20° of `direction`.

    (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π).
    """
    polar = (np.arange(HEIGHT)[:, None] + 0.5) / HEIGHT * np.pi
    azimuth = ((np.arange(2 * HEIGHT) + 0.5) / (2 * HEIGHT) - 0.5) * 2.0 * np.pi
    x, y, z = np.sin(polar) * np.cos(azimuth), np.cos(polar) + 0 * azimuth, np.sin(polar) * np.sin(azimuth)
    directions = np.stack([x, y, z], axis=-1)
    solid_angle = np.sin(polar) * (np.pi / HEIGHT) ** 2 + 0 * azimuth
    return directions, solid_angle, directions @ direction >= np.cos(np.radians(20.0))


def hdr_with_a_patch(path, direction):
    """A Radiance file, dark but for 20° about `direction`."""
    lit = texels(direction)[2]
    pixels = np.where(lit[..., None], np.uint8([128, 128, 128, 132]), np.uint8([1, 2, 1, 100]))
    path.write_bytes(b"#?RADIANCE\n\n-Y %d +X %d\n" % (HEIGHT, 2 * HEIGHT) + pixels.tobytes())
    return path


def sent_by_facets(normal, outgoing, roughness, direction):
    """What rough metal sends from the patch, ∫ D V (N·L) dω / (A + B): most beside the mirror direction."""
    towards, solid_angle, lit = texels(direction)
    n_dot_v = np.clip(np.sum(normal * outgoing, axis=1), 1e-4, 1.0)
    total = np.zeros(len(normal))
    for light, share in zip(towards[lit], solid_angle[lit], strict=True):
        half = outgoing + light
        half /= np.linalg.norm(half, axis=1)[:, None]
        n_dot_l = np.clip(normal @ light, 0.0, 1.0)
        spread = np.sum(np.cross(normal, half) ** 2, axis=1)
        total += (
            share
            * n_dot_l
            * d_ggx(spread, roughness**2)
            * v_smith_ggx_correlated(n_dot_l, n_dot_v, roughness**2)
        )
    return total / np.sum(dfg_terms(n_dot_v, np.full(len(normal), roughness)), axis=0)


def middle_of(directions, radiance):
    """The mean of the directions in which there is next to the most radiance."""
    mean = directions[radiance >= 0.9 * radiance.max()].mean(axis=0)
    return mean / np.linalg.norm(mean)


def looking(props, forwards):
    """A camera 4 m off the origin that looks through it along `forwards`, +Y or +X upwards."""
    upwards = np.array([0.0, 1.0, 0.0]) if abs(forwards[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    right = np.cross(forwards, upwards)
    right /= np.linalg.norm(right)
    view = np.eye(4)
    view[:3, :3] = [right, np.cross(right, forwards), -forwards]
    view[2, 3] = -4.0
    return replace(props.camera(), view=view)


@pytest.mark.parametrize("name", DIRECTIONS)
def test_light_stands_where_the_file_has_it(stage, props, tmp_path, name):
    towards = np.array(DIRECTIONS[name], float) / np.linalg.norm(DIRECTIONS[name])
    sky = read_environment(hdr_with_a_patch(tmp_path / "patch.hdr", towards))
    aside = np.cross(towards, [0.36, 0.48, 0.8])
    aside /= np.linalg.norm(aside)
    # The eye stands 60° beside the light, so that neither its mirror image nor its shade is at the edge.
    view = looking(props, -(0.5 * towards + 0.75**0.5 * aside))
    eye = -view.view[:3, :3].T @ view.view[:3, 3]

    # A rough lobe is moved as one in place of being integrated at each pixel: some 4° are left.
    for roughness, within in ((0.0, 1.0), (0.5, 5.0)):
        metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness))
        inputs = stage.draw(
            props.sphere(), metal, environment=sky, seen_from=view, size=(96, 96), with_inputs=True
        ).inputs
        seen = inputs.material == 0
        normal = inputs.normal[seen].astype(float)
        outgoing = eye - inputs.position[seen]
        outgoing /= np.linalg.norm(outgoing, axis=1)[:, None]
        mirrored = 2.0 * np.sum(normal * outgoing, axis=1)[:, None] * normal - outgoing
        radiance = inputs.reflected_radiance[seen][:, 0].astype(float)
        expected = towards
        if roughness:
            expected = middle_of(mirrored, sent_by_facets(normal, outgoing, roughness, towards))
        off = np.degrees(np.arccos(middle_of(mirrored, radiance) @ expected))
        assert off <= within

    irradiance = inputs.irradiance[seen][:, 0].astype(float)
    brightest = normal[irradiance >= 0.98 * irradiance.max()].mean(axis=0)
    assert np.degrees(np.arccos(brightest @ towards / np.linalg.norm(brightest))) <= 4.0

    # Behind the scene: the light's place in the picture, wherever the eye turns.
    for lean in (-0.15, 0.15):
        forwards = (towards + lean * aside) / np.linalg.norm(towards + lean * aside)
        view = looking(props, forwards)
        speck = props.sphere(world=np.diag([1e-3, 1e-3, 1e-3, 1.0]))
        frame = stage.draw(speck, Material(), environment=sky, seen_from=view, size=(64, 64), samples=0)
        light = frame.rgba[..., 0].astype(float) ** 4  # the peak's place rather than the blur's
        row, column = np.indices(light.shape)
        at = np.array([np.sum(column * light), np.sum(row * light)]) / light.sum()
        across, _, ahead = view.view[:3, :3] @ towards
        upwards = (view.view[:3, :3] @ towards)[1]
        scale = 32.0 / np.tan(np.radians(20.0))
        expected = 31.5 + scale * np.array([across, -upwards]) / -ahead
        assert np.abs(at - expected).max() <= BACKGROUND_WITHIN_PX
