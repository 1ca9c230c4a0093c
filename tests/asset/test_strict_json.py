from __future__ import annotations

import json
import time
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.asset import strict_json
from gltf_iri.asset.limits import MAX_JSON_DEPTH
from gltf_iri.asset.strict_json import parse_json
from gltf_iri.errors import AssetError

JSON_VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**53), 2**53)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(st.characters(exclude_categories=["Cs"])),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(st.characters(exclude_categories=["Cs"])), inner),
)


@given(JSON_VALUES, st.booleans())
def test_plain_json_means_what_the_standard_parser_says(value: Any, ascii_only: bool) -> None:
    assert parse_json(json.dumps(value, ensure_ascii=ascii_only).encode()) == value


@given(st.binary() | st.text(alphabet='{}[]",:\\0123456789.eE-ntu ').map(str.encode))
def test_any_bytes_give_a_value_or_an_asset_error(data: bytes) -> None:
    try:
        parse_json(data)
    except AssetError as error:
        assert "\n" not in str(error)


@pytest.mark.parametrize(
    ("text", "pointer"),
    [
        ('{"a": [0, NaN]}', "/a/1"),
        ('{"a": -Infinity}', "/a"),
        ('{"a": {"b": 1e999}}', "/a/b"),
        ('{"a": -1e999}', "/a"),
        ('{"a": 1' + "0" * 400 + "}", "/a"),
        ('{"a": [{"x": 1, "y": 2, "x": 1}]}', "/a/0"),
        ('{"a": 1, "a": {"b": 1, "b": 2}}', ""),
        (r'{"a": "\ud800"}', "/a"),
        (r'{"a": {"\udc00": 1}}', r"/a/\udc00"),
        (r'{"a/b~c": NaN}', "/a~1b~0c"),
    ],
)
def test_what_json_forbids_is_refused_where_it_stands(text: str, pointer: str) -> None:
    with pytest.raises(AssetError) as caught:
        parse_json(text.encode())
    assert caught.value.pointer == pointer
    str(caught.value).encode("utf-8")  # printable anywhere


def test_a_repeated_key_is_named() -> None:
    with pytest.raises(AssetError, match="'twice' stands twice"):
        parse_json(b'{"twice": 1, "once": 2, "twice": 3}')


def test_whole_surrogate_pairs_are_characters() -> None:
    assert parse_json(rb'["\ud83d\ude00"]') == ["😀"]


def test_long_integers_are_doubles_and_short_ones_exact() -> None:
    assert parse_json(b"[9007199254740992, -7, 100000000000000000000]") == [2**53, -7, 1e20]
    assert parse_json(b"[" + b"9" * 200 + b"]") == [pytest.approx(1e200)]


@pytest.mark.parametrize(
    "data", [b"\xef\xbb\xbf{}", b'{"a": "\xff"}', b'"\xed\xa0\x80"', "{}".encode("utf-16")]
)
def test_only_utf8_without_byte_order_mark_is_read(data: bytes) -> None:
    with pytest.raises(AssetError) as caught:
        parse_json(data)
    assert caught.value.offset is not None


@pytest.mark.parametrize("opening", [b"[", b'{"a":', b'[{"b":'])
def test_a_hundred_thousand_levels_are_one_sentence(opening: bytes) -> None:
    with pytest.raises(AssetError, match=f"deeper than {MAX_JSON_DEPTH} levels"):
        parse_json(opening * 100_000)


def test_depth_counts_neither_siblings_nor_brackets_in_text() -> None:
    value = [['[[[[{{{{\\"[[['] * 2, *[[{}]] * 500]
    assert parse_json(json.dumps(value).encode()) == value
    deepest = b"[" * MAX_JSON_DEPTH + b"]" * MAX_JSON_DEPTH
    assert parse_json(deepest)
    with pytest.raises(AssetError):
        parse_json(b"[" + deepest + b"]")


def test_unterminated_text_full_of_quotes_is_scanned_in_linear_time() -> None:
    hostile = b"[" + b"[]," * (MAX_JSON_DEPTH + 1) + b'"' + b'\\"' * 500_000
    start = time.process_time()
    with pytest.raises(AssetError):
        parse_json(hostile)
    assert time.process_time() - start < 2.0  # a quadratic scan would take hours


def test_size_and_number_of_values_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strict_json, "MAX_JSON_VALUES", 10)
    with pytest.raises(AssetError, match="more than 10 values"):
        parse_json(b"[0,0,0,0,0,0,0,0,0,0,0]")
    monkeypatch.setattr(strict_json, "MAX_JSON_BYTES", 5)
    with pytest.raises(AssetError, match="more than the 5"):
        parse_json(b'"text"')


def test_broken_json_says_line_and_column() -> None:
    with pytest.raises(AssetError, match="line 2, column 3"):
        parse_json(b"{\n  oops}")
