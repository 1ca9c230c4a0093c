"""An opened glTF file: checked JSON; buffers, accessors, images and textures are read when asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.accessor import BufferView, read_accessor
from gltf_iri.asset.glb import JSON_OFFSET, MAGIC, split_glb
from gltf_iri.asset.guard import Budget, decode_data_uri, is_data_uri, read_given, read_inside
from gltf_iri.asset.image import Image, decode_image
from gltf_iri.asset.limits import MAX_FILE_BYTES, MAX_IMAGE_FILE_BYTES
from gltf_iri.asset.strict_json import parse_json
from gltf_iri.asset.structure import check_structure
from gltf_iri.asset.texture import Texture, read_texture
from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError, naming_file

if TYPE_CHECKING:
    import pygltflib

__all__ = ["Document", "open_document"]

_BUFFER_MEDIA_TYPES = ("application/octet-stream", "application/gltf-buffer")


class Document:
    """A glTF file whose JSON is strictly parsed and structurally checked.

    `json` is the truth, unknown keys included. Everything else is read once, when it is first asked for, and
    returned read-only. The readers raise AssetError with the file and the pointer of what is wrong; `notes`
    collects, in sentences, what was odd but could be read.
    """

    def __init__(
        self, path: Path, json: dict[str, Any], binary: memoryview | None, budget: Budget, notes: list[str]
    ) -> None:
        self.path = path
        self.json = json
        self.notes = notes
        self._binary = binary
        self._budget = budget
        self._buffers: dict[int, memoryview] = {}
        self._accessors: dict[int, NDArray[np.generic]] = {}
        self._images: dict[int, Image] = {}

    @property
    def file_bytes(self) -> int:
        """Size of the files and data URIs that have been read so far, pictures not counted."""
        return self._budget.file_bytes

    def buffer(self, index: int) -> memoryview:
        """Bytes of a buffer, exactly its byteLength of them."""
        if index not in self._buffers:
            with naming_file(self.path):
                self._buffers[index] = self._read_buffer(index)
        return self._buffers[index]

    def accessor(self, index: int) -> NDArray[np.generic]:
        """Array (count, components), matrices (count, n, n) as [row, column], sparse values applied.

        float32 where the file holds floats or normalised integers (decoded as in glTF 2.0 §3.11), else the
        file's own integer type.
        """
        if index not in self._accessors:
            with naming_file(self.path):
                description = self.json["accessors"][index]
                pointer = f"/accessors/{index}"
                self._accessors[index] = read_accessor(description, pointer, self._view, self._budget)
        return self._accessors[index]

    def image(self, index: int) -> Image:
        """Pixels of an image, uint8 RGBA (height, width, 4)."""
        if index not in self._images:
            with naming_file(self.path):
                data, declared = self._image_bytes(index)
                name = self.json["images"][index].get("name", "")
                image, notes = decode_image(data, declared, name, f"/images/{index}", self._budget)
                self._images[index] = image
                self.notes += notes
        return self._images[index]

    def texture(self, index: int) -> Texture:
        """Image and sampler of a texture, defaults filled in."""
        with naming_file(self.path):
            return read_texture(self.json, index)

    def to_pygltflib(self) -> pygltflib.GLTF2:
        """Return pygltflib's object model of this file, with every buffer and image in memory.

        pygltflib opens nothing: files become data URIs, the BIN chunk its binary blob. It drops keys
        that it does not know; `json` keeps them.
        """
        from gltf_iri.asset.object_model import to_pygltflib

        with naming_file(self.path):
            images = {i: self._image_bytes(i)[0] for i in _with_uri(self.json.get("images", []))}
            buffers = {i: bytes(self.buffer(i)) for i in _with_uri(self.json.get("buffers", []))}
            return to_pygltflib(self.json, buffers, images, self._binary)

    def _read_buffer(self, index: int) -> memoryview:
        pointer = f"/buffers/{index}"
        description = self.json["buffers"][index]
        length = description["byteLength"]
        if "uri" in description:
            data = memoryview(self._buffer_file(description["uri"], f"{pointer}/uri"))
        elif index == 0 and self._binary is not None:
            data = self._binary
        else:
            raise AssetError("the buffer has no bytes: neither a 'uri' nor a BIN chunk", pointer=pointer)
        if len(data) < length:
            raise AssetError(
                f"the buffer has {len(data)} bytes, fewer than its byteLength of {length}", pointer=pointer
            )
        return data[:length]

    def _view(self, index: int, asker: str) -> BufferView:
        description = self.json["bufferViews"][index]
        offset, length = description.get("byteOffset", 0), description["byteLength"]
        number = description["buffer"]
        size = self.json["buffers"][number]["byteLength"]
        if offset + length > size:
            raise AssetError(
                f"the buffer view, which {asker} reads, ends at byte {offset + length} of a buffer of {size}",
                pointer=f"/bufferViews/{index}",
            )
        return BufferView(self.buffer(number)[offset : offset + length], description.get("byteStride"))

    def _image_bytes(self, index: int) -> tuple[bytes, str | None]:
        """Compressed bytes of an image, and the media type that the file declares."""
        pointer = f"/images/{index}"
        description = self.json["images"][index]
        declared = description.get("mimeType")
        if "bufferView" in description:
            view = self._view(description["bufferView"], pointer)
            if len(view.data) > MAX_IMAGE_FILE_BYTES:
                raise AssetError(
                    f"the image has {len(view.data)} bytes, more than the {MAX_IMAGE_FILE_BYTES} allowed",
                    pointer=pointer,
                )
            return bytes(view.data), declared
        uri = description["uri"]
        if is_data_uri(uri):
            data, media_type = decode_data_uri(uri, f"{pointer}/uri", MAX_IMAGE_FILE_BYTES)
            return data, declared or media_type or None
        return read_inside(self.path.parent, uri, f"{pointer}/uri", MAX_IMAGE_FILE_BYTES), declared

    def _buffer_file(self, uri: str, pointer: str) -> bytes:
        if is_data_uri(uri):
            data, media_type = decode_data_uri(uri, pointer, MAX_FILE_BYTES)
            if media_type not in _BUFFER_MEDIA_TYPES:
                self.notes.append(f"{pointer}: the media type {shown(media_type)} is none of a buffer.")
        else:
            data = read_inside(self.path.parent, uri, pointer, MAX_FILE_BYTES)
        self._budget.spend_on_file(len(data), pointer)
        return data


def open_document(path: str | PathLike[str]) -> Document:
    """Open a .gltf or .glb file; which of the two it is, its first bytes say.

    Buffers and images are not touched yet. Raises UsageError if the file cannot be read, AssetError with
    pointer or byte offset if it is broken.
    """
    place = Path(path)
    with naming_file(place):
        data = read_given(place, MAX_FILE_BYTES)
        budget = Budget()
        budget.spend_on_file(len(data), "")
        notes: list[str] = []
        binary, start = None, 0
        text: bytes | memoryview = data
        if data.startswith(MAGIC) or place.suffix.lower() == ".glb":
            container = split_glb(data)
            text, binary, start = container.json, container.binary, JSON_OFFSET
            notes += container.notes
        json = parse_json(text, start)
        notes += check_structure(json)
        return Document(place, json, binary, budget, notes)


def _with_uri(entries: Sequence[Mapping[str, Any]]) -> list[int]:
    return [index for index, entry in enumerate(entries) if "uri" in entry]
