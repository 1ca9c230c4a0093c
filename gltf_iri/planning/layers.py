"""Which of a material's Bragg layers are simulated, over what, and by which method.

Of two cases that look the same the simpler is planned: layers that mirror nothing are left out, one cell in a
host of its own index is a film, and over a black base nothing that passes the last layer comes back.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from gltf_iri.errors import UsageError
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material
from gltf_iri.planning.bragg import bragg_verdicts, layer_reflects, period_texel
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer, Under
from gltf_iri.planning.method import ParameterValue
from gltf_iri.planning.mirror import film_in_mirror
from gltf_iri.planning.reach import Span

__all__ = ["DRAWN_BY_DEFAULT", "default_tables", "plan_layers"]

DRAWN_BY_DEFAULT: Final = "layers-bands"

# Where no budget asks: texels along the cosine, and along the period where it varies.
_COS_NODES: Final = 256
_PERIOD_NODES: Final = 64

# What tables hold of a layer by each method that has some.
_TABLE_BANDS: Final[Mapping[str, int]] = MappingProxyType(
    {"layers-rgb": 3, "layers-bands": 16, "layers-single-table": 64}
)

# What fills tables of colours, of the methods for mirrors.
_EXACT: Final = "yeh-spectral"

_ONE_CELL: Final = "one cell in a host of its own n1"
_NO_CONTRAST: Final = "smooth films that mirror nothing let all light by"


def default_tables(method: str, texel: Span, *, is_alone: bool = False) -> LayerTables | None:
    """Return the shape of the tables that `method` is drawn from without a budget; None where directly.

    is_alone : one layer on black, whose colour nothing is multiplied with.
    """
    bands = _TABLE_BANDS.get(method)
    if bands is None:
        return None
    nodes = 1 if texel.is_point else _PERIOD_NODES
    is_colour = is_alone or method == "layers-rgb"
    return LayerTables(3 if is_colour else bands, is_colour, _COS_NODES, nodes, "f4", 0.0)


def plan_layers(
    material: Material,
    *,
    method: str | None = None,
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
    texel: Span | None = None,
    tables: LayerTables | None = None,
    delta_e: float | None = None,
    ns_per_colour: float = 0.0,
    reason: str = "",
    folded: Mapping[Effect, str] = MappingProxyType({}),
) -> LayersPlan | None:
    """Return what of the layers of `material` is simulated; None where none are drawn (`bragg_verdicts`).

    method : of the domain "layers"; None leaves the choice to the plan.
    texel : what the texture of periods holds (`period_texel`); None where nobody knows.
    tables : their shape; None for what the method is drawn from without a budget.
    folded : reasons for what `simplified` has taken out of `material`.

    Raises UsageError for a `reflectance` of layers-rgb other than the truth, which fills its tables.
    """
    bragg, verdicts = material.bragg, dict(bragg_verdicts(material, folded))
    if bragg is None or material.unlit is not None or verdicts[Effect.BRAGG] is not None:
        return None
    if verdicts[Effect.BRAGG_PERIOD_TEXTURE] is not None:
        texel = Span.at(1.0)  # no period varies by it
    elif texel is None:
        texel = period_texel(material, None)
    chosen = method or DRAWN_BY_DEFAULT
    under: Under = "nothing" if _is_black(material) else "base"
    layers, simpler = _kept(bragg, texel)
    if under == "nothing":
        told = "the base is black: no light comes from below the last layer"
        simpler.append(f"{told}, and a single layer's colour is all" if len(layers) == 1 else told)
    return LayersPlan(
        layers=tuple(layers),
        host_ior=bragg.host_ior,
        under=under,
        texel=texel,
        method=chosen,
        parameters=_told(chosen, parameters),
        metal_roughness=_metal_roughness(material),
        tables=tables or default_tables(chosen, texel, is_alone=under == "nothing" and len(layers) == 1),
        delta_e=delta_e,
        ns_per_colour=ns_per_colour,
        reason=reason or ("asked for" if method is not None else "the default: band by band, out of tables"),
        simpler=tuple(simpler),
    )


def _kept(bragg: Bragg, texel: Span) -> tuple[list[PlannedLayer], list[str]]:
    """Return the layers that are simulated, one at least, and what is simpler about them.

    Rough facets that mirror nothing still mask each other; and without the base's interface, for which layers
    stand, even a stack that does nothing is seen.
    """
    from gltf_iri.optics.microfacet import ALPHA_MIN

    layers: list[PlannedLayer] = []
    simpler: list[str] = []
    for i, layer in enumerate(bragg.layers):
        is_last_left = not layers and i == len(bragg.layers) - 1
        if layer.roughness == 0.0 and not layer_reflects(layer, bragg) and not is_last_left:
            simpler.append(f"layer {i} is left out: {_NO_CONTRAST}")
            continue
        if layer.roughness**2 <= ALPHA_MIN:
            simpler.append(f"layer {i} is smooth: its facets are met at the light's own angle, unfiltered")
        low, high = (_period(layer, t) for t in (texel.low, texel.high))
        ior_1, cells, alike = layer.first_ior(bragg.host_ior), layer.cells, _ONE_CELL
        if layer.fill == 0.0 and cells > 1:
            low, high, cells, alike = low * cells, high * cells, 1, f"{cells} cells without a first film"
        # d2 does not decide whether the layer is a film.
        if film_in_mirror(ior_1, layer.ior_2, 0.0, cells, bragg.host_ior) is not None:
            thinnest, thickest = sorted((1.0 - layer.fill) * nm for nm in (low, high))
            nm = f"{thickest:.4g}" if thinnest == thickest else f"{thinnest:.4g} to {thickest:.4g}"
            simpler.append(f"layer {i} is a film: {alike} is {nm} nm of n2 = {layer.ior_2:g}")
        elif cells < layer.cells:
            simpler.append(f"layer {i} has one cell: {alike} are one slab of n2 = {layer.ior_2:g}")
        alpha = max(layer.roughness**2, ALPHA_MIN)
        layers.append(PlannedLayer(i, ior_1, layer.ior_2, (low, high), layer.fill, cells, alpha))
    return layers, simpler


def _metal_roughness(material: Material) -> Span | None:
    """Return what the metal's roughness may be; the texture's texels are not looked at."""
    pbr = material.pbr
    if pbr.metallic_factor == 0.0:
        return None
    least = pbr.roughness_factor if pbr.metallic_roughness_texture is None else 0.0
    return Span(least, pbr.roughness_factor)


def _period(layer: MirrorLayer, texel: float) -> float:
    return layer.period_min_nm * (1.0 - texel) + layer.period_max_nm * texel


def _told(method: str, parameters: Mapping[str, ParameterValue]) -> dict[str, ParameterValue]:
    """Return the parameters of a plan by `method`: whatever colours mirrors, tables of colours are exact."""
    if method != "layers-rgb":
        return dict(parameters)
    if parameters.get("reflectance", _EXACT) != _EXACT:
        raise UsageError(
            f"Layers are drawn by '{method}' from tables of exact colours: leave 'reflectance' out."
        )
    return {**parameters, "reflectance": _EXACT}


def _is_black(material: Material) -> bool:
    """True where nothing comes back from below: a metal of F0 = 0 still mirrors grazing light."""
    pbr = material.pbr
    return pbr.metallic_factor == 0.0 and pbr.base_color_factor[:3] == (0.0, 0.0, 0.0)
