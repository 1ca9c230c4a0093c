from __future__ import annotations

import json
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.asset.document import Document, open_document
from gltf_iri.asset.texture import Texture
from gltf_iri.errors import AssetError, UsageError

OpenAsset = Callable[..., Document]

FLOATS = struct.pack("<3f", 1, 2, 3)
ACCESSOR = {"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 3}


def with_buffer(**buffer: Any) -> dict[str, Any]:
    return {
        "buffers": [{"byteLength": 12, **buffer}],
        "bufferViews": [{"buffer": 0, "byteLength": 12}],
        "accessors": [ACCESSOR],
    }


def test_buffers_come_from_files_data_uris_and_the_binary_chunk(
    open_asset: OpenAsset, data_uri: Callable[..., str], glb: Callable[..., bytes], tmp_path: Path
) -> None:
    text = json.dumps({"asset": {"version": "2.0"}, **with_buffer()}).encode()
    packed = tmp_path / "packed.glb"
    packed.write_bytes(glb((b"JSON", text + b" " * (-len(text) % 4)), (b"BIN\0", FLOATS + b"\0\0\0\0")))
    documents = [
        open_asset(with_buffer(uri="a%2Ebin"), a__bin=FLOATS + b"more than byteLength"),
        open_asset(with_buffer(uri=data_uri(FLOATS))),
        open_document(packed),
        open_document(str(packed)),
    ]
    for document in documents:
        np.testing.assert_array_equal(document.accessor(0)[:, 0], [1, 2, 3])
        assert document.buffer(0) == FLOATS
        assert document.accessor(0) is document.accessor(0)
        assert document.notes == []


def test_errors_name_file_and_place_in_one_sentence(open_asset: OpenAsset) -> None:
    document = open_asset(with_buffer(uri="gone.bin"))
    with pytest.raises(AssetError) as caught:
        document.accessor(0)
    message = str(caught.value)
    assert message == (
        f"{document.path}: /buffers/0/uri: the file 'gone.bin' is missing; put it beside the asset."
    )
    assert caught.value.exit_code == 1


def test_nothing_is_read_before_it_is_asked_for(open_asset: OpenAsset) -> None:
    document = open_asset({**with_buffer(uri="gone.bin"), "images": [{"uri": "../../etc/passwd"}]})
    assert document.json["buffers"][0]["uri"] == "gone.bin"


def test_a_short_buffer_is_refused_and_one_without_bytes_too(open_asset: OpenAsset) -> None:
    with pytest.raises(AssetError, match="fewer than its byteLength of 12"):
        open_asset(with_buffer(uri="a.bin"), a__bin=FLOATS[:-1]).accessor(0)
    with pytest.raises(AssetError, match="neither a 'uri' nor a BIN chunk"):
        open_asset(with_buffer()).accessor(0)


def test_only_the_first_buffer_stands_for_the_binary_chunk(glb: Callable[..., bytes], tmp_path: Path) -> None:
    text = json.dumps(
        {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4}, {"byteLength": 4}]}
    ).encode()
    path = tmp_path / "two.glb"
    path.write_bytes(glb((b"JSON", text + b" " * (-len(text) % 4)), (b"BIN\0", b"1234")))
    document = open_document(path)
    assert document.buffer(0) == b"1234"
    with pytest.raises(AssetError) as caught:
        document.buffer(1)
    assert caught.value.pointer == "/buffers/1"


def test_the_media_type_of_a_buffer_is_only_noted(
    open_asset: OpenAsset, data_uri: Callable[..., str]
) -> None:
    document = open_asset(with_buffer(uri=data_uri(FLOATS, "text/plain")))
    assert document.accessor(0).shape == (3, 1)
    assert len(document.notes) == 1


@pytest.mark.parametrize("name", ["none.gltf", "none.glb", ".", "a\0b"])
def test_a_path_that_does_not_exist_is_a_usage_error(name: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError):
        open_document(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "content", "place"),
    [
        ("empty.gltf", b"", 0),
        ("empty.glb", b"", 0),
        ("text.glb", b"{}          ", 0),
        ("bom.gltf", b'\xef\xbb\xbf{"asset":{"version":"2.0"}}', 0),
        ("cut.gltf", b"glTF\2\0\0\0", 8),
        ("picture.gltf", b"\x89PNG\r\n\x1a\n", 0),
    ],
)
def test_files_that_are_no_gltf_are_refused(
    name: str, content: bytes, place: int | None, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(AssetError) as caught:
        open_document(path)
    assert caught.value.file == path
    assert caught.value.offset == place


def test_offsets_in_the_text_of_a_glb_count_from_its_first_byte(
    glb: Callable[..., bytes], tmp_path: Path
) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(glb((b"JSON", b'{"\xff": 0}')))
    with pytest.raises(AssetError) as caught:
        open_document(path)
    assert caught.value.offset == path.read_bytes().index(b"\xff")


def test_unknown_keys_are_kept(open_asset: OpenAsset) -> None:
    document = open_asset({"foo": {"bar": [1, None]}, "materials": [{"custom": 5}], "extras": "any"})
    assert document.json["foo"] == {"bar": [1, None]}
    assert document.json["materials"] == [{"custom": 5}]


def test_images_come_from_buffer_views_and_data_uris(
    open_asset: OpenAsset, data_uri: Callable[..., str], encode_picture: Callable[..., bytes]
) -> None:
    pixels = np.full((2, 3, 4), 77, np.uint8)
    data = encode_picture(pixels, "PNG")
    document = open_asset(
        {
            "buffers": [{"byteLength": len(data) + 3, "uri": data_uri(b"abc" + data)}],
            "bufferViews": [{"buffer": 0, "byteOffset": 3, "byteLength": len(data)}],
            "images": [{"bufferView": 0, "mimeType": "image/png"}, {"uri": data_uri(data, "image/png")}],
        }
    )
    np.testing.assert_array_equal(document.image(0).pixels, pixels)
    np.testing.assert_array_equal(document.image(1).pixels, pixels)
    assert document.notes == []


IMAGES = [{"uri": "a.png"}, {"uri": "a.webp"}, {"uri": "a.ktx2"}]


def test_textures_have_gltfs_defaults(open_asset: OpenAsset) -> None:
    textures = [{"source": 0}, {"source": 0, "sampler": 0}, {"source": 0, "sampler": 1}]
    samplers = [{}, {"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9984}]
    document = open_asset({"images": IMAGES, "textures": textures, "samplers": samplers})
    assert document.texture(0) == document.texture(1) == Texture(0, 10497, 10497, 9729, 9987)
    assert document.texture(2) == Texture(0, 33071, 33648, 9728, 9984)


@pytest.mark.parametrize(
    ("texture", "image"),
    [
        ({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}, 1),
        ({"extensions": {"EXT_texture_webp": {"source": 1.0}}}, 1),
        ({"source": 0, "extensions": {"EXT_texture_webp": {}}}, 0),
        ({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 2}}}, 0),
    ],
)
def test_webp_comes_first_and_ktx2_falls_back(
    texture: dict[str, Any], image: int, open_asset: OpenAsset
) -> None:
    assert open_asset({"images": IMAGES, "textures": [texture]}).texture(0).image == image


@pytest.mark.parametrize(
    ("texture", "words"),
    [
        ({}, "has no image"),
        ({"extensions": {"KHR_texture_basisu": {"source": 2}}}, "only through 'KHR_texture_basisu'"),
        ({"extensions": {"EXT_texture_webp": {"source": 3}}}, "beyond the images"),
        ({"extensions": {"EXT_texture_webp": {"source": -1}}}, "beyond the images"),
        ({"extensions": {"EXT_texture_webp": {"source": True}}}, "an index is wanted"),
        ({"extensions": {"EXT_texture_webp": {"source": [1]}}}, "an index is wanted"),
    ],
)
def test_a_texture_without_readable_image_fails_only_when_it_is_needed(
    texture: dict[str, Any], words: str, open_asset: OpenAsset
) -> None:
    document = open_asset({"images": IMAGES, "textures": [texture]})
    with pytest.raises(AssetError, match=words) as caught:
        document.texture(0)
    assert str(caught.value.pointer).startswith("/textures/0")


def test_opening_a_file_imports_neither_pillow_nor_pygltflib(tmp_path: Path) -> None:
    path = tmp_path / "a.gltf"
    path.write_text('{"asset": {"version": "2.0"}}', encoding="utf-8")
    code = (
        "import sys; from gltf_iri.asset.document import open_document; open_document(sys.argv[1]);"
        "sys.exit(bool({'PIL', 'pygltflib', 'trimesh'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code, str(path)], check=False).returncode == 0
