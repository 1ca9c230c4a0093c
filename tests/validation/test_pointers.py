"""Animation pointers of real files, and values that only stand in a buffer in an odd way."""

from __future__ import annotations

import base64
import struct
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

_SAMPLES = Path(__file__).resolve().parents[2] / "samples"


def _animated(pointer: str, data: bytes, view: dict[str, Any], accessor: dict[str, Any]) -> dict[str, Any]:
    """Return a material whose property takes two keyframes from `data`."""
    times = struct.pack("<2f", 0.0, 1.0)
    encoded = base64.b64encode(times + data).decode()
    return {
        "extensionsUsed": ["KHR_animation_pointer"],
        "materials": [{}],
        "buffers": [
            {
                "byteLength": 8 + len(data),
                "uri": f"data:application/octet-stream;base64,{encoded}",
            }
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 8},
            {"buffer": 0, "byteOffset": 8, "byteLength": len(data), **view},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
            {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3", **accessor},
        ],
        "animations": [
            {
                "samplers": [{"input": 0, "output": 1}],
                "channels": [
                    {
                        "sampler": 0,
                        "target": {
                            "path": "pointer",
                            "extensions": {"KHR_animation_pointer": {"pointer": pointer}},
                        },
                    }
                ],
            }
        ],
    }


@pytest.mark.shared
def test_of_a_file_with_seventy_pointers_only_its_two_mistakes_are_told(shared_dir: Path) -> None:
    path = shared_dir / "assets/iridescence/AnimationPointer/24_animation_pointer.gltf"
    told = {i.code: i.message for i in validate(path, options=Options(max_issues=0)).issues}
    ours = {code: message for code, message in told.items() if code.startswith("IRI_POINTER_")}
    assert set(ours) == {"IRI_POINTER_UNDEFINED", "IRI_POINTER_REPEATED"}
    assert "/materials/5/normalTexture/offset" in ours["IRI_POINTER_UNDEFINED"]
    assert "/materials/6/occlusionTexture/strength" in ours["IRI_POINTER_REPEATED"]


@pytest.mark.parametrize("sample", sorted(_SAMPLES.glob("*/*.gl[bt]*")), ids=lambda path: path.stem)
def test_samples_break_no_rule_of_layers_and_pointers(sample: Path) -> None:
    issues = validate(sample, options=Options(max_issues=0)).issues
    assert [i for i in issues if i.severity == 0] == []
    assert [i for i in issues if i.code.startswith("IRI_POINTER_")] == []


@pytest.mark.parametrize(("last", "expected"), [(1.0, False), (1.5, True)])
def test_values_with_gaps_between_them_are_read(codes: Any, last: float, expected: bool) -> None:
    data = struct.pack("<3f", 0.0, 0.5, 1.0) + struct.pack("<f", 9.0) + struct.pack("<3f", 0.0, 0.0, last)
    told = codes(_animated("/materials/0/emissiveFactor", data, {"byteStride": 16}, {}))
    assert (("IRI_POINTER_VALUE", "/animations/0/samplers/0/output") in told) is expected


@pytest.mark.parametrize(("last", "expected"), [(1.0, False), (1.5, True)])
def test_values_after_an_offset_are_read(codes: Any, last: float, expected: bool) -> None:
    data = struct.pack("<7f", 9.0, 0.0, 0.5, 1.0, 0.0, 0.0, last)
    told = codes(_animated("/materials/0/emissiveFactor", data, {}, {"byteOffset": 4}))
    assert (("IRI_POINTER_VALUE", "/animations/0/samplers/0/output") in told) is expected


def test_a_count_that_no_buffer_holds_is_not_read(codes: Any) -> None:
    data = struct.pack("<6f", *[9.0] * 6)
    told = codes(_animated("/materials/0/emissiveFactor", data, {}, {"count": 10**15}))
    assert not [code for code, _ in told if code == "IRI_POINTER_VALUE"]
    assert ("IRI_POINTER_OUTPUT_COUNT", "/animations/0/samplers/0/output") in told


def test_many_values_are_told_of_in_one_remark(judge: Any) -> None:
    values = [0.5] * 300_000
    values[200_001] = values[299_999] = -1.0
    data = struct.pack(f"<{len(values)}f", *values)
    asset = _animated("/materials/0/emissiveFactor", data, {}, {"count": len(values) // 3})
    (found,) = (i for i in judge(asset).issues if i.code == "IRI_POINTER_VALUE")
    assert "the first of 2 outside is -1, at 66667" in found.message


def test_a_value_allowed_alone_hides_none_between_it_and_the_range(codes: Any) -> None:
    """An index of refraction may be 0, or 1 and more."""
    data = struct.pack("<3f", 0.0, 0.5, 1.5)
    asset = _animated(
        "/materials/0/extensions/KHR_materials_ior/ior", data, {}, {"type": "SCALAR", "count": 3}
    )
    asset["extensionsUsed"].append("KHR_materials_ior")
    asset["materials"] = [{"extensions": {"KHR_materials_ior": {}}}]
    assert ("IRI_POINTER_VALUE", "/animations/0/samplers/0/output") in codes(asset)


def test_each_sampler_has_values_of_its_own(judge: Any) -> None:
    asset = _animated("/materials/0/emissiveFactor", struct.pack("<12f", *[0.5] * 6, *[1.5] * 6), {}, {})
    asset["accessors"].append({**asset["accessors"][1], "byteOffset": 24})
    animation = asset["animations"][0]
    animation["samplers"].append({"input": 0, "output": 2})
    animation["channels"].append({**animation["channels"][0], "sampler": 1})
    found = [i.pointer for i in judge(asset).issues if i.code == "IRI_POINTER_VALUE"]
    assert found == ["/animations/0/samplers/1/output"]


def test_values_of_another_size_are_told_as_that_alone(codes: Any) -> None:
    data = struct.pack("<4f", *[9.0] * 4)
    told = {code for code, _ in codes(_animated("/materials/0/emissiveFactor", data, {}, {"type": "VEC2"}))}
    assert "IRI_POINTER_OUTPUT_TYPE" in told
    assert "IRI_POINTER_VALUE" not in told
