"""EXT_materials_bragg, what is legal and does nothing, or hardly what was meant.

Nothing is told of a property that an animation moves: what the file states holds only until it starts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from gltf_iri.validation.bragg.stack import Layer, Stack
from gltf_iri.validation.codes import issue
from gltf_iri.validation.issue import Issue

__all__ = ["effects"]

# Keeps the end of a band a number where one index is 10¹⁶ times the other.
_LEAST_GAP = 1e-16

# The ends of the CIE 1931 observer's table, which the text's colour integral runs over.
_SEEN_NM = (360.0, 830.0)

# n1 d1 + n2 d2 of one cell. Of 60 random mirrors (ior2 1.2 to 2.2 in air, 1 to 29 cells) as thick, half are
# within CIEDE2000 0.9 of the grey of their luminance; at 10 µm within 2.4, at 2 µm within 18.
_GREY_NM = 2e4

# Indices that single precision cannot tell apart: exporters write 1.33 as 1.3300000429153442.
_SAME_INDEX = 1e-6

_OF_FILMS = ("ior1", "ior2", "fill", "periodMinimum", "periodMaximum")


def effects(stack: Stack) -> Iterator[Issue]:
    """Yield what is to be said of a stack whose numbers are all allowed."""
    entry = stack.entry
    if "layers" not in entry.raw:
        yield issue("IRI_BRAGG_NO_LAYERS", entry.pointer)
        return
    stated = "braggFactor" in entry.raw
    if stack.count and not stack.is_active:
        place = entry.at("braggFactor") if stated else entry.pointer
        yield issue("IRI_BRAGG_FACTOR_ZERO", place, by_default="" if stated else " by default")
        return
    for layer in stack.layers:
        yield from _periods(layer, has_texture=stack.has_period_texture)
        yield from _mirror(layer, stack.host_ior)
    if stack.has_period_texture and _are_periods_constant(stack):
        yield issue("IRI_BRAGG_PERIOD_TEXTURE_UNUSED", entry.at("braggPeriodTexture"))


def _are_periods_constant(stack: Stack) -> bool:
    return len(stack.layers) == stack.count and all(
        layer.periods_nm is not None
        and layer.periods_nm[0] == layer.periods_nm[1]
        and not layer.is_animated("periodMinimum", "periodMaximum")
        for layer in stack.layers
    )


def _periods(layer: Layer, *, has_texture: bool) -> Iterator[Issue]:
    if layer.periods_nm is None or layer.is_animated("periodMinimum", "periodMaximum"):
        return
    place, low, high = layer.entry.at("periodMinimum"), layer.periods_nm[0], layer.periods_nm[-1]
    if low > high:
        yield issue("IRI_BRAGG_PERIODS_REVERSED", place, low=low, high=high)
    # Many writers state both ends alike, which does no harm.
    if not has_texture and layer.entry.get("periodMinimum", high) != high:
        yield issue("IRI_BRAGG_PERIOD_RANGE_WITHOUT_TEXTURE", place)


def _mirror(layer: Layer, host_ior: float | None) -> Iterator[Issue]:
    ior1, ior2, fill, cells = layer.ior1, layer.ior2, layer.fill, layer.cells
    if ior1 is None or ior2 is None or fill is None or cells is None or layer.periods_nm is None:
        return
    pointer = layer.entry.pointer
    idle = _idle(layer, ior1, ior2, fill, layer.periods_nm)
    if idle:
        step = "" if ior1 == host_ior else "; what is left is the step from hostIor to ior1"
        yield issue("IRI_BRAGG_NO_MIRROR", pointer, reason=f"{idle}{step}")
    elif layer.is_animated(*_OF_FILMS):
        return
    elif fill == 0.0:
        yield issue("IRI_BRAGG_ONE_FILM", layer.entry.at("fill"), cells=f"{cells:g}")
    else:
        if cells == 1.0 and ior1 == host_ior:
            yield issue("IRI_BRAGG_ONE_CELL", pointer)
        yield from _band(pointer, ior1, ior2, fill, cells, layer.periods_nm)


def _idle(layer: Layer, ior1: float, ior2: float, fill: float, periods_nm: tuple[float, ...]) -> str:
    if abs(ior1 - ior2) < _SAME_INDEX and not layer.is_animated("ior1", "ior2"):
        return f"both films have the index {ior1:g}"
    if fill == 1.0 and not layer.is_animated("fill"):
        return "fill is 1, so that it has no thickness"
    if max(periods_nm) == 0.0 and not layer.is_animated("periodMinimum", "periodMaximum"):
        return "the period is 0"
    return ""


def _band(
    pointer: str, ior1: float, ior2: float, fill: float, cells: float, periods_nm: tuple[float, ...]
) -> Iterator[Issue]:
    """Tell of mirrors whose bands are beside what is seen, or too many there.

    Where light meets a cell head-on its first order lies at λ = 2 (n1 d1 + n2 d2), at all other angles
    below; the order m at λ/m. The band of a quarter-wave stack, the widest, reaches to
    λ/(1 − 2/π asin |n2 − n1|/(n2 + n1)) (Yeh 1988, §6.3), that of few cells λ/N beyond.
    """
    mean_ior = fill * ior1 + (1.0 - fill) * ior2
    shortest, longest = min(periods_nm) * mean_ior, max(periods_nm) * mean_ior
    low_nm, high_nm = _SEEN_NM
    contrast = 2.0 / math.pi * math.asin(abs(ior2 - ior1) / (ior1 + ior2))
    end_nm = 2.0 * longest * (1.0 / max(1.0 - contrast, _LEAST_GAP) + 1.0 / cells)
    if end_nm < low_nm:
        width = 2.0 * (end_nm - 2.0 * longest)
        yield issue("IRI_BRAGG_BAND_INVISIBLE", pointer, nm=2.0 * longest, width=width, end=low_nm)
    elif shortest >= _GREY_NM:
        orders = 2.0 * shortest * (1.0 / low_nm - 1.0 / high_nm)
        yield issue("IRI_BRAGG_WASHED_OUT", pointer, nm=shortest, orders=orders)
