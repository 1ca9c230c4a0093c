"""The film's two textures beside what else is said of them: UV sets, and colours in the same image."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.tables import TABLES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.iridescence.film import Film
    from gltf_iri.validation.issue import Issue

__all__ = ["colour_images", "image_of", "textures_of"]

_TRANSFORM = "KHR_texture_transform"
_WEBP = "EXT_texture_webp"


def textures_of(film: Film, asset: Asset, colours: dict[int, str]) -> Iterator[Issue]:
    """Yield what the film's textures contradict.

    colours : what `colour_images` returned.
    """
    for info in (film.strength, film.thickness):
        if info is None:
            continue
        transform = info.extensions.get(_TRANSFORM)
        winner = None if transform is None else transform.get("texCoord")
        given = info.get("texCoord")
        if winner is not None and given is not None and winner != given:
            yield issue(
                "IRI_IRIDESCENCE_TEXCOORD_OVERRIDDEN", info.at("texCoord"), given=given, winner=winner
            )
        image = image_of(info, asset)
        if image in colours:
            yield issue("IRI_IRIDESCENCE_COLOUR_SPACE", info.pointer, other=colours[image])


def colour_images(asset: Asset) -> dict[int, str]:
    """Return the images that materials read as sRGB colours, each with the first property that does."""
    found: dict[int, str] = {}
    for material in asset.array("materials"):
        if material is None:
            continue
        pbr = material.get("pbrMetallicRoughness")
        for holder in (material, pbr, *material.extensions.values()):
            if holder is None:
                continue
            fields = TABLES[holder.table].fields
            for key, info in holder.items():
                if isinstance(info, Entry) and fields[key].colour_space == "srgb":
                    image = image_of(info, asset)
                    if image is not None:
                        found.setdefault(image, info.pointer)
    return found


def image_of(info: Entry, asset: Asset) -> int | None:
    """Return the image that a textureInfo shows to readers of core glTF, else the WebP it has instead."""
    texture = asset.get("textures", info.get("index"))
    if texture is None:
        return None
    image: int | None = texture.get("source")
    webp = texture.extensions.get(_WEBP)
    return webp.get("source") if image is None and webp is not None else image
