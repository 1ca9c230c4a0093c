"""The parser: what the rows allow is read back unchanged, and everything else is refused with its place."""

from __future__ import annotations

import dataclasses
import json
import math
from functools import cache
from itertools import pairwise
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.errors import AssetError
from gltf_iri.material.fields import Kind, Property, properties
from gltf_iri.material.material import Material
from gltf_iri.material.parse import parse_materials
from gltf_iri.material.texture import TextureInfo

TEXTURES = 3


def parse(*materials):
    root = {"materials": list(materials), "textures": [{}] * TEXTURES}
    return parse_materials(SimpleNamespace(json=root))


def refused(material) -> str:
    with pytest.raises(AssetError) as caught:
        parse(material)
    return str(caught.value)


def numbers(row: Property):
    low = -MAX_NUMBER if row.low is None else row.low
    high = MAX_NUMBER if row.high is None else row.high
    inside = st.floats(low, high, exclude_min=row.low_is_excluded)
    return inside if row.also_allowed is None else inside | st.just(row.also_allowed)


def values(row: Property):
    """Legal JSON values of one row."""
    match row.kind:
        case Kind.NUMBER:
            return numbers(row)
        case Kind.VECTOR:
            return st.lists(numbers(row), min_size=row.length, max_size=row.length)
        case Kind.FLAG:
            return st.booleans()
        case Kind.TEXT:
            return st.text(max_size=8)
        case Kind.CHOICE:
            return st.sampled_from(row.choices)
        case Kind.INDEX:
            return st.integers(0, TEXTURES - 1)
        case Kind.WHOLE_NUMBER:
            return st.integers(row.low, row.high)
        case Kind.NESTED_LIST:
            return st.lists(objects(row.cls), max_size=row.length)
        case _:
            return objects(row.cls)


@cache
def objects(cls):
    """Legal JSON objects of a class of rows, each optional property there or not."""
    required, optional, extensions = {}, {}, {}
    for _, row in properties(cls):
        group = extensions if row.kind is Kind.EXTENSION else required if row.required else optional
        group[row.key] = values(row)
    if extensions:
        optional["extensions"] = st.fixed_dictionaries({}, optional=extensions)
    return st.fixed_dictionaries(required, optional=optional)


def to_json(built):
    """Write a dataclass of rows back to JSON, every value in full."""
    entry, extensions = {}, {}
    for attribute, row in properties(type(built)):
        value = getattr(built, attribute)
        if value in (None, math.inf):  # JSON has neither; being absent says it
            continue
        if dataclasses.is_dataclass(value):
            value = to_json(value)
        elif row.kind is Kind.NESTED_LIST:
            value = [to_json(each) for each in value]
        (extensions if row.kind is Kind.EXTENSION else entry)[row.key] = value
    return {**entry, **({"extensions": extensions} if extensions else {})}


def every_row(cls, pointer=""):
    """Yield (path of keys, row) of a class and of everything inside it."""
    for _, row in properties(cls):
        here = f"{pointer}/extensions/{row.key}" if row.kind is Kind.EXTENSION else f"{pointer}/{row.key}"
        yield here, row
        if row.cls is not None:
            yield from every_row(row.cls, f"{here}/0" if row.kind is Kind.NESTED_LIST else here)


ROWS = list(every_row(Material))
NUMBERS = (Kind.NUMBER, Kind.VECTOR, Kind.WHOLE_NUMBER)
RANGED = [(path, row) for path, row in ROWS if row.kind in NUMBERS and row.low is not None]


def with_value(path: str, value):
    """Return a material with `value` at `path`, required neighbours filled in."""
    material = {}
    place = material
    *way, last = path.strip("/").split("/")
    for key, after in pairwise([*way, last]):
        if key == "0":
            place.append({})
            place = place[0]
        else:
            place = place.setdefault(key, [] if after == "0" else {})
        if key.endswith("Texture"):
            place["index"] = 0
    place[last] = value
    return material


@given(objects(Material))
def test_a_legal_material_survives_the_way_into_dataclasses_and_back(entry):
    (material,) = parse(json.loads(json.dumps(entry)))
    assert parse(json.loads(json.dumps(to_json(material))))[0] == material


@given(objects(Material))
def test_what_is_absent_has_the_default_of_its_row(entry):
    (material,) = parse(entry)
    for attribute, row in properties(Material):
        if row.kind not in (Kind.EXTENSION, Kind.NESTED) and row.key not in entry:
            assert getattr(material, attribute) == row.default


def test_an_empty_material_is_gltfs_default_material():
    assert parse({}) == (Material(),)
    assert parse_materials(SimpleNamespace(json={})) == ()


@pytest.mark.parametrize(("path", "row"), RANGED, ids=[path for path, _ in RANGED])
def test_a_number_outside_its_range_is_refused_at_its_place(path, row):
    if row.kind is Kind.WHOLE_NUMBER:
        wrong = [row.low - 1]
    else:
        wrong = [math.nextafter(row.low, -math.inf)] if not row.low_is_excluded else [row.low]
        if row.high is not None:
            wrong.append(math.nextafter(row.high, math.inf))
    for number in wrong:
        value = [number] * row.length if row.kind is Kind.VECTOR else number
        message = refused(with_value(path, value))
        place = f"{path}/0" if row.kind is Kind.VECTOR else path
        assert message.startswith(f"/materials/0{place}: ")
        assert f"is outside {row.range_text}" in message


@pytest.mark.parametrize(("path", "row"), ROWS, ids=[path for path, _ in ROWS])
def test_a_value_of_the_wrong_type_is_refused_at_its_place(path, row):
    right = {
        Kind.NUMBER: (float,),
        Kind.FLAG: (bool,),
        Kind.TEXT: (str,),
        Kind.NESTED: (dict,),
        Kind.NESTED_LIST: (list,),
        Kind.EXTENSION: (dict,),
    }
    for value in (None, True, "PAINTED", 0.5, [], {}):
        if type(value) not in right.get(row.kind, ()):
            assert refused(with_value(path, value)).startswith(f"/materials/0{path}: ")


@pytest.mark.parametrize("value", [10**400, -(10**400), 1e39])
def test_a_number_beyond_single_precision_is_refused_in_one_short_line(value):
    sentence = refused({"emissiveFactor": [value, 0, 0]})
    assert "beyond single precision" in sentence
    assert len(sentence) < 160
    with pytest.raises(AssetError):
        parse({"normalTexture": {"index": value}})


@pytest.mark.parametrize("index", [TEXTURES, 10**400, -1])
def test_a_texture_that_does_not_exist_is_refused(index):
    sentence = refused({"normalTexture": {"index": index}})
    assert sentence.startswith("/materials/0/normalTexture/index: ")
    assert len(sentence) < 200


def test_a_texture_info_without_index_is_refused():
    assert refused({"occlusionTexture": {"strength": 1.0}}) == (
        "/materials/0/occlusionTexture: the required property 'index' is missing; add it."
    )


def test_a_vector_of_the_wrong_length_is_refused():
    assert refused({"emissiveFactor": [0, 0]}).startswith(
        "/materials/0/emissiveFactor: 2 numbers stand where 3"
    )


def test_the_range_error_is_one_sentence_with_place_and_remedy():
    assert refused({"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1.5}}}) == (
        "/materials/0/extensions/KHR_materials_iridescence/iridescenceFactor: "
        "1.5 is outside [0, 1]; write a value inside that range."
    )


def test_an_index_may_be_written_as_a_whole_float():
    assert parse({"normalTexture": {"index": 1.0}})[0].normal_texture.texture == 1


def test_unknown_extensions_are_collected_from_everywhere_in_the_material():
    info = {"index": 0, "extensions": {"EXT_texture_magic": {}}}
    (first, second) = parse(
        {
            "extensions": {"KHR_materials_diffuse_transmission": {}, "KHR_materials_ior": {}},
            "emissiveTexture": info,
        },
        {},
    )
    assert set(first.unread_extensions) == {"KHR_materials_diffuse_transmission", "EXT_texture_magic"}
    assert second.unread_extensions == ()


def test_properties_without_a_row_and_extras_are_ignored():
    assert parse({"extras": {"name": 3}, "shininess": "much"}) == (Material(),)


def test_thickness_minimum_may_exceed_the_maximum():
    entry = {"iridescenceThicknessMinimum": 500, "iridescenceThicknessMaximum": 100}
    film = parse({"extensions": {"KHR_materials_iridescence": entry}})[0].iridescence
    assert (film.thickness_min_nm, film.thickness_max_nm) == (500.0, 100.0)


def test_the_transforms_uv_set_overrides_the_texture_infos():
    transform = {"KHR_texture_transform": {"texCoord": 0}}
    (material,) = parse({"normalTexture": {"index": 0, "texCoord": 1, "extensions": transform}})
    assert isinstance(material.normal_texture, TextureInfo)
    assert material.normal_texture.uv_set == 0
