"""Punctual lights: KHR_lights_punctual, stated as property rows, placed by the nodes that carry them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Final, cast

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError
from gltf_iri.material.fields import choice, index, nested, number, text, vector
from gltf_iri.material.parse import Rows
from gltf_iri.scene.model import Light

__all__ = ["CONE_COSINE_MIN", "LIGHT_DISTANCE_MIN_M", "PunctualLight", "Spot", "light_of_node"]

Float64 = NDArray[np.float64]
Json = Mapping[str, Any]

# Keeps the cone's edge finite where inner and outer angle are the same; the extension's own number.
CONE_COSINE_MIN: Final = 1e-3

# Keeps 1/d² and the direction finite at a point of the surface on which the light itself lies.
LIGHT_DISTANCE_MIN_M: Final = 1e-6

# A cone that opens to the whole half-space; the inner one is narrower than that.
_RIGHT_ANGLE_RAD: Final = math.pi / 2.0


@dataclass(frozen=True, slots=True)
class Spot:
    """The cone of a spot light."""

    inner_cone_rad: float = number(
        "innerConeAngle",
        0.0,
        "Angle from the axis where the light begins to fade.",
        low=0.0,
        high=math.nextafter(_RIGHT_ANGLE_RAD, 0.0),
        unit="rad",
    )
    outer_cone_rad: float = number(
        "outerConeAngle",
        math.pi / 4.0,
        "Angle from the axis where it is gone.",
        low=0.0,
        high=_RIGHT_ANGLE_RAD,
        low_is_excluded=True,
        unit="rad",
    )


@dataclass(frozen=True, slots=True)
class PunctualLight:
    """One entry of the extension's ``lights``."""

    EXTENSION: ClassVar[str] = "KHR_lights_punctual"
    KINDS: ClassVar[tuple[str, ...]] = ("directional", "point", "spot")

    kind: str = choice("type", None, KINDS, "What the light is; it has no default.")
    name: str = text("name", "", "Name for people.")
    color: tuple[float, float, float] = vector(
        "color", (1.0, 1.0, 1.0), "Colour of the light.", low=0.0, high=1.0, colour_space="linear"
    )
    intensity: float = number(
        "intensity", 1.0, "Candela for point and spot, lux for directional.", low=0.0, unit="cd or lx"
    )
    range_m: float | None = number(
        "range",
        None,
        "Distance where the light ends; absent, nowhere.",
        low=0.0,
        low_is_excluded=True,
        unit="m",
    )
    spot: Spot = nested("spot", Spot, "The cone of a spot light.")  # noqa: RUF009 — it returns a field


@dataclass(frozen=True, slots=True)
class _Reference:
    light: int | None = index("light", None, "The light that the node carries.")


def light_of_node(document: Json, node: Json, world: Float64, pointer: str) -> Light | None:
    """Return the light that a node carries, or None; `world` (4, 4) is the node's transform.

    It shines along the node's −Z; the node's scale changes neither intensity nor range. Raises AssetError
    where the light does not exist or a value is out of its range.
    """
    name = PunctualLight.EXTENSION
    carried = node.get("extensions", {}).get(name)
    if carried is None:
        return None
    rows = Rows(document)
    referred = rows.build(_Reference, carried, f"{pointer}/extensions/{name}").light
    root = document.get("extensions", {}).get(name)
    listed = root.get("lights") if isinstance(root, dict) else None
    count = len(listed) if isinstance(listed, list) else 0
    if listed is None or referred is None or referred >= count:
        raise AssetError(
            f"the node refers to a light that does not exist; the file has {count}",
            pointer=f"{pointer}/extensions/{name}/light",
        )
    where = f"/extensions/{name}/lights/{referred}"
    stated = rows.build(PunctualLight, listed[referred], where)
    if stated.kind == "spot" and not stated.spot.inner_cone_rad < stated.spot.outer_cone_rad:
        raise AssetError("innerConeAngle must be less than outerConeAngle", pointer=f"{where}/spot")
    return _placed(stated, world, str(node.get("name", "")), pointer)


def _placed(stated: PunctualLight, world: Float64, node_name: str, pointer: str) -> Light:
    direction = -world[:3, 2]
    length = float(np.linalg.norm(direction))
    if stated.kind != "point" and not length > 0.0:
        raise AssetError("the light's node is scaled to 0, so it shines nowhere", pointer=pointer)
    return Light(
        name=stated.name or node_name,
        kind=cast(Any, stated.kind),
        colour=stated.color,
        intensity=stated.intensity,
        position=world[:3, 3].copy(),
        direction=direction / length if length > 0.0 else np.array([0.0, 0.0, -1.0]),
        range_m=None if stated.kind == "directional" else stated.range_m,
        inner_cone_rad=stated.spot.inner_cone_rad,
        outer_cone_rad=stated.spot.outer_cone_rad,
    )
