"""Textures that are the same everywhere, folded into the factors that they multiply.

A shader without the texture reads less memory and compiles less code, and the picture stays what it was: a
texel k/255 is the same number in a factor. Normal maps are never folded: 8 bits hold no flat one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from gltf_iri.material.material import Material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.reach import Span
from gltf_iri.planning.texels import texture_spans
from gltf_iri.planning.verdicts import material_verdicts

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["simplified"]

# The method that keeps a film wherever any does: textures that it does not read are read by none.
_READS_MOST: Final = METHODS["khr"]

Values = tuple[float, ...]


def simplified(material: Material, document: Document) -> tuple[Material, Mapping[Effect, str]]:
    """Return `material` without the textures that hold one value, and why each effect so left out is.

    Textures that nothing reads, or that cannot be read, stay where they are.
    """
    folded: dict[Effect, str] = {}
    material = _one_lobe(material, document, folded)
    verdicts = material_verdicts(material, _READS_MOST, None, None, folded)
    for slot, fold in _FOLDS.items():
        effect = Effect[f"{slot.upper()}_TEXTURE"]
        if verdicts[effect] is not None:
            continue
        spans = texture_spans(slot, material, document).channels
        if slot == "base_color" and material.alpha_mode == "OPAQUE":
            spans = (*spans[:3], Span.at(1.0))  # nobody reads its alpha
        if not all(span.is_point for span in spans):
            continue
        values = tuple(span.low for span in spans)
        changed = fold(material, values)
        if changed is not None:
            folded[effect] = _reason(values)
            material = changed
            verdicts = material_verdicts(material, _READS_MOST, None, None, folded)
    return material, folded


def _one_lobe(material: Material, document: Document, folded: dict[Effect, str]) -> Material:
    """Return `material` with metalness 0 where it is in every texel; note the lobe that is ruled out.

    The texture's roughness may vary all the same.
    """
    pbr = material.pbr
    if pbr.metallic_roughness_texture is None or pbr.metallic_factor == 0.0 or material.unlit is not None:
        return material
    _, metallic = texture_spans("metallic_roughness", material, document).channels
    if metallic == Span.at(0.0):
        folded[Effect.METAL] = "every texel's metalness is 0"
        return replace(material, pbr=replace(pbr, metallic_factor=0.0))
    if metallic == Span.at(1.0) and pbr.metallic_factor == 1.0:
        folded[Effect.DIELECTRIC] = "the metallic factor is 1 and every texel's metalness too"
    return material


def _reason(values: Values) -> str:
    if all(value == 1.0 for value in values):
        return "every texel is 1, which changes nothing"
    told = ", ".join(f"{value:.4g}" for value in values)
    return f"every texel is {told if len(values) == 1 else f'({told})'}, which is in the factor now"


@dataclass(frozen=True, slots=True)
class _Multiplied:
    """A texture whose channels multiply `factors`: numbers, one a channel, or one colour.

    part : the attribute of the material that has both; "" for the material itself.
    """

    part: str
    texture: str
    factors: tuple[str, ...]

    def __call__(self, material: Material, values: Values) -> Material | None:
        holder = getattr(material, self.part) if self.part else material
        old = [getattr(holder, name) for name in self.factors]
        new: list[float | Values]
        if isinstance(old[0], tuple):
            new = [tuple(factor * value for factor, value in zip(old[0], values, strict=True))]
        else:
            new = [factor * value for factor, value in zip(old, values, strict=True)]
        changes: dict[str, Any] = {self.texture: None, **dict(zip(self.factors, new, strict=True))}
        if not self.part:
            return replace(material, **changes)
        changed: dict[str, Any] = {self.part: replace(holder, **changes)}
        return replace(material, **changed)


def _fold_thickness(material: Material, values: Values) -> Material | None:
    film, (share,) = material.iridescence, values
    if film is None:
        return None
    nm = film.thickness_min_nm * (1.0 - share) + film.thickness_max_nm * share
    film = replace(film, thickness_texture=None, thickness_min_nm=nm, thickness_max_nm=nm)
    return replace(material, iridescence=film)


def _fold_periods(material: Material, values: Values) -> Material | None:
    bragg, (share,) = material.bragg, values
    if bragg is None:
        return None
    layers = []
    for layer in bragg.layers:
        nm = layer.period_min_nm * (1.0 - share) + layer.period_max_nm * share
        layers.append(replace(layer, period_min_nm=nm, period_max_nm=nm))
    return replace(material, bragg=replace(bragg, period_texture=None, layers=tuple(layers)))


def _fold_occlusion(material: Material, values: Values) -> Material | None:
    # There is no factor beside the texture: only what occludes nothing can go.
    return replace(material, occlusion_texture=None) if values == (1.0,) else None


def _fold_anisotropy(material: Material, values: Values) -> Material | None:
    """R and G point in [−1, 1]² along a direction that the rotation turns further; B is the strength's."""
    made, (red, green, strength) = material.anisotropy, values
    if made is None:
        return None
    turn_rad = math.atan2(2.0 * green - 1.0, 2.0 * red - 1.0)  # 8 bits hold no vector of length 0
    made = replace(
        made,
        texture=None,
        strength=made.strength * strength,
        rotation_rad=made.rotation_rad + turn_rad,
    )
    return replace(material, anisotropy=made)


# By slot of material.interface.SAMPLERS; None comes back where the texture has to stay.
_FOLDS: Final[Mapping[str, Callable[[Material, Values], Material | None]]] = {
    "metallic_roughness": _Multiplied(
        "pbr", "metallic_roughness_texture", ("roughness_factor", "metallic_factor")
    ),
    "base_color": _Multiplied("pbr", "base_color_texture", ("base_color_factor",)),
    "occlusion": _fold_occlusion,
    "emissive": _Multiplied("", "emissive_texture", ("emissive_factor",)),
    "specular": _Multiplied("specular", "texture", ("factor",)),
    "specular_color": _Multiplied("specular", "color_texture", ("color_factor",)),
    "iridescence": _Multiplied("iridescence", "texture", ("factor",)),
    "iridescence_thickness": _fold_thickness,
    "bragg": _Multiplied("bragg", "texture", ("factor",)),
    "bragg_period": _fold_periods,
    "anisotropy": _fold_anisotropy,
    "transmission": _Multiplied("transmission", "texture", ("factor",)),
    "volume_thickness": _Multiplied("volume", "thickness_texture", ("thickness_factor_m",)),
    "sheen_color": _Multiplied("sheen", "color_texture", ("color_factor",)),
    "sheen_roughness": _Multiplied("sheen", "roughness_texture", ("roughness_factor",)),
    "clearcoat": _Multiplied("clearcoat", "texture", ("factor",)),
    "clearcoat_roughness": _Multiplied("clearcoat", "roughness_texture", ("roughness_factor",)),
}
