"""Lines of pointers: those that a reader of the file would count, however it is written or broken."""

from __future__ import annotations

import json

import pytest

from gltf_iri.validation.reading.positions import lines_of

TEXT = """{
  "asset": { "version": "2.0" },
  "nodes": [
    {
      "name": "a \\"[{,\\" b",
      "translation": [1,
        2, 3],
      "mesh"
        : 5
    },
    {}, [], 7
  ],
  "a/b~c": { "": null,
    "": true },
  "\\u00e9": 1
}
"""
LINES = {
    "": 1,
    "/": 1,
    "/asset": 2,
    "/asset/version": 2,
    "/nodes": 3,
    "/nodes/0": 4,
    "/nodes/0/name": 5,
    "/nodes/0/translation": 6,
    "/nodes/0/translation/0": 6,
    "/nodes/0/translation/1": 7,
    "/nodes/0/mesh": 8,
    "/nodes/1": 11,
    "/nodes/3": 11,
    "/a~1b~0c": 13,
    "/a~1b~0c/": 14,  # of two, the last holds
    "/é": 15,
}
ABSENT = ["/nodes/4", "/nodes/2/0", "/nodes/00", "/nodes/0/name/0", "/asset/version/", "/b"]


def test_each_pointer_has_the_line_where_its_value_begins() -> None:
    assert lines_of(TEXT.encode(), [*LINES, *ABSENT]) == LINES


@pytest.mark.parametrize("pointer", LINES)
def test_a_pointer_alone_has_the_same_line_as_among_others(pointer: str) -> None:
    assert lines_of(TEXT.encode(), [pointer]) == {pointer: LINES[pointer]}


def test_a_text_cut_anywhere_gives_the_lines_before_the_cut() -> None:
    whole = {pointer: line for pointer, line in LINES.items() if pointer != "/a~1b~0c/"}
    for end in range(len(TEXT)):
        found = lines_of(TEXT[:end].encode(), whole)
        assert found.items() <= whole.items()
    assert set(whole) == set(found)


def test_blank_lines_and_a_property_without_a_name_count() -> None:
    assert lines_of(b'\r\n\r\n{\r\n"": 1}', ["", "/"]) == {"": 3, "/": 4}
    assert lines_of(b"\n null", ["", "/a"]) == {"": 2}
    assert lines_of(b"", ["", "/a"]) == {"": 1}


def test_long_names_are_found_as_pointers_cut_them() -> None:
    from gltf_iri.validation.entry import join

    key = "x" * 5000
    pointer = join("", key)
    assert lines_of(json.dumps({"a": 1, key: 2}, indent=1).encode(), [pointer]) == {pointer: 3}


@pytest.mark.parametrize("text", [b"[" * 200_000, b'"' * 200_001, b'{"a":' * 100_000, b"]}" * 100_000, b"\\"])
def test_hostile_texts_are_read_without_recursion(text: bytes) -> None:
    assert lines_of(text, ["/x/0"]) == {}
