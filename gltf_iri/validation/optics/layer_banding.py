"""How far apart the colours of neighbouring values of a period texture are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gltf_iri.errors import UsageError
from gltf_iri.validation.optics.film_colours import largest_difference
from gltf_iri.validation.optics.layer_colours import layer_colours, periods

if TYPE_CHECKING:
    from gltf_iri.validation.bragg.stack import Layer

__all__ = ["largest_step"]


def largest_step(layer: Layer, host_ior: float | None, levels: int) -> float:
    """Return the largest CIEDE2000, straight on, between texels that differ by one of `levels` − 1 steps.

    0 where the file does not say what the layer is, or says what no mirror can be.
    """
    try:
        rgb = layer_colours(layer, host_ior, periods(layer, np.linspace(0.0, 1.0, levels)))[0]
    except UsageError:
        return 0.0
    return largest_difference(rgb[1:], rgb[:-1])
