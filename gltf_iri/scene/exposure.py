"""The exposure of a scene, read as with an incident light meter: from the light, not from the picture.

Light measures nothing about the model, so black stays black and white white, a turn around the model keeps
its brightness, and materials can be compared from picture to picture.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.spaces import rec709_to_xyz
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Environment, Light, Scene

__all__ = ["EXPOSURE_MAX_EV", "automatic_exposure", "light_level"]

Float64 = NDArray[np.float64]

# 2^64 and 2^-64 are far beyond any light and well inside float32.
EXPOSURE_MAX_EV: Final = 64.0

# A median needs no more, and a scene may have millions of vertices.
_POINTS_MAX: Final = 1024


def automatic_exposure(scene: Scene, environment: Environment | None) -> float:
    """Return −log2(`light_level`) in EV, in hundredths, so that the printed number gives the same picture.

    0 in the studio and in the white environment, when the file has no lights of its own, and 0 without light.
    """
    level = light_level(scene, environment)
    if not level > 0.0:
        return 0.0
    # math.inf, which lights of 1e38 cd reach together, becomes the darkest exposure.
    ev = EXPOSURE_MAX_EV if math.isinf(level) else math.log2(level)
    return round(-min(max(ev, -EXPOSURE_MAX_EV), EXPOSURE_MAX_EV), 2) + 0.0  # + 0.0: no "-0.0"


def light_level(scene: Scene, environment: Environment | None) -> float:
    """Return the radiance of a white card where the scene's surfaces are: 1 wants no correction.

    The environment's mean luminance over all directions, plus what its own lights give a card that faces
    each of them, E/π; of these the median over the scene's vertices, so that one surface close to a lamp
    decides nothing. Emission of materials is not light in this sense: rasterised, it reaches nothing.
    """
    level = 0.0 if environment is None else _mean_luminance(environment)
    return level + (_median_of_lights(scene.lights, scene.vertices()) if scene.lights else 0.0)


def _mean_luminance(environment: Environment) -> float:
    """Return the mean over all directions: rows weigh the solid angle of their pixels, sin θ."""
    rows = environment.radiance.mean(axis=1, dtype=np.float64)
    theta = (np.arange(len(rows)) + 0.5) / len(rows) * math.pi
    return float(np.average(_luminance(rows), weights=np.sin(theta)))


def _median_of_lights(lights: Sequence[Light], points: Float64) -> float:
    points = points[:: -(-len(points) // _POINTS_MAX)]
    with np.errstate(over="ignore"):  # ∞ is dealt with by the caller
        total = np.sum([_luminance(arriving(light, points)[1]) for light in lights], axis=0)
    return float(np.median(total)) / math.pi


def _luminance(rgb: Float64) -> Float64:
    """Return the luminance (...) of linear Rec.709 (..., 3); white's is 1."""
    return np.asarray(rec709_to_xyz(rgb)[..., 1] / rec709_to_xyz(np.ones(3))[1], dtype=np.float64)
