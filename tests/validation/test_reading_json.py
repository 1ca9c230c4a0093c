"""JSON of every kind becomes a report: what breaks it is told, what can still be judged is."""

from __future__ import annotations

import json

import pytest

from gltf_iri.asset import json_parts
from gltf_iri.asset.limits import MAX_JSON_DEPTH
from gltf_iri.errors import AssetError
from gltf_iri.scene.load import load
from gltf_iri.validation.reading import json_text

ASSET = '{"asset":{"version":"2.0"}}'


def with_extras(text: str) -> str:
    return f'{{"asset":{{"version":"2.0","extras":{{"a":{text}}}}}}}'


@pytest.mark.parametrize(
    "text",
    [
        "",
        " \n",
        "{",
        "{]",
        ASSET[:-1],
        ASSET + "x",
        ASSET + ASSET,
        ASSET + "\0",
        '{"asset":{"version":"2.0",}}',
        "{'asset':1}",
        with_extras("NaN"),
        with_extras("Infinity"),
        with_extras("-Infinity"),
        with_extras("01"),
        with_extras("+1"),
        with_extras(".1"),
        with_extras("1."),
        with_extras('"a\tb"'),
        with_extras(r'"\x"'),
        with_extras(r'"\u12"'),
        with_extras("/* no */ 1"),
        ASSET.encode() + b"\xff",
        ASSET.replace("2.0", "é").encode("latin-1"),
        with_extras('"\ud800"').encode("utf-8", "surrogatepass"),
        ASSET.encode("utf-16"),
    ],
)
def test_what_is_no_json_is_told_once_and_nothing_else(judge, codes, text):
    assert codes(text) == {("INVALID_JSON", "")}
    report = judge(text)
    assert (report.mime_type, report.info, len(report.issues)) == (None, None, 1)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "there is nothing in it"),
        ("{\n ]", "line 2, column 2: expecting property name enclosed in double quotes"),
        (with_extras("NaN"), "it holds NaN, which JSON does not know"),
        (b"{\xff", "byte 1 is not UTF-8 (invalid start byte)"),
        ("\ufeff" + ASSET, "it starts with a byte order mark"),
    ],
)
def test_the_remark_says_what_broke_and_where(judge, text, reason):
    assert judge(text).issues[0].message == f"The JSON is broken: {reason}."


@pytest.mark.parametrize("text", [ASSET, f"\n\t\r {ASSET} \n", with_extras('"\x7f"'), with_extras("-0.0e-5")])
def test_sound_json_is_not_told_of(judge, text):
    report = judge(text)
    assert (report.mime_type, report.issues) == ("model/gltf+json", ())


def test_a_byte_order_mark_is_told_and_what_follows_is_judged(codes):
    mark = "\ufeff"
    assert codes(mark + ASSET) == {("INVALID_JSON", "")}
    assert codes(mark + "{}") == {("INVALID_JSON", ""), ("UNDEFINED_PROPERTY", "/")}
    assert codes(mark + "[]") == {("INVALID_JSON", ""), ("TYPE_MISMATCH", "")}
    assert codes(" " + mark + ASSET) == {("INVALID_JSON", "")}


@pytest.mark.parametrize("text", ["[]", "null", "1.5", '"abc"', "true"])
def test_a_root_that_is_no_object_has_the_wrong_type(judge, codes, text):
    assert codes(text) == {("TYPE_MISMATCH", "")}
    assert judge(text).mime_type is None


def test_numbers_beyond_doubles_are_out_of_every_range(codes):
    for number in ("1e999", "-1e999", "1" + "0" * 400, "9" * 5000):
        text = f'{{"asset":{{"version":"2.0"}},"nodes":[{{"translation":[{number},0,0]}}]}}'
        assert ("VALUE_NOT_IN_RANGE", "/nodes/0/translation/0") in codes(text)
    assert codes(with_extras("9" * 5000)) == set()


@pytest.mark.parametrize("index", ["1" * 5000, "9007199254740993", "1e400", "-" + "1" * 30])
def test_indices_of_any_length_are_told(codes, index):
    told = codes(f'{{"asset":{{"version":"2.0"}},"scene":{index}}}')
    assert {pointer for _, pointer in told} == {"/scene"}


def test_a_key_that_stands_twice_is_told_and_the_last_holds(codes):
    assert codes('{"asset":{"version":"1.0"},"asset":{"version":"2.0"}}') == {("IRI_DUPLICATE_KEY", "/asset")}
    assert codes('{"asset":{"version":"2.0","version":"2.0"}}') == {("IRI_DUPLICATE_KEY", "/asset/version")}
    assert codes(with_extras('[{"a":1},{"b/":1,"b/":2}]')) == {
        ("IRI_DUPLICATE_KEY", "/asset/extras/a/1/b~1"),
    }
    assert codes(with_extras('[{"a":1},{"a":1}]')) == set()


def test_lone_surrogates_are_told_where_they_stand_and_pairs_are_not(codes):
    assert codes(with_extras(r'[1,"\ud800"]')) == {("IRI_LONE_SURROGATE", "/asset/extras/a/1")}
    assert codes(with_extras(r'{"x\udc00":1}')) == {("IRI_LONE_SURROGATE", "/asset/extras/a/x\udc00")}
    assert codes(with_extras(r'"\ud83d\ude00"')) == set()
    assert codes(with_extras(r'"\\ud800"')) == set()


def test_a_hundred_oddities_are_enough(judge):
    report = judge(with_extras("[" + ",".join([r'"\ud800"'] * 5000) + "]"))
    assert [issue.code for issue in report.issues] == ["IRI_LONE_SURROGATE"] * 100


def nested(levels: int) -> str:
    # The extras and the two objects around them are three.
    return with_extras("[" * (levels - 3) + "]" * (levels - 3))


def test_the_deepest_that_is_read_is_read(codes):
    assert codes(nested(MAX_JSON_DEPTH)) == set()
    assert codes(nested(MAX_JSON_DEPTH + 1)) == {("IRI_JSON_TOO_DEEP", "")}
    objects = MAX_JSON_DEPTH - 3
    assert codes(with_extras('{"a":' * objects + "1" + "}" * objects)) == set()
    assert codes(with_extras('{"a":' * objects + "[]" + "}" * objects)) == {("IRI_JSON_TOO_DEEP", "")}


@pytest.mark.parametrize(
    "text",
    [
        nested(100_000),
        "[" * 100_000,
        '{"a":' * 100_000,
        # Brackets in strings that balance those outside, so that only the parser finds out.
        with_extras('["]",' * 50_000 + "1" + ',"["]' * 50_000),
    ],
)
def test_any_depth_is_told(codes, text):
    assert codes(text) == {("IRI_JSON_TOO_DEEP", "")}


def test_brackets_within_strings_are_no_depth(codes):
    assert codes(with_extras("[" + ",".join(['"["'] * 1000) + "]")) == set()


def test_wide_and_deep_within_the_bound_is_counted_not_scanned(codes, monkeypatch):
    monkeypatch.setattr(json_text, "too_deep_at", None)
    assert codes(with_extras("[" + ("[" * 100 + "]" * 100 + ",") * 100 + "1]")) == set()


def test_of_a_flood_of_repeated_keys_the_first_are_remembered(codes, monkeypatch):
    monkeypatch.setattr(json_parts, "_MOST_REPEATED", 3)
    twice = '{"a":1,"a":2}'
    told = [("IRI_DUPLICATE_KEY", f"/asset/extras/a/{position}/a") for position in range(3)]
    assert codes(with_extras("[" + ",".join([twice] * 9) + "]")) == set(told)


def test_more_values_or_bytes_than_are_read_are_told(codes, monkeypatch):
    monkeypatch.setattr(json_text, "MAX_JSON_VALUES", 100)
    assert codes(with_extras("[" + "1," * 90 + "1]")) == set()
    assert codes(with_extras("[" + "1," * 101 + "1]")) == {("IRI_JSON_TOO_LARGE", "")}
    monkeypatch.setattr(json_text, "MAX_JSON_OBJECTS", 20)
    assert codes(with_extras("[" + "{}," * 17 + "1]")) == set()
    assert codes(with_extras("[" + "{}," * 18 + "1]")) == {("IRI_JSON_TOO_LARGE", "")}
    monkeypatch.setattr(json_text, "MAX_JSON_BYTES", 1000)
    assert codes(with_extras(json.dumps("x" * 1000))) == {("IRI_JSON_TOO_LARGE", "")}


@pytest.mark.parametrize(
    "text",
    [
        "\ufeff" + ASSET,
        "[" * 100_000,
        "{]",
        with_extras(r'"\ud800"'),
        with_extras("NaN"),
        with_extras('{"a":1,"a":1}'),
        nested(MAX_JSON_DEPTH + 1),
        "[]",
    ],
)
def test_what_our_loader_refuses_is_never_passed_in_silence(judge, tmp_path, text):
    path = tmp_path / "a.gltf"
    path.write_bytes(text.encode())
    with pytest.raises(AssetError):
        load(path)
    assert judge(text).issues
