from __future__ import annotations

import builtins
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.asset.document import Document, open_document
from gltf_iri.errors import AssetError

OpenAsset = Callable[..., Document]


@pytest.fixture
def no_files(monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """Return a function after whose call opening any file fails the test."""

    def forbid(*args: Any, **kwargs: Any) -> None:
        pytest.fail(f"a file was opened: {args}")

    def close() -> None:
        monkeypatch.setattr(builtins, "open", forbid)
        monkeypatch.setattr(io, "open", forbid)

    return close


def test_the_model_carries_every_byte_and_opens_nothing(
    open_asset: OpenAsset,
    data_uri: Callable[..., str],
    encode_picture: Callable[..., bytes],
    no_files: Callable[[], None],
) -> None:
    picture = encode_picture(np.zeros((2, 2, 3), np.uint8), "JPEG")
    document = open_asset(
        {
            "buffers": [
                {"byteLength": 4, "uri": "a.bin"},
                {"byteLength": 3, "uri": data_uri(b"xyz", "application/gltf-buffer")},
            ],
            "images": [{"uri": "b.jpg", "name": "kept"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_CUSTOM": 0}}]}],
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1}],
            "materials": [{"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1}}}],
        },
        a__bin=b"1234",
        b__jpg=picture,
    )
    before = json.dumps(document.json)
    model = document.to_pygltflib()
    no_files()
    assert [model.get_data_from_buffer_uri(buffer.uri) for buffer in model.buffers] == [b"1234", b"xyz"]
    assert model.images[0].uri == data_uri(picture, "image/jpeg")
    assert model.images[0].name == "kept"
    assert vars(model.meshes[0].primitives[0].attributes)["_CUSTOM"] == 0
    assert model.materials[0].extensions == {"KHR_materials_iridescence": {"iridescenceFactor": 1}}
    assert json.dumps(document.json) == before


def test_the_binary_chunk_becomes_the_blob(glb: Callable[..., bytes], tmp_path: Path) -> None:
    text = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4}]}).encode()
    path = tmp_path / "a.glb"
    path.write_bytes(glb((b"JSON", text + b" " * (-len(text) % 4)), (b"BIN\0", b"1234")))
    assert open_document(path).to_pygltflib().binary_blob() == b"1234"


@pytest.mark.parametrize(
    "uri", ["../../../../etc/passwd", "/etc/passwd", "file:///etc/passwd", "http://localhost/a"]
)
@pytest.mark.parametrize("kind", ["buffers", "images"])
def test_no_traversal_reaches_pygltflib(kind: str, uri: str, open_asset: OpenAsset) -> None:
    document = open_asset({kind: [{"uri": uri, **({"byteLength": 4} if kind == "buffers" else {})}]})
    with pytest.raises(AssetError) as caught:
        document.to_pygltflib()
    assert caught.value.pointer == f"/{kind}/0/uri"


@pytest.mark.parametrize(
    "properties",
    [
        {"materials": [{"pbrMetallicRoughness": 5}]},
        {
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1}],
            "meshes": [{"primitives": [{"attributes": {"self": 0}}]}],
        },
    ],
)
def test_what_the_model_cannot_hold_is_an_asset_error(
    properties: dict[str, Any], open_asset: OpenAsset
) -> None:
    with pytest.raises(AssetError, match="pygltflib cannot hold"):
        open_asset(properties).to_pygltflib()
