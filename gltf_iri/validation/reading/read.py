"""A file's bytes become its JSON object and its BIN chunk; everything wrong on the way is told."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.reading.container import MAGIC, read_container
from gltf_iri.validation.reading.json_text import read_json

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from gltf_iri.validation.issue import Issue

__all__ = ["Reading", "is_binary", "json_bytes", "read"]


class Reading:
    """What a file holds.

    root : the glTF object, or None where there is none.
    binary : the BIN chunk of a GLB.
    is_whole : the file does not break off, so that what is missing in it is missed.
    ends_empty : it is a GLB whose last chunk holds nothing.
    """

    __slots__ = ("binary", "ends_empty", "is_glb", "is_whole", "root")

    def __init__(
        self,
        root: dict[str, Any] | None,
        binary: memoryview | None = None,
        *,
        is_glb: bool = False,
        is_whole: bool = True,
        ends_empty: bool = False,
    ) -> None:
        self.root = root
        self.binary = binary
        self.is_glb = is_glb
        self.is_whole = is_whole
        self.ends_empty = ends_empty

    @property
    def mime_type(self) -> str | None:
        """What the report calls the file; None for JSON that holds no object."""
        if self.is_glb:
            return "model/gltf-binary"
        return None if self.root is None else "model/gltf+json"


def is_binary(data: bytes, name: str) -> bool:
    """Tell whether the file is to be read as a GLB.

    The magic decides, then the name, then the first byte, as for the Khronos validator.
    """
    if data.startswith(MAGIC) or name[-4:].lower() == ".glb":
        return True
    return data.startswith(MAGIC[:1]) and name[-5:].lower() != ".gltf"


def read(data: bytes, name: str, tell: Callable[[Issue], None]) -> Reading:
    """Read a file; `name` counts only where its bytes leave open what it is."""
    if not is_binary(data, name):
        return Reading(read_json(data, tell))
    container = read_container(data, tell)
    root = None if container.json is None else read_json(container.json, tell)
    is_whole, ends_empty = container.is_whole, container.ends_empty
    return Reading(root, container.binary, is_glb=True, is_whole=is_whole, ends_empty=ends_empty)


def json_bytes(data: bytes, name: str) -> bytes:
    """Return the JSON text of a file; b"" where there is none."""
    if not is_binary(data, name):
        return data
    found = read_container(data, lambda _: None).json
    return b"" if found is None else bytes(found)
