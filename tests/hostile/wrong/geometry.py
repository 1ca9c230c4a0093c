"""Vertices, indices, morph targets and skins that contradict themselves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from wrong.sound import DROP, PRIMITIVE, VIEW, Edits, values

MORPH: Final = {f"{PRIMITIVE}/targets": [{"POSITION": 0}], "/meshes/0/weights": [0.5]}


def matrix(*entries: float) -> Edits:
    return {"/nodes/0/matrix": entries}


EDITED: Final[Mapping[str, Edits]] = {
    # Numbers.
    "number-1e39": {"/nodes/0/translation": [0, 1e39, 0]},
    "positions-nan": values(positions=[[np.nan, 0, 0], [1, 0, 0], [0, 1, 0]]),
    "positions-infinite": values(positions=[[0, 0, 0], [1, 0, 0], [0, np.inf, 0]]),
    "positions-3e38": {
        **values(positions=[[-3e38, 0, 0], [3e38, 0, 0], [0, 3e38, 0]]),
        "/nodes/0/scale": [3e38] * 3,
    },
    "scales-multiplied-beyond-doubles": {
        "/nodes": [{"scale": [1e38] * 3, "children": [i + 1]} for i in range(9)] + [{"mesh": 0}]
    },
    "normals-zero": {f"{PRIMITIVE}/attributes/NORMAL": VIEW["normals"], **values(normals=[[0, 0, 0]] * 3)},
    "uvs-3e38": values(uvs=[[3e38, -3e38]] * 3),
    # Geometry.
    "triangles-without-area": values(positions=[[0, 0, 0]] * 3),
    "triangle-of-one-vertex": values(indices=[[1], [1], [1]]),
    "index-beyond-vertices": values(indices=[[0], [1], [3]]),
    "index-restart": values(indices=[[0], [1], [65535]]),
    "indices-float": {f"{PRIMITIVE}/indices": 0},
    "indices-incomplete": {"/accessors/2/count": 2},
    "attributes-of-different-counts": {"/accessors/1/count": 2},
    "position-of-two-components": {"/accessors/0/type": "VEC2"},
    "position-missing": {f"{PRIMITIVE}/attributes/POSITION": DROP},
    "attributes-empty": {f"{PRIMITIVE}/attributes": {}},
    "primitives-empty": {"/meshes/0/primitives": []},
    "mode-unknown": {f"{PRIMITIVE}/mode": 7},
    "mode-lines": {f"{PRIMITIVE}/mode": 1},
    "morph-matrix": {
        **MORPH,
        "/accessors/3": {"componentType": 5126, "count": 3, "type": "MAT3"},
        f"{PRIMITIVE}/targets/0/POSITION": 3,
    },
    "morph-weights-missing-one": {**MORPH, "/meshes/0/weights": [0.5, 0.5]},
    "morph-beyond-single-precision": {
        **MORPH,
        **values(positions=[[3e38, 0, 0], [0, 0, 0], [0, 1, 0]]),
        "/meshes/0/weights": [3e38],
    },
}
