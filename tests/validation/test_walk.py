"""The schema: types, ranges, lists and what an object must have, each fault beside its sound neighbour."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from small_meshes import POSITIONS

from gltf_iri.validation.validate import validate

Codes = Callable[..., set[tuple[str, str | int | None]]]


def node(**properties: Any) -> dict[str, Any]:
    return {"nodes": [{"extras": {}, **properties}]}


def material(**properties: Any) -> dict[str, Any]:
    return {"materials": [{"alphaMode": "MASK", **properties}]}


def primitive(**properties: Any) -> dict[str, Any]:
    return {"accessors": [POSITIONS], "meshes": [{"primitives": [properties]}]}


def camera(**properties: Any) -> dict[str, Any]:
    return {"cameras": [properties]}


def bounded(**properties: Any) -> dict[str, Any]:
    return {"accessors": [{"componentType": 5126, "count": 1, "type": "VEC2", **properties}]}


PERSPECTIVE = {"yfov": 1, "znear": 1}
ORTHOGRAPHIC = {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}

SOUND = {
    "numbers": node(translation=[1, 2.5, -3e30]),
    "an integer written as a float": {"samplers": [{"magFilter": 9728.0}]},
    "a factor of 0": material(alphaCutoff=0),
    "an object in extras": {"extras": {}},
    "null in extras": {"extras": None},
    "a camera with its part": camera(type="perspective", perspective=PERSPECTIVE),
    "a part that the type does not name is not read": camera(
        type="orthographic", orthographic=ORTHOGRAPHIC, name="b"
    ),
    "as many bounds as components": bounded(min=[0, 0], max=[1, 1]),
}

FAULTY = {
    "text for a number": (material(alphaCutoff="a"), {("TYPE_MISMATCH", "/materials/0/alphaCutoff")}),
    "true is no number": (material(alphaCutoff=True), {("TYPE_MISMATCH", "/materials/0/alphaCutoff")}),
    "1 is no flag": (material(doubleSided=1), {("TYPE_MISMATCH", "/materials/0/doubleSided")}),
    "a number for text": (node(name=5), {("TYPE_MISMATCH", "/nodes/0/name")}),
    "a list for an object": (material(normalTexture=[]), {("TYPE_MISMATCH", "/materials/0/normalTexture")}),
    "a fraction for an index": (node(mesh=1.5), {("TYPE_MISMATCH", "/nodes/0/mesh")}),
    "a negative index": (node(mesh=-1), {("INVALID_INDEX", "/nodes/0/mesh")}),
    "an index in a list": (
        {"nodes": [{"children": [1, -1, "a", None]}, {"extras": {}}]},
        {("INVALID_INDEX", f"/nodes/0/children/{n}") for n in (1, 2, 3)},
    ),
    "a list for a list of indices": (node(children={}), {("TYPE_MISMATCH", "/nodes/0/children")}),
    "an empty list": (node(children=[]), {("EMPTY_ENTITY", "/nodes/0/children")}),
    "a list of the file that is empty": ({"nodes": []}, {("EMPTY_ENTITY", "/nodes")}),
    "an item of the file's own list": (
        {"nodes": [None, {"extras": {}}]},
        {("TYPE_MISMATCH", "/nodes/0")},
    ),
    "an item of another list": (
        {"meshes": [{"primitives": [5]}]},
        {("ARRAY_TYPE_MISMATCH", "/meshes/0/primitives")},
    ),
    "a length": (node(scale=[1, 1]), {("ARRAY_LENGTH_NOT_IN_LIST", "/nodes/0/scale")}),
    "one number of several is text": (
        node(rotation=[0, 2, "a", 1]),
        {("ARRAY_TYPE_MISMATCH", "/nodes/0/rotation"), ("VALUE_NOT_IN_RANGE", "/nodes/0/rotation/1")},
    ),
    "below the range": (material(alphaCutoff=-1), {("VALUE_NOT_IN_RANGE", "/materials/0/alphaCutoff")}),
    "infinite": (
        '{"asset": {"version": "2.0"}, "nodes": [{"extras": {}, "scale": [1, 1, 1e999]}]}',
        {("VALUE_NOT_IN_RANGE", "/nodes/0/scale/2")},
    ),
    "not in the list": (
        {"samplers": [{"wrapS": 5, "minFilter": 9984}]},
        {("VALUE_NOT_IN_LIST", "/samplers/0/wrapS")},
    ),
    "not in a list that counts from 0": (
        primitive(attributes={"POSITION": 0}, mode=7),
        {("VALUE_NOT_IN_RANGE", "/meshes/0/primitives/0/mode")},
    ),
    "not a multiple": (
        {"bufferViews": [{"buffer": 0, "byteLength": 6, "byteStride": 6}], "buffers": [{"byteLength": 6}]},
        {("VALUE_MULTIPLE_OF", "/bufferViews/0/byteStride")},
    ),
    "a form": ({"asset": {"version": "2"}}, {("PATTERN_MISMATCH", "/asset/version")}),
    "what must be there": ({"buffers": [{}]}, {("UNDEFINED_PROPERTY", "/buffers/0")}),
    "what must be there is null": (
        {"buffers": [{"byteLength": None}]},
        {("UNDEFINED_PROPERTY", "/buffers/0"), ("TYPE_MISMATCH", "/buffers/0/byteLength")},
    ),
    "the asset is missing": ('{"nodes": [{}]}', {("UNDEFINED_PROPERTY", "/")}),
    "an unknown property": (node(foo=1), {("UNEXPECTED_PROPERTY", "/nodes/0/foo")}),
    "an unknown property with a name to be escaped": (
        {"a/b~c": 1},
        {("UNEXPECTED_PROPERTY", "/a~1b~0c")},
    ),
    "extras that are no object": ({"extras": 5}, {("NON_OBJECT_EXTRAS", "/extras")}),
    "a dependency": (node(weights=[1]), {("UNSATISFIED_DEPENDENCY", "/nodes/0/weights")}),
    "a dependency that is broken": (
        node(weights=[1], mesh=-1),
        {("UNSATISFIED_DEPENDENCY", "/nodes/0/weights"), ("INVALID_INDEX", "/nodes/0/mesh")},
    ),
    "neither of two": ({"images": [{}]}, {("ONE_OF_MISMATCH", "/images/0")}),
    "a repeated index": (
        {"nodes": [{"extras": {}}], "scenes": [{"nodes": [0, 0]}]},
        {("DUPLICATE_ELEMENTS", "/scenes/0/nodes/1")},
    ),
    "an empty map": (
        primitive(attributes={}),
        {("EMPTY_ENTITY", "/meshes/0/primitives/0/attributes")},
    ),
    "an empty map in a list, a wrong item beside it": (
        primitive(attributes={"POSITION": 0}, targets=[{}, 5]),
        {
            ("EMPTY_ENTITY", "/meshes/0/primitives/0/targets/0"),
            ("ARRAY_TYPE_MISMATCH", "/meshes/0/primitives/0/targets"),
        },
    ),
    "no part for the camera's type": (camera(type="perspective"), {("UNDEFINED_PROPERTY", "/cameras/0")}),
    "two parts": (
        camera(type="perspective", perspective=PERSPECTIVE, orthographic={}),
        {("ONE_OF_MISMATCH", "/cameras/0")},
    ),
    "no type": (camera(perspective={}), {("UNDEFINED_PROPERTY", "/cameras/0")}),
    "fewer bounds than components": (
        bounded(min=["a"]),
        {("ARRAY_LENGTH_NOT_IN_LIST", "/accessors/0/min")},
    ),
    "no bounds of integers": (
        bounded(componentType=5121, min=[]),
        {("ARRAY_LENGTH_NOT_IN_LIST", "/accessors/0/min")},
    ),
    "no bounds of floats": (bounded(min=[]), {("EMPTY_ENTITY", "/accessors/0/min")}),
    "an offset into nothing is not read": (
        bounded(byteOffset="a"),
        {("UNSATISFIED_DEPENDENCY", "/accessors/0/byteOffset")},
    ),
    "bounds of an unknown type are not read": (
        bounded(type="VEC5", min=["a"]),
        {("VALUE_NOT_IN_LIST", "/accessors/0/type")},
    ),
}


@pytest.mark.parametrize("asset", SOUND.values(), ids=SOUND.keys())
def test_nothing_is_told_of_what_is_right(asset: dict[str, Any], codes: Codes) -> None:
    assert codes(asset) == set()


@pytest.mark.parametrize(("asset", "told"), FAULTY.values(), ids=FAULTY.keys())
def test_each_fault_is_told_where_it_stands(
    asset: dict[str, Any] | str, told: set[tuple[str, str]], codes: Codes
) -> None:
    assert codes(asset) == told


def test_a_file_of_another_version_is_not_looked_into(codes: Codes) -> None:
    broken = {"nodes": 5, "extras": 5, "extensions": 5, "foo": 1, "extensionsUsed": 5}
    assert codes({"asset": {"version": "3.0"}, **broken}) == {
        ("UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version"),
        ("UNEXPECTED_PROPERTY", "/foo"),
        ("TYPE_MISMATCH", "/extensionsUsed"),
    }


@pytest.mark.parametrize("number", ["1" * 400, "1e400", "-1e400"])
@pytest.mark.parametrize("key", ["translation", "children", "weights", "matrix", "skin"])
def test_numbers_beyond_a_double_are_told_and_never_met_by_a_rule(
    number: str, key: str, codes: Codes
) -> None:
    items = {"translation": 3, "children": 1, "weights": 1, "matrix": 16, "skin": 0}[key]
    value = f"[{', '.join([number] * items)}]" if items else number
    told = codes(f'{{"asset": {{"version": "2.0"}}, "nodes": [{{"extras": {{}}, "{key}": {value}}}]}}')
    assert {code for code, _ in told} <= {"VALUE_NOT_IN_RANGE", "INVALID_INDEX", "TYPE_MISMATCH"}
    assert told


@pytest.mark.parametrize(("value", "word"), [(None, "null"), (True, "true"), ([], "an array"), ("a", "'a'")])
def test_a_value_is_shown_in_the_words_of_json(value: object, word: str) -> None:
    report = validate(json.dumps({"asset": {"version": "2.0"}, "scene": value}).encode())
    assert f"The value {word} is not an index." in [told.message for told in report.issues]
