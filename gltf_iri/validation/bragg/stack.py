"""A material's layers as the rules ask for them: numbers with their defaults, and what is animated."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from gltf_iri.asset.limits import GREATEST_NUMBER
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.pointers.rules import animated_properties
from gltf_iri.validation.tables import value_of

__all__ = ["EXTENSION", "TRANSMISSION", "Layer", "Stack", "stacks"]

EXTENSION = "EXT_materials_bragg"
_PERIOD_TEXTURE = "braggPeriodTexture"

# Extensions by which a material lets light through, and the factor that says how much.
TRANSMISSION = {
    "KHR_materials_transmission": "transmissionFactor",
    "KHR_materials_diffuse_transmission": "diffuseTransmissionFactor",
}

Tokens = tuple[str, ...]


class Layer:
    """One layer; a number is None where the file has something else in its place.

    ior1 : of the first film, or the host's where the layer states none.
    periods_nm : the ends that the period runs between; without a texture the maximum alone.
    """

    __slots__ = ("_stack", "cells", "entry", "fill", "ior1", "ior2", "periods_nm", "position", "states_ior1")

    def __init__(self, stack: Stack, entry: Entry, position: int) -> None:
        self._stack = stack
        self.entry = entry
        self.position = position
        self.states_ior1 = "ior1" in entry.raw
        self.ior1 = number(entry, "ior1") if self.states_ior1 else stack.host_ior
        self.ior2 = number(entry, "ior2")
        self.fill = number(entry, "fill")
        self.cells = number(entry, "cells")
        keys = ("periodMinimum", "periodMaximum") if stack.has_period_texture else ("periodMaximum",)
        periods = [number(entry, key) for key in keys]
        self.periods_nm = None if None in periods else tuple(nm for nm in periods if nm is not None)

    def is_animated(self, *keys: str) -> bool:
        """Whether an animation moves one of these properties; for ior1 the host's counts where it follows."""
        if "ior1" in keys and not self.states_ior1 and self._stack.is_animated("hostIor"):
            return True
        return any(self._stack.is_animated("layers", str(self.position), key) for key in keys)


class Stack:
    """The layers of one material, and what lies around them.

    material, entry : the material, and its extension object.
    layers : those that are objects, outermost first; each knows its position in the file.
    count : how many the file has, broken ones too.
    """

    __slots__ = (
        *("_animated", "_place", "count", "entry", "has_period_texture", "host_ior", "layers"),
        "material",
    )

    def __init__(self, material: Entry, entry: Entry, position: int, animated: frozenset[Tokens]) -> None:
        self.material = material
        self.entry = entry
        self._place = ("materials", str(position), "extensions", EXTENSION)
        self._animated = animated
        self.host_ior = number(entry, "hostIor")
        self.has_period_texture = _PERIOD_TEXTURE in entry.raw
        listed = entry.get("layers", ())
        self.count = len(listed)
        self.layers = [Layer(self, layer, i) for i, layer in enumerate(listed) if layer is not None]

    @property
    def is_active(self) -> bool:
        """Whether there are layers at any time."""
        # A broken factor is one that will be mended.
        return self.count > 0 and (
            number(self.entry, "braggFactor") != 0.0 or self.is_animated("braggFactor")
        )

    def tokens(self, *keys: str) -> Tokens:
        """Return the tokens of the pointer to a property of the extension."""
        return (*self._place, *keys)

    def is_animated(self, *keys: str) -> bool:
        """Whether an animation moves the property of the extension that `keys` lead to."""
        return self.tokens(*keys) in self._animated

    def why_unbent(self, layer: Layer) -> str:
        """Return why the first index of `layer` must be the host's; "" where nothing says so."""
        if layer.position < self.count - 1:
            return "only the last layer may have another"
        pbr = self.material.raw.get("pbrMetallicRoughness", {})
        if isinstance(pbr, dict) and _is_above_zero(pbr.get("metallicFactor", 1.0)):
            return "metallicFactor is not 0" + ("" if "metallicFactor" in pbr else " (its default is 1)")
        for name, key in TRANSMISSION.items():
            carried = self.material.raw["extensions"].get(name)
            if isinstance(carried, dict) and _is_above_zero(carried.get(key, 0.0)):
                return f"{key} is not 0"
        return ""


def stacks(asset: Asset) -> Iterator[Stack]:
    """Yield the layers of each material that has the extension."""
    animated: frozenset[Tokens] | None = None
    for position, material in enumerate(asset.array("materials")):
        entry = material.extensions.get(EXTENSION) if material is not None else None
        if material is not None and entry is not None:
            if animated is None:
                animated = animated_properties(asset)
            yield Stack(material, entry, position, animated)


def _is_above_zero(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and value > 0.0


def number(entry: Entry, key: str) -> float | None:
    """Return a number of `entry`, its default where it is absent, None where it is broken."""
    if key in entry.raw and key not in entry:
        return None
    value: Any = value_of(entry, key)
    return float(min(value, GREATEST_NUMBER)) if value is not None else None
