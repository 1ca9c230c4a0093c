"""URIs of buffers and pictures, as far as the text alone shows what they are."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.words import shown
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.files.media_types import media_type_of
from gltf_iri.validation.files.uris import DataUri, InvalidUriError, Link, read_uri
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

# glTF 2.0, §2.8.
_BUFFER_MEDIA_TYPES = ("application/octet-stream", "application/gltf-buffer")


def the_uri_is_one(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of URIs that are none or not relative, and of those that a GLB would rather not have."""
    if "uri" not in entry:
        return
    pointer = entry.at("uri")
    if asset.is_glb:
        yield issue("URI_GLB", pointer)
    try:
        uri = read_uri(entry["uri"])
    except InvalidUriError as error:
        asset.resources.keep(entry, None)
        yield issue("INVALID_URI", pointer, uri=shown(entry["uri"]), reason=error)
        return
    asset.resources.keep(entry, uri)
    if isinstance(uri, Link) and not uri.is_relative:
        yield issue("NON_RELATIVE_URI", pointer, uri=shown(entry["uri"]))
    elif isinstance(uri, DataUri) and asset.is_glb:
        yield issue("DATA_URI_GLB", pointer)


def a_data_uri_holds_a_buffer(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of a buffer's data URI that says it is something else."""
    uri = asset.resources.uri(entry)
    if isinstance(uri, DataUri) and uri.media_type not in _BUFFER_MEDIA_TYPES:
        asset.resources.keep(entry, None)
        yield issue("BUFFER_DATA_URI_MIME_TYPE_INVALID", entry.at("uri"), media_type=shown(uri.media_type))


def a_data_uri_holds_the_picture_it_says(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of a picture's data URI whose media type is not that of the bytes."""
    uri = asset.resources.uri(entry)
    if isinstance(uri, DataUri) and uri.media_type != media_type_of(uri.data):
        asset.resources.keep(entry, None)
        found = media_type_of(uri.data) or "no picture that glTF knows"
        yield issue(
            "INVALID_URI",
            entry.at("uri"),
            uri=shown(entry["uri"]),
            reason=f"it says {shown(uri.media_type)}, but the data is {found}",
        )


RULES: Rules = {
    "buffer": (the_uri_is_one, a_data_uri_holds_a_buffer),
    "image": (the_uri_is_one, a_data_uri_holds_the_picture_it_says),
}
