"""Films whose numbers move or whose base is broken: what is then not said."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_data import FLOAT, Data

NAME = "KHR_materials_iridescence"


def film(material: dict[str, Any], moved: str = "", **numbers: float) -> dict[str, Any]:
    """Return a material with a film; `moved` is what an animation moves, as a pointer below the material."""
    data = Data(extensionsUsed=[NAME, "KHR_animation_pointer"])
    extension = {"iridescenceFactor": 1.0, **numbers}
    data.root["materials"] = [{**material, "extensions": {NAME: extension}}]
    if moved:
        times = data.accessor("SCALAR", FLOAT, [0.0, 1.0], min=[0], max=[1])
        sampler = {"input": times, "output": data.accessor("SCALAR", FLOAT, [1.0, 1.0])}
        pointer = {"KHR_animation_pointer": {"pointer": f"/materials/0/{moved}"}}
        channel = {"sampler": 0, "target": {"path": "pointer", "extensions": pointer}}
        data.root["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    return data.asset


@pytest.mark.parametrize(
    ("numbers", "code", "moving"),
    [
        ({"iridescenceIor": 1.0}, "FILM_IS_AIR", "iridescenceIor"),
        ({"iridescenceIor": 1.5}, "FILM_IS_BASE", "iridescenceIor"),
        ({"iridescenceIor": 9.0}, "IOR_ABSURD", "iridescenceIor"),
        ({"iridescenceIor": 9.0}, "INDEX_ORDER", "iridescenceIor"),
        ({"iridescenceThicknessMaximum": 0.0}, "THICKNESS_ZERO", "iridescenceThicknessMaximum"),
        ({"iridescenceFactor": 0.0}, "IDLE", "iridescenceFactor"),
    ],
)
def test_where_a_moving_number_starts_says_nothing(
    numbers: dict[str, float], code: str, moving: str, codes: Codes
) -> None:
    def told(moved: str) -> set[str]:
        base = {"pbrMetallicRoughness": {"metallicFactor": 0.0}}
        return {code for code, _ in codes(film(base, moved, **numbers))}

    whole = f"IRI_IRIDESCENCE_{code}"
    assert whole in told("")
    assert whole not in told(f"extensions/{NAME}/{moving}")


@pytest.mark.parametrize("pbr", ["x", {"metallicFactor": "x"}, {"metallicFactor": 0.0, "baseColorFactor": 1}])
def test_a_broken_base_is_never_the_film(pbr: Any, codes: Codes) -> None:
    def told(pbr: Any) -> set[str]:
        return {code for code, _ in codes(film({"pbrMetallicRoughness": pbr}, iridescenceIor=1.5))}

    assert "IRI_IRIDESCENCE_FILM_IS_BASE" in told({"metallicFactor": 0.0})
    assert "IRI_IRIDESCENCE_FILM_IS_BASE" not in told(pbr)
