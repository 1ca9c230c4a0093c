"""Builders of small assets, good and bad."""

from __future__ import annotations

import base64
import io
import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from gltf_iri.asset.document import Document, open_document

WriteAsset = Callable[..., Path]


@pytest.fixture
def write_asset(tmp_path: Path) -> WriteAsset:
    """Return a function that writes glTF JSON (the asset property filled in) and files beside it."""

    def write(properties: dict[str, Any], **files: bytes) -> Path:
        folder = tmp_path / "asset"
        folder.mkdir(exist_ok=True)
        for name, content in files.items():
            (folder / name.replace("__", ".")).write_bytes(content)
        path = folder / "test.gltf"
        path.write_text(json.dumps({"asset": {"version": "2.0"}, **properties}), encoding="utf-8")
        return path

    return write


@pytest.fixture
def open_asset(write_asset: WriteAsset) -> Callable[..., Document]:
    return lambda properties, **files: open_document(write_asset(properties, **files))


@pytest.fixture
def open_accessor(open_asset: Callable[..., Document]) -> Callable[..., Document]:
    """Return a function that opens a document with one accessor over the given bytes as buffer view 0."""

    def build(
        accessor: dict[str, Any],
        data: bytes,
        stride: int | None = None,
        views: tuple[tuple[int, int], ...] = (),
    ) -> Document:
        first: dict[str, Any] = {"buffer": 0, "byteLength": len(data)}
        if stride is not None:
            first["byteStride"] = stride
        more = [{"buffer": 0, "byteOffset": offset, "byteLength": length} for offset, length in views]
        return open_asset(
            {
                "buffers": [{"byteLength": len(data), "uri": data_uri(data)}],
                "bufferViews": [first, *more],
                "accessors": [accessor],
            }
        )

    return build


@pytest.fixture
def open_image(open_asset: Callable[..., Document]) -> Callable[..., Document]:
    """Return a function that opens a document whose image 0 is the given bytes in a file."""
    return lambda data, **more: open_asset({"images": [{"uri": "picture", **more}]}, picture=data)


@pytest.fixture
def encode_picture() -> Callable[..., bytes]:
    """Return a function that compresses an array with Pillow."""

    def encode(pixels: np.ndarray[Any, Any], kind: str, **options: Any) -> bytes:
        target = io.BytesIO()
        PIL.Image.fromarray(pixels).save(target, kind, **options)
        return target.getvalue()

    return encode


@pytest.fixture
def glb() -> Callable[..., bytes]:
    """Return a function that packs chunks (type, data) into a GLB."""

    def pack(*chunks: tuple[bytes, bytes], version: int = 2, length: int | None = None) -> bytes:
        body = b"".join(struct.pack("<I4s", len(data), kind) + data for kind, data in chunks)
        total = 12 + len(body) if length is None else length
        return struct.pack("<4sII", b"glTF", version, total) + body

    return pack


def data_uri(data: bytes, media_type: str = "application/octet-stream") -> str:
    return f"data:{media_type};base64,{base64.b64encode(data).decode()}"


@pytest.fixture(name="data_uri")
def _data_uri() -> Callable[..., str]:
    return data_uri
