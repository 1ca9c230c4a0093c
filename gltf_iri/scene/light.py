"""Punctual lights: KHR_lights_punctual."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError
from gltf_iri.scene.model import Light

__all__ = ["EXTENSION", "light_of_node", "read_light"]

Float64 = NDArray[np.float64]
Json = Mapping[str, Any]

EXTENSION: Final = "KHR_lights_punctual"

_KINDS: Final = ("directional", "point", "spot")


def light_of_node(document: Json, node: Json, pointer: str) -> tuple[Json, str] | None:
    """Return the light object that a node carries and its JSON Pointer, or None.

    Raises AssetError where the node refers to a light that does not exist.
    """
    carried = _object(node.get("extensions", {}), EXTENSION, f"{pointer}/extensions")
    if not carried:
        return None
    where = f"{pointer}/extensions/{EXTENSION}/light"
    listed = _object(document.get("extensions", {}), EXTENSION, "/extensions").get("lights")
    index = carried.get("light")
    if isinstance(index, bool) or not isinstance(index, int) or not isinstance(listed, list):
        raise AssetError(
            "the node refers to no light of /extensions/KHR_lights_punctual/lights", pointer=where
        )
    if not 0 <= index < len(listed):
        raise AssetError(f"there is no light {index}; the file has {len(listed)}", pointer=where)
    at = f"/extensions/{EXTENSION}/lights/{index}"
    if not isinstance(listed[index], Mapping):
        raise AssetError("a light must be an object", pointer=at)
    return listed[index], at


def read_light(description: Json, world: Float64, name: str, pointer: str) -> Light:
    """Return the light of a node whose world transform is `world` (4, 4).

    It shines along the node's −Z; the node's scale changes neither intensity nor range. Raises AssetError
    where a value is out of its range.
    """
    kind = description.get("type")
    if kind not in _KINDS:
        raise AssetError(f"the type of a light must be one of {', '.join(_KINDS)}", pointer=f"{pointer}/type")
    direction = -world[:3, 2]
    length = float(np.linalg.norm(direction))
    if kind != "point" and not length > 0.0:
        raise AssetError("the light's node is scaled to 0, so it shines nowhere", pointer=pointer)
    inner, outer = 0.0, math.pi / 4.0
    if kind == "spot":
        spot = _object(description, "spot", pointer)
        inner = _number(spot, "innerConeAngle", 0.0, f"{pointer}/spot")
        outer = _number(spot, "outerConeAngle", math.pi / 4.0, f"{pointer}/spot")
        if not 0.0 <= inner < outer <= math.pi / 2.0 * (1.0 + 1e-6):  # π/2 may have passed through float32
            raise AssetError(
                "the cone wants 0 ≤ innerConeAngle < outerConeAngle ≤ π/2", pointer=f"{pointer}/spot"
            )
    reach = _number(description, "range", math.inf, pointer)
    if not reach > 0.0:
        raise AssetError("the range must be positive", pointer=f"{pointer}/range")
    return Light(
        name=name,
        kind=kind,
        colour=_colour(description, pointer),
        intensity=_number(description, "intensity", 1.0, pointer, low=0.0),
        position=world[:3, 3].copy(),
        direction=direction / length if length > 0.0 else np.array([0.0, 0.0, -1.0]),
        range_m=None if kind == "directional" or math.isinf(reach) else reach,
        inner_cone_rad=inner,
        outer_cone_rad=outer,
    )


def _colour(description: Json, pointer: str) -> tuple[float, float, float]:
    colour = description.get("color", (1.0, 1.0, 1.0))
    where = f"{pointer}/color"
    if not isinstance(colour, list | tuple) or len(colour) != 3:
        raise AssetError("the colour must have three channels", pointer=where)
    red, green, blue = (_number({"color": c}, "color", 1.0, pointer, low=0.0) for c in colour)
    return red, green, blue


def _number(description: Json, key: str, default: float, pointer: str, *, low: float | None = None) -> float:
    value = description.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise AssetError(f"{key} must be a number", pointer=f"{pointer}/{key}")
    if low is not None and value < low:
        raise AssetError(f"{key} must not be below {low:g}", pointer=f"{pointer}/{key}")
    return float(value)


def _object(description: Json, key: str, pointer: str) -> Json:
    value = description.get(key, {})
    if not isinstance(value, Mapping):
        raise AssetError(f"{key} must be an object", pointer=f"{pointer}/{key}")
    return value
