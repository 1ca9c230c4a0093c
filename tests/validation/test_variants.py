"""Variants of materials; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import POSITIONS, mesh

NAME = "KHR_materials_variants"
AT = f"/meshes/0/primitives/0/extensions/{NAME}/mappings"
VARIANTS = {NAME: {"variants": [{"name": "a"}, {"name": "b"}]}}


def of(*mappings: Any, extensions: dict[str, Any] = VARIANTS) -> dict[str, Any]:
    return {
        "extensionsUsed": [NAME],
        "extensions": extensions,
        "materials": [{}],
        "accessors": [POSITIONS],
        "meshes": [mesh({"POSITION": 0}, extensions={NAME: {"mappings": list(mappings)}})],
    }


def mapping(*variants: Any, material: Any = 0) -> dict[str, Any]:
    return {"variants": list(variants), "material": material}


def test_each_variant_may_have_its_material(codes: Codes) -> None:
    assert codes(of(mapping(0), mapping(1))) == set()
    assert codes(of(mapping(0, 1))) == set()


@pytest.mark.parametrize(
    ("mappings", "places"),
    [
        ([mapping(0), mapping(0)], ["1/variants/0"]),
        ([mapping(0, 1), mapping(1, 0)], ["1/variants/0", "1/variants/1"]),
        ([mapping(0.0), mapping(0)], ["1/variants/0"]),
        ([mapping(0), mapping(1), mapping(0), mapping(0)], ["2/variants/0", "3/variants/0"]),
    ],
)
def test_a_variant_stands_once_in_all_mappings(
    codes: Codes, mappings: list[dict[str, Any]], places: list[str]
) -> None:
    told = {("KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", f"{AT}/{place}") for place in places}
    assert codes(of(*mappings)) == told


def test_a_variant_that_stands_twice_in_one_mapping_is_told_twice(codes: Codes) -> None:
    place = f"{AT}/0/variants/1"
    twice = {("DUPLICATE_ELEMENTS", place), ("KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", place)}
    assert codes(of(mapping(0, 0))) == twice


def test_a_variant_that_does_not_exist_counts_too(codes: Codes) -> None:
    assert codes(of(mapping(9), mapping(9))) == {
        ("UNRESOLVED_REFERENCE", f"{AT}/0/variants/0"),
        ("UNRESOLVED_REFERENCE", f"{AT}/1/variants/0"),
        ("KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", f"{AT}/1/variants/0"),
    }


@pytest.mark.parametrize("index", [-1, "a", True, 0.5])
def test_what_is_no_index_does_not(codes: Codes, index: Any) -> None:
    assert codes(of(mapping(index), mapping(index))) == {
        ("INVALID_INDEX", f"{AT}/0/variants/0"),
        ("INVALID_INDEX", f"{AT}/1/variants/0"),
    }


def test_without_a_list_of_variants_mappings_mean_nothing(codes: Codes) -> None:
    told = codes(of(mapping(0, material=9), mapping(0), extensions={}), unused=True)
    assert told >= {("UNSATISFIED_DEPENDENCY", f"{AT}/0"), ("UNSATISFIED_DEPENDENCY", f"{AT}/1")}
    assert {code for code, _ in told} == {"UNSATISFIED_DEPENDENCY", "UNUSED_OBJECT"}
    assert ("UNUSED_OBJECT", "/materials/0") in told
