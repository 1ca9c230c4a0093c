"""Pictures by their headers, without decoding them: what they are, and whether glTF allows them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.files.image_info import ImageDataError, ImageEndError, ImageInfo, Segments
from gltf_iri.validation.files.media_types import media_type_of
from gltf_iri.validation.issue import Issue

if TYPE_CHECKING:
    from gltf_iri.validation.asset import Asset

__all__ = ["check_images", "read_image"]

# Media types that an extension allows.
_BY_EXTENSION = {"image/webp": "EXT_texture_webp"}


def read_image(data: bytes | memoryview, segments: Segments) -> ImageInfo | None:
    """Return what a picture's header says, None where the bytes are no picture that is known here.

    Raises ImageDataError where the header is broken, ImageEndError where it is cut off.
    """
    media_type = media_type_of(data)
    # Imported where there is something to read: most files have no picture, or pictures of one kind.
    if media_type == "image/png":
        from gltf_iri.validation.files.png import read_png

        return read_png(data, segments)
    if media_type == "image/jpeg":
        from gltf_iri.validation.files.jpeg import read_jpeg

        return read_jpeg(data, segments)
    if media_type == "image/webp":
        from gltf_iri.validation.files.webp import read_webp

        return read_webp(data)
    return None


def check_images(asset: Asset) -> None:
    """Read all pictures' headers into `asset.images`, and tell of those that are not as they should be."""
    segments = Segments()
    for index, entry in enumerate(asset.array("images")):
        data = asset.resources.image(index) if entry is not None else None
        if entry is not None and data is not None:
            asset.collector.add_all(_check_image(asset, index, entry, data, segments))


def _check_image(
    asset: Asset, index: int, entry: Entry, data: bytes | memoryview, segments: Segments
) -> Iterator[Issue]:
    try:
        info = read_image(data, segments)
    except ImageDataError as error:
        yield issue("IMAGE_DATA_INVALID", entry.pointer, reason=error)
        return
    except ImageEndError:
        yield issue("IMAGE_UNEXPECTED_EOS", entry.pointer)
        return
    if info is None:
        yield issue("IMAGE_UNRECOGNIZED_FORMAT", entry.pointer)
        return
    asset.images[index] = info
    declared = entry.raw.get("mimeType")
    if isinstance(declared, str) and declared != info.media_type:
        pointer = entry.at("uri" if "uri" in entry else "bufferView")
        yield issue("IMAGE_MIME_TYPE_INVALID", pointer, found=info.media_type, declared=shown(declared))
    extension = _BY_EXTENSION.get(info.media_type)
    if extension is not None and extension not in asset.declared:
        yield issue("IMAGE_NON_ENABLED_MIME_TYPE", entry.pointer, media_type=info.media_type)
    if not info.has_power_of_two_sides:
        yield issue("IMAGE_NPOT_DIMENSIONS", entry.pointer, width=info.width, height=info.height)
    if info.is_unsupported:
        yield issue("IMAGE_FEATURES_UNSUPPORTED", entry.pointer)
