"""EXT_materials_bragg, its two textures: UV sets, colours in the same image, and what the image can hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.rules.data_textures import (
    LEVELS,
    VISIBLE_DELTA_E,
    conflicts_of,
    image_of,
    lossy_format,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.bragg.stack import Layer, Stack
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["Steps", "conflicts", "pictures"]

_CONFLICTS = {"overridden": "IRI_BRAGG_TEXCOORD_OVERRIDDEN", "decoded": "IRI_BRAGG_COLOUR_SPACE"}
_CODES_BY_BITS = {8: "IRI_BRAGG_PERIOD_BANDING", 16: "IRI_BRAGG_PERIOD_16_BITS"}

# ΔE a nanometre of 2 (n1 d1 + n2 d2), straight on: the worst of 300 random mirrors, ior2 1.05 to 4, up to 300
# cells, is 5.7. Below a sixth of a nanometre no step can be seen, and numpy stays where it is.
_STEEPEST_PER_NM = 6.0

# Ten milliseconds each: what a file with more layers than this asks for is not measured.
_MOST_MEASURED = 100


def conflicts(stack: Stack, asset: Asset, colours: dict[int, str]) -> Iterator[Issue]:
    """Yield what the textures contradict.

    colours : what `colour_images` returned.
    """
    for key in ("braggTexture", "braggPeriodTexture"):
        info: Entry | None = stack.entry.get(key)
        if info is not None:
            yield from conflicts_of(info, asset, colours, **_CONFLICTS)


class Steps:
    """The largest ΔE of a step of 8 bits, measured once for each kind of layer of a file."""

    __slots__ = ("_known",)

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], float] = {}

    def of(self, layer: Layer, host_ior: float | None) -> float:
        """Return the ΔE; 0 where no step can be seen, or too many layers were measured."""
        key = (host_ior, layer.ior1, layer.ior2, layer.fill, layer.cells, layer.periods_nm)
        if None in key or _path_step_nm(layer) * _STEEPEST_PER_NM < VISIBLE_DELTA_E:
            return 0.0
        if key not in self._known:
            if len(self._known) == _MOST_MEASURED:
                return 0.0
            from gltf_iri.validation.optics.layer_banding import largest_step

            self._known[key] = largest_step(layer, host_ior, LEVELS)
        return self._known[key]


def pictures(stack: Stack, asset: Asset, steps: Steps) -> Iterator[Issue]:
    """Yield what the image of the period texture means for the layers."""
    info: Entry | None = stack.entry.get("braggPeriodTexture")
    varying = [layer for layer in stack.layers if _step_nm(layer) > 0.0]
    index = image_of(info, asset) if info is not None and varying else None
    image = asset.images.get(index) if index is not None else None
    if info is None or index is None or image is None or image.width * image.height == 1:
        return
    compression = lossy_format(image.media_type, asset.resources.image(index))
    if compression is not None:
        yield issue("IRI_BRAGG_PERIOD_LOSSY", info.pointer, format=compression)
    if image.pixel_format in ("luminance", "luminance-alpha"):
        strength = stack.entry.get("braggTexture")
        is_shared = strength is not None and strength.raw == info.raw
        yield issue("IRI_BRAGG_ONE_CHANNEL" if is_shared else "IRI_BRAGG_PERIOD_GREY", info.pointer)
    code = _CODES_BY_BITS.get(image.bits)
    if code is not None:
        delta_e, nm = max((steps.of(layer, stack.host_ior), _step_nm(layer)) for layer in varying)
        if delta_e >= VISIBLE_DELTA_E:
            yield issue(code, info.pointer, step=nm, delta_e=delta_e)


def _step_nm(layer: Layer) -> float:
    """Return what one value of 8 bits adds to the period; 0 where nothing is known, or an animation rules."""
    if layer.periods_nm is None or layer.is_animated("periodMinimum", "periodMaximum"):
        return 0.0
    return abs(layer.periods_nm[-1] - layer.periods_nm[0]) / (LEVELS - 1)


def _path_step_nm(layer: Layer) -> float:
    ior1, ior2, fill = (value or 0.0 for value in (layer.ior1, layer.ior2, layer.fill))
    return 2.0 * (fill * ior1 + (1.0 - fill) * ior2) * _step_nm(layer)
