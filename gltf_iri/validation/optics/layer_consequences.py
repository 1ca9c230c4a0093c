"""What each remark about Bragg layers means for their colours: one more sentence, measured.

ΔE is CIEDE2000 under D65, the largest from straight on to 78° in the host and along the range of the periods.
Layers are taken as smooth mirrors; rough ones mix the colours of several angles, and differ by less.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from gltf_iri.errors import UsageError
from gltf_iri.validation.optics.film_colours import MIDDLE, MIDDLE_DECODED, largest_difference
from gltf_iri.validation.optics.layer_banding import largest_step
from gltf_iri.validation.optics.layer_colours import (
    COSINES,
    bare_colours,
    cost_of,
    layer_colours,
    periods,
    stack_colours,
)
from gltf_iri.validation.rules.data_textures import LEVELS

if TYPE_CHECKING:
    from gltf_iri.validation.bragg.stack import Layer, Stack
    from gltf_iri.validation.issue import Issue

__all__ = ["Consequences"]

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])

# Eight times what every reader must accept.
_MOST_LAYERS = 32

# Reflectances, for all remarks on one file: some seconds.
_MOST_REFLECTANCES = 50_000_000


class Consequences:
    """Measures what the remarks on one file mean, as long as that takes seconds."""

    def __init__(self) -> None:
        self._left = _MOST_REFLECTANCES

    def added_to(self, remark: Issue, stack: Stack) -> Issue:
        """Return the remark with its measured consequence, or as it is where nothing can be measured."""
        measured = _MEASURED.get(remark.code)
        if measured is None or len(stack.layers) > _MOST_LAYERS:
            return remark
        sentence, measure = measured
        try:
            cost = cost_of(stack)
            if cost > self._left:
                return remark
            self._left -= cost
            worst = measure(stack, remark)
        except UsageError:  # the file asks for what no mirror can be
            return remark
        if not math.isfinite(worst):
            return remark
        return remark._replace(message=f"{remark.message} {sentence.format(amount=_amount(worst))}")


def _amount(delta_e: float) -> str:
    if delta_e < 0.01:
        return "differ by less than ΔE 0.01"
    return f"differ by up to ΔE {delta_e:.{0 if delta_e >= 10.0 else 2 if delta_e < 0.1 else 1}f}"


def _from_bare(stack: Stack, remark: Issue) -> float:
    """Return what the layers do at full strength."""
    ends = (0.0, 1.0) if stack.has_period_texture else (1.0,)
    return max(largest_difference(stack_colours(stack, texel), bare_colours(stack)) for texel in ends)


def _from_grey(stack: Stack, remark: Issue) -> float:
    """Return how far the layer's own reflection is from the grey of its luminance."""
    layer = _layer_of(stack, remark)
    rgb = layer_colours(layer, stack.host_ior, periods(layer), COSINES)
    return largest_difference(rgb, (rgb @ _LUMINANCE)[..., None] * np.ones(3))


def _from_reverse(stack: Stack, remark: Issue) -> float:
    """Return how far the layer is from one whose ends are swapped."""
    layer = _layer_of(stack, remark)
    rgb = layer_colours(layer, stack.host_ior, periods(layer), COSINES)
    return largest_difference(rgb, rgb[:, ::-1])


def _at_minimum(stack: Stack, remark: Issue) -> float:
    """Return how far the layer is from what its periodMinimum would make of it."""
    layer = _layer_of(stack, remark)
    ends = [layer.entry["periodMinimum"], *periods(layer)]
    rgb = layer_colours(layer, stack.host_ior, ends, COSINES)
    return largest_difference(rgb[:, 0], rgb[:, 1])


def _between_texels(stack: Stack, remark: Issue) -> float:
    """Return how far apart two places of the texture can be."""
    if _is_strength(stack, remark):
        return _from_bare(stack, remark)
    return max(_spread(layer, stack) for layer in stack.layers)


def _spread(layer: Layer, stack: Stack) -> float:
    rgb = layer_colours(layer, stack.host_ior, periods(layer), COSINES)
    return largest_difference(rgb[:, :, None], rgb[:, None, :])


def _decoded(stack: Stack, remark: Issue) -> float:
    """Return what it does to decode the middle value as a colour."""
    if _is_strength(stack, remark):
        bare, full = bare_colours(stack), stack_colours(stack, 1.0)
        right, wrong = (bare + t * (full - bare) for t in (MIDDLE, MIDDLE_DECODED))
        return largest_difference(right, wrong)
    return max(_between(layer, stack, MIDDLE, MIDDLE_DECODED) for layer in stack.layers)


def _without_green(stack: Stack, remark: Issue) -> float:
    """Return what it does to read G as 0."""
    return max(_between(layer, stack, 0.0, 1.0) for layer in stack.layers)


def _between(layer: Layer, stack: Stack, one: float, other: float) -> float:
    rgb = layer_colours(layer, stack.host_ior, periods(layer, np.array([one, other])), COSINES)
    return largest_difference(rgb[:, 0], rgb[:, 1])


def _by_one_value(stack: Stack, remark: Issue) -> float:
    return max(largest_step(layer, stack.host_ior, LEVELS) for layer in stack.layers)


def _layer_of(stack: Stack, remark: Issue) -> Layer:
    """Return the layer that the remark is about."""
    pointer = f"{remark.pointer}/"
    for layer in stack.layers:
        if pointer.startswith(f"{layer.entry.pointer}/"):
            return layer
    raise UsageError("The remark is about no layer.")


def _is_strength(stack: Stack, remark: Issue) -> bool:
    """Return whether the remark is about braggTexture."""
    return f"{remark.pointer}/".startswith(f"{stack.entry.at('braggTexture')}/")


Measure = Callable[["Stack", "Issue"], float]

_WITHOUT = ("With and without the layers colours {amount}.", _from_bare)
_GREY = ("Its colours and their greys {amount}.", _from_grey)

# Code to a sentence about the largest ΔE, and how it is measured.
_MEASURED: dict[str, tuple[str, Measure]] = {
    "IRI_BRAGG_EXCLUDED": _WITHOUT,
    "IRI_BRAGG_FIRST_INDEX": _WITHOUT,
    "IRI_BRAGG_BEYOND_LIMITS": _WITHOUT,
    "IRI_BRAGG_FACTOR_ZERO": ("At factor 1 colours would {amount}.", _from_bare),
    "IRI_BRAGG_ONE_FILM": _GREY,
    "IRI_BRAGG_ONE_CELL": _GREY,
    "IRI_BRAGG_BAND_INVISIBLE": _GREY,
    "IRI_BRAGG_WASHED_OUT": _GREY,
    "IRI_BRAGG_PERIODS_REVERSED": ("Where readers order the two, colours {amount}.", _from_reverse),
    "IRI_BRAGG_PERIOD_RANGE_WITHOUT_TEXTURE": ("At minimum and maximum colours {amount}.", _at_minimum),
    "IRI_BRAGG_TEXCOORD_OVERRIDDEN": ("At other places of the texture colours {amount}.", _between_texels),
    "IRI_BRAGG_COLOUR_SPACE": ("At the middle value, decoded wrongly, colours {amount}.", _decoded),
    "IRI_BRAGG_PERIOD_LOSSY": ("Where compression is off by 1 of 255, colours {amount}.", _by_one_value),
    "IRI_BRAGG_PERIOD_GREY": ("Where G is lost, colours {amount}.", _without_green),
}
