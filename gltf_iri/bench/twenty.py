"""A scene of 20 balls of 20 materials; the last three are iridescent, and the 17 before are not."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sphere import sphere

__all__ = ["FILMED", "TWENTY", "scene_files"]

TWENTY: Final = 20
FILMED: Final = 3

_COLUMNS: Final = 5
_RADIUS_M: Final = 0.45
_FLOAT, _UNSIGNED_SHORT = 5126, 5123
_CHECKS, _WAVES = 0, 1  # textures

_FILM: Final = {
    "iridescenceFactor": 1.0,
    "iridescenceThicknessMinimum": 150.0,
    "iridescenceThicknessMaximum": 600.0,
}


def _film(ior: float, **more: Any) -> dict[str, Any]:
    return {"KHR_materials_iridescence": {**_FILM, "iridescenceIor": ior, **more}}


# Beside the core's factors, which differ from ball to ball: textures, blending and layers on some of the 17.
_MORE: Final[Mapping[int, Mapping[str, Any]]] = {
    1: {"occlusionTexture": {"index": _CHECKS}},
    4: {"emissiveFactor": [0.2, 0.1, 0.0]},
    5: {"doubleSided": True},
    7: {"alphaMode": "MASK"},
    9: {"emissiveFactor": [0.3, 0.3, 0.3], "emissiveTexture": {"index": _CHECKS}},
    10: {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0}}},
    12: {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5}}},
    15: {"extensions": {"KHR_materials_specular": {"specularFactor": 0.5}}},
    17: {"extensions": _film(1.33)},
    18: {"extensions": _film(1.8, iridescenceThicknessTexture={"index": _WAVES})},
    19: {"extensions": _film(1.5, iridescenceThicknessTexture={"index": _WAVES})},
}
_ALIKE: Final = range(TWENTY - FILMED, TWENTY)
_PAINTED: Final = (2, 3, 6, 11, 13, 18)  # with a base colour texture
_WORN: Final = (6, 8, 13, 16)  # with a texture of metalness and roughness
_METALLIC: Final = (0.0, 1.0, 0.4, 0.0, 1.0)  # of every fifth ball


def scene_files(
    materials: int = TWENTY, balls: int = TWENTY, *, are_films_alike: bool = False
) -> dict[str, bytes]:
    """Return a .gltf with its files: the first `balls`, where they stand among all, of so many materials.

    Balls beyond the last material wear the first ones once more.

    are_films_alike : the three iridescent materials call for the same effects, and differ by their numbers.
    """
    shape = sphere(_RADIUS_M, rings=24, segments=48)
    arrays: tuple[tuple[NDArray[Any], str, int], ...] = (
        (shape.positions.astype("<f4"), "VEC3", _FLOAT),
        (shape.normals.astype("<f4"), "VEC3", _FLOAT),
        (shape.uvs.astype("<f4"), "VEC2", _FLOAT),
        (shape.triangles.astype("<u2").ravel(), "SCALAR", _UNSIGNED_SHORT),
    )
    binary, views = b"", []
    accessors: list[dict[str, Any]] = []
    for array, kind, component in arrays:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        accessors.append(
            {"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind}
        )
        binary += array.tobytes() + bytes(-array.nbytes % 4)
    accessors[0] |= {"min": arrays[0][0].min(axis=0).tolist(), "max": arrays[0][0].max(axis=0).tolist()}
    worn = [_film_alone(k) if are_films_alike and k in _ALIKE else _material(k) for k in range(materials)]
    places = [divmod(k, _COLUMNS) for k in range(balls)]
    camera = {
        "type": "perspective",
        "perspective": {"yfov": 0.6, "aspectRatio": 1.25, "znear": 1.0, "zfar": 100.0},
    }
    file = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(balls + 1))}],
        "nodes": [
            *({"mesh": k, "translation": [c - 2.0, 1.5 - r, 0.0]} for k, (r, c) in enumerate(places)),
            {"camera": 0, "translation": [0.0, 0.0, 7.0]},
        ],
        "cameras": [camera],
        "meshes": [{"primitives": [_primitive(k % materials)]} for k in range(balls)],
        "materials": worn,
        "textures": [{"source": _CHECKS}, {"source": _WAVES}],
        "images": [{"uri": "checks.png"}, {"uri": "waves.png"}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"uri": "balls.bin", "byteLength": len(binary)}],
        "extensionsUsed": sorted({name for each in worn for name in each.get("extensions", {})}),
    }
    u, v = texel_centres(64, 64)
    waves = 0.5 + 0.5 * np.sin(2.0 * np.pi * 3.0 * u) * np.sin(np.pi * v)
    checks = np.where((np.floor(8.0 * u) + np.floor(8.0 * v))[..., None] % 2 > 0.5, [1.0, 0.8, 0.5], 0.6)
    return {
        "balls.gltf": json.dumps(file).encode(),
        "balls.bin": binary,
        "checks.png": encode_png(to_bytes(checks)),
        "waves.png": encode_png(to_bytes(waves)),
    }


def _primitive(material: int) -> dict[str, Any]:
    return {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": material}


def _material(k: int) -> dict[str, Any]:
    g = np.random.default_rng(k)
    core: dict[str, Any] = {
        "baseColorFactor": [*np.round(g.uniform(0.2, 0.9, 3), 3).tolist(), 1.0],
        "metallicFactor": _METALLIC[k % len(_METALLIC)],
        "roughnessFactor": round(float(g.uniform(0.2, 0.8)), 3),
    }
    if k in _PAINTED:
        core["baseColorTexture"] = {"index": _CHECKS}
    if k in _WORN:
        core["metallicRoughnessTexture"] = {"index": _CHECKS}
    return {"name": f"material {k}", "pbrMetallicRoughness": core, **_MORE.get(k, {})}


def _film_alone(k: int) -> dict[str, Any]:
    core = {"metallicFactor": 0.0, "roughnessFactor": 0.3}
    film = _film(1.35 + 0.1 * (k % FILMED), iridescenceThicknessMaximum=300.0 + 50.0 * (k % FILMED))
    return {"name": f"material {k}", "pbrMetallicRoughness": core, "extensions": film}
