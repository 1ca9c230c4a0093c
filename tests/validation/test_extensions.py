"""Extensions: where they stand, whether they are declared, and what their lists say."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

Codes = Callable[..., set[tuple[str, str | int | None]]]

UNLIT = "KHR_materials_unlit"
IRIDESCENCE = "KHR_materials_iridescence"
PLACE = "/materials/0/extensions"


def material(used: list[str], **extensions: Any) -> dict[str, Any]:
    return {"extensionsUsed": used, "materials": [{"extensions": extensions}]}


def test_a_known_extension_in_its_place_is_read(codes: Codes) -> None:
    assert codes(material([UNLIT], **{UNLIT: {}})) == set()
    told = codes(material([IRIDESCENCE], **{IRIDESCENCE: {"iridescenceIor": 0.5}}))
    assert told == {("VALUE_NOT_IN_RANGE", f"{PLACE}/{IRIDESCENCE}/iridescenceIor")}


def test_an_extension_must_be_declared(codes: Codes) -> None:
    told = codes({"materials": [{"extensions": {UNLIT: {}, "XX_own": {}}}]})
    assert told == {("UNDECLARED_EXTENSION", f"{PLACE}/{name}") for name in (UNLIT, "XX_own")}


def test_a_list_with_a_wrong_name_declares_nothing(codes: Codes) -> None:
    told = codes({**material([UNLIT], **{UNLIT: {}}), "extensionsUsed": [UNLIT, 5]})
    assert told == {
        ("ARRAY_TYPE_MISMATCH", "/extensionsUsed/1"),
        ("UNDECLARED_EXTENSION", f"{PLACE}/{UNLIT}"),
    }


def test_an_extension_in_a_wrong_place_is_told(codes: Codes) -> None:
    told = codes({"extensionsUsed": [UNLIT], "samplers": [{"extensions": {UNLIT: {}}}]})
    assert told == {("UNEXPECTED_EXTENSION_OBJECT", f"/samplers/0/extensions/{UNLIT}")}


def test_what_an_unknown_extension_holds_is_not_looked_at(codes: Codes) -> None:
    told = codes(material(["XX_own"], XX_own={"index": -1}))
    assert told == {("UNSUPPORTED_EXTENSION", "/extensionsUsed/0")}


@pytest.mark.parametrize("value", [None, 5, [], "a"])
def test_an_extension_is_an_object(value: Any, codes: Codes) -> None:
    assert codes(material([UNLIT], **{UNLIT: value})) == {("TYPE_MISMATCH", f"{PLACE}/{UNLIT}")}


def test_extensions_are_an_object(codes: Codes) -> None:
    assert codes({"extensions": []}) == {("TYPE_MISMATCH", "/extensions")}


def test_unlit_stands_alone(codes: Codes) -> None:
    told = codes(material([UNLIT, IRIDESCENCE], **{UNLIT: {}, IRIDESCENCE: {}}))
    assert ("MULTIPLE_EXTENSIONS", f"{PLACE}/{UNLIT}") in told
    assert ("MULTIPLE_EXTENSIONS", f"{PLACE}/{IRIDESCENCE}") not in told


def test_an_extension_may_widen_a_list_of_the_core(codes: Codes) -> None:
    image = {"images": [{"bufferView": 0, "mimeType": "image/webp"}]}
    view = {"bufferViews": [{"buffer": 0, "byteLength": 4}], "buffers": [{"byteLength": 4}]}
    assert codes({**image, **view}) == {("VALUE_NOT_IN_LIST", "/images/0/mimeType")}
    assert codes({**image, **view, "extensionsUsed": ["EXT_texture_webp"]}) == set()


@pytest.mark.parametrize("name", ["AB_c", "KHR__", "0_a", "EXT_MESH", "KHR_a_b"])
def test_names_of_extensions(name: str, codes: Codes) -> None:
    assert codes({"extensionsUsed": [name]}) == {("UNSUPPORTED_EXTENSION", "/extensionsUsed/0")}


@pytest.mark.parametrize("name", ["", "A", "A_", "_A", "a_b", "KHR_a b", "KHR_a-b", "KHR_ä", "ÄB_a", "K_a\n"])
def test_names_that_are_none(name: str, codes: Codes) -> None:
    assert codes({"extensionsUsed": [name]}) == {
        ("INVALID_EXTENSION_NAME_FORMAT", "/extensionsUsed/0"),
        ("UNSUPPORTED_EXTENSION", "/extensionsUsed/0"),
    }


def test_what_is_required_must_be_used(codes: Codes) -> None:
    told = codes({"extensionsUsed": [UNLIT], "extensionsRequired": [UNLIT, IRIDESCENCE]})
    assert told == {("UNUSED_EXTENSION_REQUIRED", "/extensionsRequired/1")}


def test_what_is_required_needs_the_list_of_what_is_used(codes: Codes) -> None:
    assert codes({"extensionsRequired": [UNLIT]}) == {
        ("UNSATISFIED_DEPENDENCY", "/extensionsRequired"),
        ("UNUSED_EXTENSION_REQUIRED", "/extensionsRequired/0"),
    }


def test_quantization_must_be_required(codes: Codes) -> None:
    lists = {"extensionsUsed": ["KHR_mesh_quantization"]}
    assert codes(lists) == {("NON_REQUIRED_EXTENSION", "/extensionsUsed/0")}
    assert codes({**lists, "extensionsRequired": ["KHR_mesh_quantization"]}) == set()


def test_a_name_stands_once(codes: Codes) -> None:
    told = codes({"extensionsUsed": [UNLIT, UNLIT]})
    assert told == {("DUPLICATE_ELEMENTS", "/extensionsUsed/1")}
