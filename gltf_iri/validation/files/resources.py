"""What the file brings along: buffers and pictures, read once, told of once, never from beyond its folder."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING, Any
from weakref import proxy

from gltf_iri.asset.limits import MAX_ASSET_BYTES, MAX_FILE_BYTES, MAX_IMAGE_FILE_BYTES
from gltf_iri.errors import AssetError
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.files.uris import DataUri, Link
from gltf_iri.validation.tables import sound_value_of

if TYPE_CHECKING:
    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.data.elements import Elements
    from gltf_iri.validation.issue import Issue

__all__ = ["Resources", "check_resources"]

# A BIN chunk's length is a multiple of 4 (glTF 2.0, §4.4.3.2), so that so many bytes may follow the buffer.
_MOST_PADDING = 3

# The media type of a buffer in the `info` block, however it is stored.
_BUFFER_MEDIA_TYPE = "application/gltf-buffer"


class Resources:
    """The bytes beside the JSON of one asset; `check_resources` reads them.

    told : what `info` says of each buffer and picture, in the order of the file.
    elements : the accessors that were asked for, as `data.access` reads them.
    buffer_bytes, numbers : how many bytes the buffers have, and how many numbers were looked at so far.
    found : what rules about the data found in an accessor, by a name of theirs, so as not to look again.
    """

    def __init__(self, asset: Asset) -> None:
        # Weak, so that no cycle keeps the bytes of one file while the next ones are read.
        self._asset: Asset = proxy(asset)
        self._uris: dict[Entry, DataUri | Link | None] = {}
        self._read: dict[Entry, bytes | memoryview] = {}
        self._files: dict[str, bytes | str] = {}
        self._room = MAX_ASSET_BYTES
        self.told: list[dict[str, Any]] = []
        self.elements: dict[Entry, Elements | None] = {}
        self.buffer_bytes = 0
        self.numbers = 0
        self.found: dict[tuple[str, object], Any] = {}

    def keep(self, entry: Entry, uri: DataUri | Link | None) -> None:
        """Remember what the URI of a buffer or picture is; None where it was told of and is not used."""
        self._uris[entry] = uri

    def uri(self, entry: Entry) -> DataUri | Link | None:
        """Return what the URI of a buffer or picture is; None where it has no sound one."""
        return self._uris.get(entry)

    def buffer(self, index: int | None) -> memoryview | None:
        """Return the bytes of a buffer, not always byteLength many; None where they are not there."""
        entry = self._asset.get("buffers", index)
        data = self._read.get(entry) if entry is not None else None
        return memoryview(data) if data is not None else None

    def view(self, index: int | None) -> memoryview | None:
        """Return the bytes of a buffer view; None where they are not all there."""
        entry = self._asset.get("bufferViews", index)
        start: int | None = None if entry is None else sound_value_of(entry, "byteOffset")
        if entry is None or start is None or "byteLength" not in entry:
            return None
        data, end = self.buffer(entry.get("buffer")), start + entry["byteLength"]
        return data[start:end] if data is not None and end <= len(data) else None

    def image(self, index: int | None) -> bytes | memoryview | None:
        """Return the compressed bytes of a picture; None where they are not there, or others may count."""
        entry = self._asset.get("images", index)
        if entry is None or not self._asset.knows_extensions_of(entry):
            return None
        if entry in self._read:
            return self._read[entry]
        return self.view(entry.get("bufferView")) if "uri" not in entry else None

    def load(self) -> Iterator[Issue]:
        """Read everything, and tell of what cannot be read or is too short."""
        for index, entry in enumerate(self._asset.array("buffers")):
            if entry is not None:
                yield from self._load_buffer(index, entry)
        for entry in self._asset.array("images"):
            if entry is not None:
                yield from self._load_image(entry)

    def _load_buffer(self, index: int, entry: Entry) -> Iterator[Issue]:
        told: dict[str, Any] = {"pointer": entry.pointer, "mimeType": _BUFFER_MEDIA_TYPE}
        self.told.append(told)
        if "byteLength" not in entry:
            uri = self.uri(entry)
            if isinstance(uri, DataUri):
                self._keep_bytes(entry, uri.data)
            return
        data: bytes | memoryview | None = None
        if "uri" in entry.raw:
            data = yield from self._load_uri(entry, told, MAX_FILE_BYTES)
        elif self._asset.is_glb and index == 0:
            told["storage"] = "glb"
            data = self._asset.binary
            if data is None:
                yield issue("BUFFER_MISSING_GLB_DATA", entry.pointer)
            elif len(data) - entry["byteLength"] > _MOST_PADDING:
                yield issue(
                    "BUFFER_GLB_CHUNK_TOO_BIG",
                    entry.pointer,
                    extra=len(data) - entry["byteLength"] - _MOST_PADDING,
                )
        if data is None:
            return
        told["byteLength"] = len(data)
        if len(data) < entry["byteLength"]:
            yield issue(
                "BUFFER_BYTE_LENGTH_MISMATCH", entry.pointer, length=len(data), declared=entry["byteLength"]
            )
            if told["storage"] != "data-uri":
                return  # cut off in transit: what is left of it is not looked at
        self._keep_bytes(entry, data)

    def _keep_bytes(self, entry: Entry, data: bytes | memoryview) -> None:
        self._read[entry] = data
        self.buffer_bytes += len(data)

    def _load_image(self, entry: Entry) -> Iterator[Issue]:
        told: dict[str, Any] = {"pointer": entry.pointer}
        self.told.append(told)
        if not self._asset.knows_extensions_of(entry):
            return  # who knows them may read another picture
        if "uri" in entry:
            data = yield from self._load_uri(entry, told, MAX_IMAGE_FILE_BYTES)
            if data is not None:
                self._read[entry] = data
        elif "bufferView" in entry:
            told["storage"] = "buffer-view"

    def _load_uri(
        self, entry: Entry, told: dict[str, Any], most: int
    ) -> Generator[Issue, None, bytes | None]:
        """Yield remarks, and return the bytes or None."""
        uri = self.uri(entry)
        if isinstance(uri, DataUri):
            told["storage"] = "data-uri"
            return uri.data
        if uri is None:
            return None
        told["storage"] = "external"
        told["uri"] = uri.text
        if not self._asset.options.resources:
            return None
        found = self._file(uri.text, most, entry.at("uri"))
        if isinstance(found, str):
            yield issue("IO_ERROR", entry.at("uri"), reason=found)
            return None
        return found

    def _file(self, uri: str, most: int, pointer: str) -> bytes | str:
        """Return a file's bytes, read once however often it is named, or why it cannot be had."""
        if uri not in self._files:
            self._files[uri] = self._read_file(uri, most, pointer)
        return self._files[uri]

    def _read_file(self, uri: str, most: int, pointer: str) -> bytes | str:
        # Imported where a file is read: it brings urllib, which most small files do without.
        from gltf_iri.asset.guard import read_inside

        folder = self._asset.folder
        if folder is None:
            return "the asset came without a folder, so that no files lie beside it"
        try:
            data = read_inside(folder, uri, pointer, min(most, self._room))
        except AssetError as error:
            return error.what
        self._room -= len(data)
        return data


def check_resources(asset: Asset) -> None:
    """Read buffers and pictures of the asset, and tell of those that are not as they should be."""
    asset.collector.add_all(asset.resources.load())
