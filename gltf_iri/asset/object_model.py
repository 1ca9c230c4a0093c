"""Checked JSON to pygltflib's object model, without pygltflib ever opening a file.

Left alone, pygltflib joins any URI to the asset's folder and reads it, `../../etc/passwd` included, and it
takes NaN and dangling indices. Here it meets checked JSON only, in which every URI already carries its data.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.image import sniff_media_type
from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    import pygltflib

__all__ = ["to_pygltflib"]


def to_pygltflib(
    root: Mapping[str, Any],
    buffers: Mapping[int, bytes],
    images: Mapping[int, bytes],
    binary: memoryview | None,
) -> pygltflib.GLTF2:
    """Build the object model; `buffers` and `images` hold the bytes of every one that has a URI.

    Raises AssetError where a part that the structural check leaves to others, such as a material, has a form
    that pygltflib cannot hold.
    """
    import pygltflib

    carried = dict(root)
    # pygltflib decodes buffers with exactly this header and no other.
    _carry(carried, "buffers", {i: ("application/octet-stream", data) for i, data in buffers.items()})
    _carry(carried, "images", {i: (_media_type(data), data) for i, data in images.items()})
    try:
        model = pygltflib.GLTF2.gltf_from_json(json.dumps(carried, allow_nan=False))
    # Its generated decoders state no errors: whatever they raise means that the document does not fit.
    except Exception as error:
        raise AssetError(f"pygltflib cannot hold this document ({error!r})", pointer="") from error
    if binary is not None:
        model.set_binary_blob(bytes(binary))
    return model


def _carry(root: dict[str, Any], key: str, contents: Mapping[int, tuple[str, bytes]]) -> None:
    if not contents:
        return
    entries = list(root[key])
    for index, (media_type, data) in contents.items():
        uri = f"data:{media_type};base64,{base64.b64encode(data).decode('ascii')}"
        entries[index] = {**entries[index], "uri": uri}
    root[key] = entries


def _media_type(data: bytes) -> str:
    return sniff_media_type(data) or "application/octet-stream"
