"""Between the kept layers of a blurred environment, blur grows with roughness without a step back."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.scene.model import Environment
from gltf_iri.scene.studio import directions


@pytest.fixture(scope="module")
def patch():
    """White about +Z, fading out over 25°: too wide for a lamp. One object: it is prefiltered once."""
    towards = np.clip((directions(64)[..., 2] - 0.9) / 0.1, 0.0, 1.0)
    return Environment("patch", np.repeat(towards[..., None], 3, axis=-1).astype(np.float32))


def test_a_patch_of_light_grows_dimmer_with_every_step_of_roughness(stage, props, patch):
    """Three steps from one layer (a factor of √2) to the next, from the sharp map on."""
    brightest = []
    for roughness in (0.0, *2.0 ** np.arange(-4.9, 0.0, 1.0 / 6.0), 1.0):
        metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=float(roughness)))
        view = {"environment": patch, "size": (24, 24), "with_inputs": True, "samples": 0}
        brightest.append(stage.draw(props.quad(), metal, **view).inputs.reflected_radiance[12, 12, 0])
    steps = np.diff(np.array(brightest, np.float64))
    assert steps.max() <= 1e-4
    assert brightest[0] == pytest.approx(1.0, abs=0.02)
    assert brightest[-1] < 0.3
    # No step is much longer than the ones around it.
    assert steps.min() > -0.12
