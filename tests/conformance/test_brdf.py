"""The vectors' BRDFs follow from their colours by the proposal's formulas, written out here once more."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import numpy as np

LAST_DECIMAL = 6e-10


def coating(n: float, cosine: float) -> float:
    """What the smooth surface of an index lets in, mean of s and p; air has none."""
    if n == 1.0:
        return 1.0
    inside = sqrt(1.0 - (1.0 - cosine**2) / n**2)
    s, p = (cosine - n * inside) / (cosine + n * inside), (n * cosine - inside) / (n * cosine + inside)
    return 1.0 - 0.5 * (s * s + p * p)


def lobe(alpha: float, light: Any, viewer: Any, *, is_separable: bool) -> float:
    """D G₁G₁ / (4 cosθ_i cosθ_o) of GGX, or with height-correlated masking."""
    half = (light + viewer) / np.linalg.norm(light + viewer)
    density = alpha**2 / (pi * (half[2] ** 2 * alpha**2 + half[0] ** 2 + half[1] ** 2) ** 2)
    i, o = light[2], viewer[2]
    root_i, root_o = (sqrt(alpha**2 + (1.0 - alpha**2) * c * c) for c in (i, o))
    masked = 1.0 / ((i + root_i) * (o + root_o)) if is_separable else 0.5 / (i * root_o + o * root_i)
    return float(density * masked)


def schlick(f0: Any, light: Any, viewer: Any) -> Any:
    cosine = min(np.linalg.norm(light + viewer) / 2.0, 1.0)
    return f0 + (1.0 - f0) * (1.0 - cosine) ** 5


def poses(row: dict[str, Any], n: float) -> tuple[Any, Any]:
    """Light and viewer as unit vectors, behind a flat surface of index `n`."""
    found = []
    for cosine, turn in ((row["cos_theta_i"], 1.0), (row["cos_theta_o"], row["cos_phi"])):
        sine = sqrt(1.0 - cosine**2) / n
        found.append(np.array([sine * turn, sine * sqrt(1.0 - turn * turn), sqrt(1.0 - sine**2)]))
    return found[0], found[1]


class Read:
    """A row's material, its textures multiplied in."""

    def __init__(self, row: dict[str, Any]) -> None:
        pbr, extensions = row["material"]["pbrMetallicRoughness"], row["material"]["extensions"]
        bragg = extensions["EXT_materials_bragg"]
        self.share = bragg["braggFactor"] * row["bragg_texture"]
        self.host, self.layers = bragg.get("hostIor", 1.0), bragg.get("layers", [])
        self.colour, self.metal = np.array(pbr["baseColorFactor"][:3]), pbr["metallicFactor"]
        self.alpha = pbr["roughnessFactor"] ** 2
        self.passes = extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0.0)


def core(it: Read, row: dict[str, Any]) -> Any:
    light, viewer = poses(row, 1.0)
    shine = lobe(it.alpha, light, viewer, is_separable=False)
    mirrored = schlick(0.04, light, viewer)
    glass = (1.0 - mirrored) * (1.0 - it.passes) * it.colour / pi + mirrored * shine
    return (1.0 - it.metal) * glass + it.metal * schlick(it.colour, light, viewer) * shine


def test_brdfs_are_made_of_the_colours_that_stand_beside_them(bragg: dict[str, Any]) -> None:
    bent = 0
    for each in bragg["rows"]:
        row, out = each["input"], each["output"]
        it = Read(row)
        if out["stack_brdf"] is None:
            continue
        light, viewer = poses(row, it.host)
        crossed = coating(it.host, row["cos_theta_i"]) * coating(it.host, row["cos_theta_o"]) / it.host**2
        lobes = [lobe(layer["roughness"] ** 2, light, viewer, is_separable=True) for layer in it.layers]
        behind = it.layers[-1].get("ior1", it.host)
        bent += behind != it.host
        base = (1.0 - it.metal) * (1.0 - it.passes) * it.colour / pi * (it.host / behind) ** 2
        if it.metal > 0.0:
            shine = lobe(it.alpha, light, viewer, is_separable=True)
            base = base + it.metal * shine * schlick(it.colour, light, viewer)
        sent = crossed * (np.array(lobes) @ out["layer_colours"] + base * np.array(out["base_colour"]))
        doubt = LAST_DECIMAL * (1.0 + crossed * (sum(lobes) + base.max()))
        np.testing.assert_allclose(out["stack_brdf"], sent, rtol=1e-9, atol=doubt, err_msg=str(each["row"]))
    assert bent > 20


def test_the_factor_mixes_the_stack_with_the_core_material(bragg: dict[str, Any]) -> None:
    for each in bragg["rows"]:
        row, out = each["input"], each["output"]
        it = Read(row)
        share = it.share if out["layer_colours"] else 0.0
        if out["stack_brdf"] is None and share > 0.0:
            assert out["brdf"] is None
            continue
        stack = np.zeros(3) if share == 0.0 else np.array(out["stack_brdf"])
        mixed = (1.0 - share) * core(it, row) + share * stack
        np.testing.assert_allclose(
            out["brdf"], mixed, rtol=1e-9, atol=2.0 * LAST_DECIMAL, err_msg=str(each["row"])
        )


def test_what_comes_from_behind_crosses_the_hosts_surface_once(bragg: dict[str, Any]) -> None:
    count = 0
    for each in bragg["rows"]:
        row, out = each["input"], each["output"]
        it = Read(row)
        if not out["layer_colours"]:
            continue
        share = coating(it.host, row["cos_theta_o"]) * (1.0 - it.metal) * it.passes
        expected = share * it.colour * np.array(out["entering"])
        np.testing.assert_allclose(out["transmitted"], expected, rtol=0.0, atol=2.0 * LAST_DECIMAL)
        mirrored = 1.0 - coating(it.host, row["cos_theta_i"])
        assert abs(out["coating_reflectance"] - mirrored) <= LAST_DECIMAL
        count += share > 0.0
    assert count > 50
