"""From a material and its decoded textures to what its film meets: the actual least and greatest.

The values combine as `gather_surface` of shaders/material/surface.glsl combines them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.planning.reach import Reach, Span
from gltf_iri.planning.texels import texture_spans, texture_spread

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document
    from gltf_iri.scene.model import Scene

__all__ = ["ANY_COLOURS", "ColourSpans", "material_reach", "vertex_colour_spans"]

ColourSpans = tuple[Span, Span, Span]

# Vertices hold single precision; a base colour is cut at 1 whatever they hold.
ANY_COLOURS: Final = (Span(0.0, MAX_NUMBER), Span(0.0, MAX_NUMBER), Span(0.0, MAX_NUMBER))

_WHITE: Final = (Span.at(1.0), Span.at(1.0), Span.at(1.0))


def material_reach(
    material: Material, document: Document | None, vertex_colours: ColourSpans | None = None
) -> Reach | None:
    """Return what the film of `material` meets; None where it has none.

    Without a thickness texture the maximum holds, which is where the texture is 1.

    document : of the textures; None, and images that cannot be read, let them hold all that they may.
    vertex_colours : the material's entry of `vertex_colour_spans`; None where no vertex brings a colour,
        ANY_COLOURS where nobody knows.
    """
    film = material.iridescence
    if film is None:
        return None
    pbr, specular = material.pbr, material.specular or Specular()

    (factor,) = texture_spans("iridescence", material, document).channels
    (share,) = texture_spans("iridescence_thickness", material, document).channels
    roughness, metallic = texture_spans("metallic_roughness", material, document).channels
    painted = texture_spans("base_color", material, document)
    tint = texture_spans("specular_color", material, document)
    (weight,) = texture_spans("specular", material, document).channels
    weight = _times(specular.factor, weight)
    f0 = (material.ior or Ior()).f0
    spread = texture_spread("iridescence_thickness", material, document)
    spread = spread.times(abs(film.thickness_max_nm - film.thickness_min_nm))
    colour = _WHITE if vertex_colours is None else vertex_colours
    return Reach(
        film_ior=film.film_ior,
        factor=_times(film.factor, factor),
        thickness_nm=_mixed(film.thickness_min_nm, film.thickness_max_nm, share),
        spread_nm=Span(spread.usual, spread.greatest),
        metallic=_times(pbr.metallic_factor, metallic),
        roughness=_times(pbr.roughness_factor, roughness),
        base_color=_colours(
            _cut(_product(_times(paint, texel), vertex))
            for paint, texel, vertex in zip(
                pbr.base_color_factor[:3], painted.channels[:3], colour, strict=True
            )
        ),
        dielectric_f0=_colours(
            _product(weight, _cut(_times(f0 * paint, texel)))
            for paint, texel in zip(specular.color_factor, tint.channels, strict=True)
        ),
        is_dielectric_grey=tint.is_grey and _is_grey(specular.color_factor),
        is_metal_grey=painted.is_grey
        and _is_grey(pbr.base_color_factor[:3])
        and all(span.is_point and span == colour[0] for span in colour),
    )


def vertex_colour_spans(scene: Scene) -> Mapping[int, ColourSpans]:
    """Return what the vertices of each material in `scene` multiply its base colour with, by its index.

    Primitives without colours count as white.
    """
    found: dict[int, ColourSpans] = {}
    for primitive in scene.primitives:
        met = _WHITE
        if primitive.colours is not None:
            low, high = primitive.colours.min(axis=0).tolist(), primitive.colours.max(axis=0).tolist()
            met = _colours(Span(low[channel], high[channel]) for channel in range(3))
        known = found.get(primitive.material, met)
        found[primitive.material] = _colours(
            Span(min(a.low, b.low), max(a.high, b.high)) for a, b in zip(known, met, strict=True)
        )
    return found


def _mixed(at_0: float, at_1: float, share: Span) -> Span:
    """Return the span of mix(at_0, at_1, share); `at_0` may be the greater."""
    ends = [at_0 * (1.0 - t) + at_1 * t for t in (share.low, share.high)]
    return Span(min(ends), max(ends))


def _times(factor: float, span: Span) -> Span:
    return Span(factor * span.low, factor * span.high)


def _product(one: Span, other: Span) -> Span:
    """Return the span of the product; below 0, where vertex colours may lie, it is cut."""
    return Span(max(one.low, 0.0) * max(other.low, 0.0), max(one.high, 0.0) * max(other.high, 0.0))


def _cut(span: Span) -> Span:
    # A tint or a vertex colour may exceed 1, a reflectance may not.
    return Span(min(span.low, 1.0), min(span.high, 1.0))


def _colours(spans: Iterable[Span]) -> ColourSpans:
    red, green, blue = spans
    return red, green, blue


def _is_grey(colour: tuple[float, ...]) -> bool:
    return colour[0] == colour[1] == colour[2]
