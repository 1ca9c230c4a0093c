"""Counts, offsets, strides and sparse parts that do not fit the bytes, or ask for a large machine."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from wrong.sound import DROP, PRIMITIVE, VIEW, WHOLE, Edits, values

VIEWLESS: Final = {"/accessors/0/bufferView": DROP}


SPARSE: Final = {
    WHOLE: True,
    "/accessors/0/sparse": {
        "count": 2,
        "indices": {"bufferView": VIEW["sparse_indices"], "componentType": 5123},
        "values": {"bufferView": VIEW["sparse_values"]},
    },
}


EDITED: Final[Mapping[str, Edits]] = {
    # How much is asked for.
    "count-1e10": {"/accessors/0/count": 1e10},
    "count-2-31": {"/accessors/0/count": 2**31},
    "count-2-53": {"/accessors/0/count": 2**53, "/bufferViews/0/byteLength": 2**53},
    "count-1e10-without-view": {**VIEWLESS, "/accessors/0/count": 1e10},
    "count-2-31-without-view": {**VIEWLESS, "/accessors/0/count": 2**31},
    "count-near-the-limit-without-view": {
        **VIEWLESS,
        "/accessors/0/count": 2**20 - 1,
        f"{PRIMITIVE}/indices": DROP,
        f"{PRIMITIVE}/attributes": {"POSITION": 0},
    },
    "count-0": {"/accessors/0/count": 0},
    "count-negative": {"/accessors/0/count": -1},
    "count-fraction": {"/accessors/0/count": 1.5},
    "count-text": {"/accessors/0/count": "3"},
    "count-true": {"/accessors/0/count": True},
    "offset-negative": {"/accessors/0/byteOffset": -12},
    "offset-2-53": {"/accessors/0/byteOffset": 2**53},
    "offset-misaligned": {"/bufferViews/1/byteOffset": 34},
    "stride-too-small": {"/bufferViews/0/byteStride": 8},
    "stride-negative": {"/bufferViews/0/byteStride": -12},
    "stride-too-large": {"/bufferViews/0/byteStride": 24},
    "view-beyond-buffer": {"/bufferViews/0/byteLength": 4096},
    "view-negative-offset": {"/bufferViews/0/byteOffset": -4},
    "buffer-longer-than-its-bytes": {"/buffers/0/byteLength": 2**31},
    "instances-without-end": {
        **VIEWLESS,
        "/accessors/0/count": 2**20,
        f"{PRIMITIVE}/indices": DROP,
        f"{PRIMITIVE}/attributes": {"POSITION": 0},
        "/nodes": [{"mesh": 0}] * 40,
        "/scenes/0/nodes": list(range(40)),
    },
    "morph-targets-without-end": {
        **VIEWLESS,
        "/accessors/0/count": 2**20,
        f"{PRIMITIVE}/indices": DROP,
        f"{PRIMITIVE}/attributes": {"POSITION": 0},
        f"{PRIMITIVE}/targets": [{"POSITION": 0}] * 40,
        "/meshes/0/weights": [1] * 40,
    },
    # Sparse accessors.
    "sparse-sound": SPARSE,
    "sparse-without-view": {**SPARSE, **VIEWLESS},
    "sparse-index-beyond": {**SPARSE, **values(sparse_indices=[[0], [3]])},
    "sparse-indices-repeated": {**SPARSE, **values(sparse_indices=[[2], [2]])},
    "sparse-indices-falling": {**SPARSE, **values(sparse_indices=[[2], [0]])},
    "sparse-count-1e10": {**SPARSE, "/accessors/0/sparse/count": 1e10},
    "sparse-count-above-count": {**SPARSE, "/accessors/0/sparse/count": 4},
    "sparse-indices-signed": {**SPARSE, "/accessors/0/sparse/indices/componentType": 5122},
    "sparse-values-beyond-view": {**SPARSE, "/accessors/0/sparse/values/byteOffset": 12},
    "sparse-values-nan": {**SPARSE, **values(sparse_values=[[0, 0, 0], [0, np.nan, 0]])},
}
