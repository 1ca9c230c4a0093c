"""Indices that point nowhere, values of the wrong type, extensions that must not be passed over."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from wrong.sound import DROP, FILM, PRIMITIVE, Edits


def attribute(name: str, accessor: int) -> Edits:
    return {f"{PRIMITIVE}/attributes/{name}": accessor}


EDITED: Final[Mapping[str, Edits]] = {
    "mesh-dangling": {"/nodes/0/mesh": 1},
    "material-dangling": {f"{PRIMITIVE}/material": 1},
    "accessor-dangling": attribute("POSITION", 99),
    "accessor-negative": attribute("POSITION", -1),
    "view-dangling": {"/accessors/0/bufferView": 99},
    "buffer-dangling": {"/bufferViews/0/buffer": 1},
    "texture-dangling": {"/materials/0/pbrMetallicRoughness/baseColorTexture/index": 1},
    "image-dangling": {"/textures/0/source": 1},
    "sampler-dangling": {"/textures/0/sampler": 1},
    "sampler-filter-unknown": {"/samplers": [{"minFilter": 1}]},
    "texture-without-source": {"/textures/0/source": DROP},
    "asset-missing": {"/asset": DROP},
    "version-1": {"/asset/version": "1.0"},
    "version-number": {"/asset/version": 2.0},
    "nodes-object": {"/nodes": {"0": {"mesh": 0}}},
    "node-null": {"/nodes/0": None},
    "materials-text": {"/materials": "gold"},
    "extensions-array": {"/materials/0/extensions": []},
    "extension-null": {FILM: None},
    "component-type-double": {"/accessors/0/componentType": 5130},
    "type-unknown": {"/accessors/0/type": "VEC5"},
    "required-unknown": {"/extensionsRequired": ["ACME_warp"]},
    "required-draco": {"/extensionsRequired": ["KHR_draco_mesh_compression"]},
    "required-escape-sequence": {"/extensionsRequired": ["\x1b[31m\n" + "x" * 900]},
    "required-endless": {"/extensionsRequired": [f"ACME_{i}" for i in range(100)]},
}
