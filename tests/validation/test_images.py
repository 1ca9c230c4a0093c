"""Pictures of an asset: which are told of, where; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes, Judge
from small_pictures import data_uri, jpeg, png, sof, vp8, vp8x

WITH_WEBP = {"extensionsUsed": ["EXT_texture_webp"]}
KTX = b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(60)


def image(data: bytes, media_type: str = "image/png", **more: Any) -> dict[str, Any]:
    return {"uri": data_uri(data, media_type), **more}


def in_buffer(data: bytes, **more: Any) -> dict[str, Any]:
    return {
        "buffers": [{"byteLength": len(data), "uri": data_uri(data, "application/octet-stream")}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "images": [{"bufferView": 0, "mimeType": "image/png", **more}],
    }


def test_sound_pictures_are_not_spoken_of(codes: Codes) -> None:
    assert codes({"images": [image(png()), image(jpeg(sof()), "image/jpeg")], **in_buffer(png())}) == set()


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (png()[:-40], "IMAGE_UNEXPECTED_EOS"),
        (jpeg(sof(components=4)), "IMAGE_DATA_INVALID"),
        (b"hello, this is no picture", "IMAGE_UNRECOGNIZED_FORMAT"),
        (KTX, "IMAGE_UNRECOGNIZED_FORMAT"),
        (png(width=3), "IMAGE_NPOT_DIMENSIONS"),
        (png(height=0), "IMAGE_NPOT_DIMENSIONS"),
        (vp8(), "IMAGE_NON_ENABLED_MIME_TYPE"),
    ],
)
def test_each_fault_of_a_picture_is_told_at_the_image(codes: Codes, data: bytes, code: str) -> None:
    asset = in_buffer(data)
    del asset["images"][0]["mimeType"]
    assert codes(asset) - {("UNSATISFIED_DEPENDENCY", "/images/0/bufferView")} == {(code, "/images/0")}


def test_unsupported_features_are_told_beside_the_size(codes: Codes) -> None:
    told = codes({**WITH_WEBP, "images": [image(vp8x(width=3, flags=0x22), "image/webp")]})
    assert told == {("IMAGE_NPOT_DIMENSIONS", "/images/0"), ("IMAGE_FEATURES_UNSUPPORTED", "/images/0")}


def test_the_extension_allows_webp(codes: Codes) -> None:
    webp = image(vp8(), "image/webp", mimeType="image/webp")
    assert codes({**WITH_WEBP, "images": [webp]}) == set()


@pytest.mark.parametrize("declared", ["image/jpeg", "image/gif", ""])
def test_the_declared_type_is_that_of_the_bytes(codes: Codes, declared: str) -> None:
    unknown = {("VALUE_NOT_IN_LIST", "/images/0/mimeType")} if declared != "image/jpeg" else set()
    told = codes({"images": [image(png(), mimeType=declared)]})
    assert told == {("IMAGE_MIME_TYPE_INVALID", "/images/0/uri"), *unknown}
    told = codes(in_buffer(png(), mimeType=declared))
    assert told == {("IMAGE_MIME_TYPE_INVALID", "/images/0/bufferView"), *unknown}


def test_a_broken_picture_has_no_type_to_compare(codes: Codes) -> None:
    assert codes(in_buffer(png()[:20], mimeType="image/jpeg")) == {("IMAGE_UNEXPECTED_EOS", "/images/0")}


def test_a_picture_lies_without_gaps(codes: Codes) -> None:
    asset = in_buffer(png() + bytes(100))
    asset["bufferViews"][0]["byteStride"] = 4
    assert codes(asset) == {("IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", "/images/0/bufferView")}


@pytest.mark.parametrize("declared", [[], ["X_a"]])
def test_an_unknown_extension_may_replace_the_picture(codes: Codes, declared: list[str]) -> None:
    broken = image(png()[:20], extensions={"X_a": {}})
    told = codes({"images": [broken], **({"extensionsUsed": declared} if declared else {})})
    assert "IMAGE_UNEXPECTED_EOS" not in {code for code, _ in told}


CORE, WEBP = "/textures/0/source", "/textures/0/extensions/EXT_texture_webp/source"


@pytest.mark.parametrize(
    ("source", "refused"),
    [
        (image(png()), {WEBP}),
        (image(jpeg(sof()), "image/jpeg"), {WEBP}),
        (image(vp8(), "image/webp"), {CORE}),
        # What is declared counts before what the bytes are.
        (image(vp8(), "image/webp", mimeType="image/png"), {WEBP}),
        (image(png(), mimeType="image/webp"), {CORE}),
        (image(png(), mimeType="foo"), {CORE, WEBP}),
        ({"uri": "nowhere.png", "mimeType": "image/webp"}, {CORE}),
        # Nobody knows what these are.
        ({"uri": "nowhere.png"}, set()),
        (image(png()[:20]), set()),
        (image(png()[:20], mimeType=5), set()),
    ],
)
def test_a_source_is_of_a_kind_that_its_reader_knows(
    codes: Codes, source: dict[str, Any], refused: set[str]
) -> None:
    texture = {"source": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}
    told = codes({**WITH_WEBP, "images": [source], "textures": [texture]})
    assert {place for code, place in told if code == "TEXTURE_INVALID_IMAGE_MIME_TYPE"} == refused


def test_one_broken_picture_leaves_the_others(judge: Judge) -> None:
    report = judge({"images": [5, image(png()[:20]), image(png(width=8))]})
    resources = (report.info or {})["resources"]
    assert [(one["pointer"], one.get("image", {}).get("width")) for one in resources] == [
        ("/images/1", None),
        ("/images/2", 8),
    ]
