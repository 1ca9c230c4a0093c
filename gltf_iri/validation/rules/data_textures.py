"""Textures whose channels are numbers, as films and layers have them: what must not become of those."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.tables import TABLES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.issue import Issue

__all__ = ["LEVELS", "VISIBLE_DELTA_E", "colour_images", "conflicts_of", "image_of", "lossy_format"]

# The values of 8 bits.
LEVELS = 256

# A step that an eye just sees where two patches meet.
VISIBLE_DELTA_E = 1.0

_TRANSFORM = "KHR_texture_transform"
_WEBP = "EXT_texture_webp"


def conflicts_of(
    info: Entry, asset: Asset, colours: dict[int, str], *, overridden: str, decoded: str
) -> Iterator[Issue]:
    """Yield what a textureInfo contradicts: itself about its UV set, other readers about what its image is.

    colours : what `colour_images` returned.
    overridden, decoded : the codes for a UV set that is not the one read, and for numbers read as colours.
    """
    transform = info.extensions.get(_TRANSFORM)
    winner = None if transform is None else transform.get("texCoord")
    given = info.get("texCoord")
    if winner is not None and given is not None and winner != given:
        yield issue(overridden, info.at("texCoord"), given=given, winner=winner)
    image = image_of(info, asset)
    if image in colours:
        yield issue(decoded, info.pointer, other=colours[image])


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


def lossy_format(media_type: str, data: bytes | memoryview | None) -> str | None:
    """Return the name of a compression that does not keep its values."""
    if media_type == "image/jpeg":
        return "JPEG"
    # RFC 9649, §2.5: the first chunk of a plain lossy file; where colour profiles or alpha stand before it,
    # nobody looks further.
    is_lossy_webp = media_type == "image/webp" and data is not None and bytes(data[12:16]) == b"VP8 "
    return "lossy WebP" if is_lossy_webp else None
