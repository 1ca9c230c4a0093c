"""Numbers about an asset: the report's `info` block, in the Khronos validator's form."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gltf_iri.validation.rules.attributes import attribute_names, count_of_sets
from gltf_iri.validation.tables import sound_value_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry

__all__ = ["asset_info"]

_TRIANGLES, _TRIANGLE_STRIP, _TRIANGLE_FAN = 4, 5, 6

# One set of joints and weights holds as many.
_INFLUENCES_PER_SET = 4


def asset_info(asset: Asset) -> dict[str, Any]:
    """Return the block, its keys in the order of the format; to be asked when all stages are through."""
    primitives = list(_primitives(asset))
    names = [attribute_names(primitive) for primitive in primitives]
    return {
        **_stated(asset),
        "animationCount": len(asset.array("animations")),
        "materialCount": len(asset.array("materials")),
        "hasMorphTargets": any(_has_targets(primitive) for primitive in primitives),
        "hasSkins": bool(asset.array("skins")),
        "hasTextures": bool(asset.array("textures")),
        "hasDefaultScene": "scene" in asset.root,
        "drawCallCount": len(primitives),
        "totalVertexCount": sum(_vertex_count(asset, primitive) for primitive in primitives),
        "totalTriangleCount": sum(_triangle_count(asset, primitive) for primitive in primitives),
        "maxUVs": max((count_of_sets(given, "TEXCOORD") or 0 for given in names), default=0),
        "maxInfluences": max((_influences(given) for given in names), default=0),
        "maxAttributes": max((len(primitive.get("attributes", ())) for primitive in primitives), default=0),
    }


def _stated(asset: Asset) -> dict[str, Any]:
    """Return what the file says of itself, and what it brings along; what it does not say is left out."""
    stated = asset.root.get("asset", {})
    told = {key: stated[key] for key in ("version", "minVersion", "generator") if key in stated}
    for key in ("extensionsUsed", "extensionsRequired"):
        names = asset.root.get(key, ())
        if names and None not in names:
            told[key] = list(dict.fromkeys(names))
    resources = [_resource(asset, resource) for resource in asset.resources.told]
    return {**told, **({"resources": resources} if resources else {})}


def _resource(asset: Asset, told: dict[str, Any]) -> dict[str, Any]:
    """Return one resource, with what a picture's header says."""
    array, _, index = told["pointer"].rpartition("/")
    info = asset.images.get(int(index)) if array == "/images" else None
    if info is None:
        return told
    return {
        "pointer": told["pointer"],
        "mimeType": info.media_type,
        **told,
        "image": info.to_json(),
    }


def _primitives(asset: Asset) -> Iterator[Entry]:
    for mesh in asset.array("meshes"):
        for primitive in mesh.get("primitives", ()) if mesh is not None else ():
            if primitive is not None:
                yield primitive


def _has_targets(primitive: Entry) -> bool:
    """Whether it has morph targets that name something, be it there or not."""
    targets = primitive.raw.get("targets")
    return isinstance(targets, list) and bool(targets) and all(isinstance(t, dict) and t for t in targets)


def _vertex_count(asset: Asset, primitive: Entry) -> int:
    """Return the count of the first attribute that has one; all others should have the same."""
    for index in primitive.get("attributes", {}).values():
        count = _count(asset, index)
        if count:
            return count
    return 0


def _count(asset: Asset, index: int) -> int:
    accessor = asset.get("accessors", index)
    count: int = accessor.get("count", 0) if accessor is not None else 0
    return count


def _triangle_count(asset: Asset, primitive: Entry) -> int:
    indexed = "indices" in primitive
    count = _count(asset, primitive["indices"]) if indexed else _vertex_count(asset, primitive)
    mode = sound_value_of(primitive, "mode")
    if mode == _TRIANGLES:
        return count // 3
    return max(count - 2, 0) if mode in (_TRIANGLE_STRIP, _TRIANGLE_FAN) else 0


def _influences(names: Any) -> int:
    joints, weights = count_of_sets(names, "JOINTS"), count_of_sets(names, "WEIGHTS")
    return _INFLUENCES_PER_SET * joints if joints is not None and joints == weights else 0
