"""Baked tables of Bragg layers as one texture, and the numbers that shaders of layers read.

shaders/lighting/layer_tables.glsl says what lies where in the texture. It filters: graphics cards do so with
weights of eight bits, so that a factor between two nodes is off by up to 1/512 of what they differ by.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers, given_tables
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.optics.host_entrance import entering_irradiance
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.layers import default_tables
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import method_names
from gltf_iri.planning.reach import Span
from gltf_iri.rendering.uniforms import Sampled

if TYPE_CHECKING:
    import moderngl

__all__ = ["LayerTableStore", "check_layers_method", "checked_layers", "direct_tables", "layer_table_slices"]
__all__ += ["layer_uniforms"]

Floats = NDArray[np.floating[Any]]

_SAMPLER: Final = "u_bragg_tables"
# What is drawn without tables, and what shaders/optics/layers_single.glsl samples for it.
_DIRECT: Final = "layers-single"
_DIRECT_TABLES: Final = ("spectral_rule",)


def check_layers_method(name: str) -> None:
    """Raise UsageError where layers are drawn by the method `name` neither directly nor from tables."""
    if name != _DIRECT and default_tables(name, Span.at(1.0)) is None:
        drawable = [m for m in method_names("layers") if m == _DIRECT or default_tables(m, Span.at(1.0))]
        raise UsageError(f"Layers cannot be drawn by '{name}'; methods that can are: {', '.join(drawable)}.")


def checked_layers(
    plan: MaterialPlan, layer_tables: Mapping[int, BakedLayers], white: str
) -> BakedLayers | None:
    """Return the filled tables of the layers of `plan`; None where it has none or needs no tables.

    layer_tables : by the plans' index (`baking.layer_fill.bake_layer_plans`).
    white : what they must have been filled under.

    Raises UsageError where tables are missing, and for a method that is drawn from tables only.
    """
    if plan.layers is None:
        return None
    if plan.layers.tables is None:
        check_layers_method(plan.layers.method)
        return None
    return given_tables(plan, layer_tables, white)


class LayerTableStore:
    """The layers of one picture's plans; what no plan asks for is never uploaded."""

    def __init__(
        self, context: moderngl.Context, layer_tables: Mapping[int, BakedLayers], white: str
    ) -> None:
        self._context = context
        self._baked, self._white = layer_tables, white
        self._textures: dict[int, Sampled] = {}

    def uniforms(self, plan: MaterialPlan) -> dict[str, Any]:
        """Return the uniforms of the layers of `plan`, none without; raises as `checked_layers`."""
        if plan.layers is None:
            return {}
        baked = checked_layers(plan, self._baked, self._white)
        return layer_uniforms(plan.layers) | ({} if baked is None else _table_uniforms(baked))

    def textures(self, plan: MaterialPlan) -> dict[str, Sampled]:
        """Return the textures by the names of their samplers; raises as `checked_layers`."""
        baked = checked_layers(plan, self._baked, self._white)
        if baked is None:
            return {}
        if plan.index not in self._textures:
            self._textures[plan.index] = _texture(self._context, baked)
        return {_SAMPLER: self._textures[plan.index]}

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for texture in self._textures.values():
            texture.release()
        self._textures.clear()


def layer_table_slices(baked: BakedLayers) -> Floats:
    """Return the slices (S, P, C, 4), four bands each, in the order that shaders count them.

    The first layer's reflection as a colour, reflectance of each other layer, what each lets pass, of the
    last only where something lies below; then for a white sky what each layer sends, and what lies below.
    """
    has_base = baked.plan.under == "base"
    layers, periods, cosines, bands = baked.reflected.shape
    quads = -(-bands // 4)

    def split(values: Floats) -> Floats:
        """(L, P, C, B') → (L·Q, P, C, 4)."""
        parts = values.reshape(len(values), periods, cosines, quads, 4)
        return np.moveaxis(parts, 3, 1).reshape(-1, periods, cosines, 4)

    slices = [baked.first[None], split(baked.reflected[1:])]
    slices.append(split(baked.transmitted[: layers if has_base else layers - 1]))
    slices.append(baked.sent)
    if has_base:
        slices += [baked.scattered[None], baked.mirrored.reshape(-1, periods, cosines, 4)]
    return np.concatenate(slices)


def layer_uniforms(layers: LayersPlan) -> dict[str, Any]:
    """Return what shaders are told of the layers themselves; `_table_uniforms` adds where tables lie."""
    span = layers.texel
    length = span.high - span.low
    exit_ior = layers.layers[-1].n1
    films = [(layer.n1, layer.n2, layer.fill, float(layer.cells)) for layer in layers.layers]
    periods = [
        (low, (high - low) / length if length > 0.0 else 0.0)
        for low, high in (layer.period_nm for layer in layers.layers)
    ]
    return {
        "u_bragg_alpha": _array([layer.alpha for layer in layers.layers]),
        "u_bragg_bent": (layers.host_ior / exit_ior) ** 2,
        "u_bragg_coating_irradiance": entering_irradiance(layers.host_ior),
        "u_bragg_films": _array(films),
        "u_bragg_periods_nm": _array(periods),
        "u_bragg_texel_low": span.low,
    }


def _table_uniforms(baked: BakedLayers) -> dict[str, Any]:
    """Return each axis as (first value, scale, first node's place), and the bands' weights.

    Of roughnesses, which are slices, (first value, scale, last slice).
    """
    _, periods, cosines, _ = baked.reflected.shape
    texel = baked.plan.texel
    length = texel.high - texel.low
    # Of one node there is no way to go: any value is at it.
    scale = (periods - 1) / periods / length if length > 0.0 else 0.0
    metal, last = baked.plan.metal_roughness or Span.at(0.0), len(baked.mirrored) - 1.0
    breadth = metal.high - metal.low
    return {
        "u_bragg_metal_roughness": (metal.low, last / breadth if breadth > 0.0 else 0.0, last),
        "u_bragg_cosine": (0.0, (cosines - 1) / cosines, 0.5 / cosines),
        "u_bragg_texel": (texel.low, scale, 0.5 / periods),
        "u_bragg_weights": [tuple(row) for row in baked.weights.tolist()],
    }


def _array(values: Sequence[Any]) -> Any:
    # Arrays of one are set as their only element.
    return values[0] if len(values) == 1 else list(values)


def _texture(context: moderngl.Context, baked: BakedLayers) -> Sampled:
    """Return the tables as a filtering texture array, RGBA16F or RGBA32F, the caller's to release."""
    slices = layer_table_slices(baked)
    count, height, width, _ = slices.shape
    limit = context.info["GL_MAX_TEXTURE_SIZE"]
    most = context.info["GL_MAX_ARRAY_TEXTURE_LAYERS"]
    if max(width, height) > limit or count > most:
        raise MissingCapabilityError(
            f"The layers' tables want {count} slices of {width} × {height}; this OpenGL takes {most} of "
            f"{limit} a side. Let '--budget' choose, which finds smaller tables."
        )
    tables = baked.plan.tables
    kind = "f2" if tables is not None and tables.texel == "f2" else "f4"
    data = slices.astype(np.float16 if kind == "f2" else np.float32).tobytes()
    texture = context.texture_array((width, height, count), 4, data, dtype=kind)
    texture.repeat_x = texture.repeat_y = False
    texture.filter = (context.LINEAR, context.LINEAR)
    return texture


def direct_tables(plan: MaterialPlan) -> tuple[str, ...]:
    """Return the names of the optics tables that the layers of `plan` are computed from directly."""
    return () if plan.layers is None or plan.layers.tables is not None else _DIRECT_TABLES
