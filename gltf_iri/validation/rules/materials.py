"""Materials: properties and extensions that do nothing beside each other."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of, value_of

__all__ = ["RULES"]

# Extensions through which light enters a volume.
_TRANSMITTING = frozenset({"KHR_materials_transmission", "KHR_materials_diffuse_transmission"})


def alpha_cutoff_is_for_masks(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Only the alpha mode MASK reads the cutoff."""
    if "alphaCutoff" in entry.raw and value_of(entry, "alphaMode") != "MASK":
        yield issue("MATERIAL_ALPHA_CUTOFF_INVALID_MODE", entry.at("alphaCutoff"))


def strength_multiplies_some_emission(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A strength other than 1 is there to multiply light; a factor that is broken is told of already."""
    material = entry.parent
    if material is None or value_of(entry, "emissiveStrength") == 1.0:
        return
    factor = sound_value_of(material, "emissiveFactor")
    if factor is not None and not any(factor):
        yield issue("KHR_MATERIALS_EMISSIVE_STRENGTH_ZERO_FACTOR", entry.pointer)


def dispersion_needs_a_volume(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Light disperses where it passes a volume."""
    if "KHR_materials_volume" not in _extension_names(entry.parent):
        yield issue("KHR_MATERIALS_DISPERSION_NO_VOLUME", entry.pointer)


def volume_lets_light_in(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A volume is seen through its surface; an extension that is not known may be what transmits."""
    material = entry.parent
    is_known = material is not None and asset.knows_extensions_of(material)
    if is_known and not _TRANSMITTING & _extension_names(material):
        yield issue("KHR_MATERIALS_VOLUME_NO_TRANSMISSION", entry.pointer)


def volume_has_one_side(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """With a thickness, the surface bounds a body, whose inside nobody looks at."""
    material = entry.parent
    if material is not None and material.get("doubleSided") and entry.get("thicknessFactor", 0.0) > 0.0:
        yield issue("KHR_MATERIALS_VOLUME_DOUBLE_SIDED", entry.pointer)


def anisotropy_shares_the_normals_uv_set(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Directions of both textures are relative to the tangents of one UV set."""
    if _has_other_uv_set(entry, "anisotropyTexture"):
        yield issue("KHR_MATERIALS_ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD", entry.at("anisotropyTexture"))


def clearcoat_normals_share_the_uv_set(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Both normal textures are relative to the tangents of one UV set."""
    if _has_other_uv_set(entry, "clearcoatNormalTexture"):
        pointer = entry.at("clearcoatNormalTexture")
        yield issue("KHR_MATERIALS_CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD", pointer)


def thickness_range_and_texture_need_each_other(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A thickness texture chooses between a minimum and a maximum; alone, the maximum counts."""
    minimum, maximum = (f"iridescenceThickness{end}" for end in ("Minimum", "Maximum"))
    least = sound_value_of(entry, minimum)
    if least is None:
        return
    if "iridescenceThicknessTexture" in entry:
        if least == sound_value_of(entry, maximum):
            pointer = entry.at("iridescenceThicknessTexture")
            yield issue("KHR_MATERIALS_IRIDESCENCE_THICKNESS_TEXTURE_UNUSED", pointer)
    elif minimum in entry.raw:
        yield issue("KHR_MATERIALS_IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE", entry.at(minimum))


def _extension_names(material: Entry | None) -> frozenset[str]:
    extensions = material.raw.get("extensions") if material is not None else None
    return frozenset(extensions) if isinstance(extensions, dict) else frozenset()


def _has_other_uv_set(entry: Entry, key: str) -> bool:
    material = entry.parent
    normals = material.get("normalTexture") if material is not None else None
    return key in entry and normals is not None and _uv_set(entry[key]) != _uv_set(normals)


def _uv_set(texture: Entry) -> int | None:
    """Return the UV set that a texture reads, None where it is broken; a transform may name another."""
    transform = texture.extensions.get("KHR_texture_transform")
    if transform is not None and "texCoord" in transform:
        texture = transform
    number: int | None = sound_value_of(texture, "texCoord")
    return number


RULES: Rules = {
    "material": (alpha_cutoff_is_for_masks,),
    "KHR_materials_anisotropy": (anisotropy_shares_the_normals_uv_set,),
    "KHR_materials_clearcoat": (clearcoat_normals_share_the_uv_set,),
    "KHR_materials_dispersion": (dispersion_needs_a_volume,),
    "KHR_materials_emissive_strength": (strength_multiplies_some_emission,),
    "KHR_materials_iridescence": (thickness_range_and_texture_need_each_other,),
    "KHR_materials_volume": (volume_lets_light_in, volume_has_one_side),
}
