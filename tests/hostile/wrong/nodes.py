"""Node graphs, transforms, skins, scenes, cameras and lights that contradict themselves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from wrong.sound import DROP, PRIMITIVE, VIEW, WHOLE, Edits, values

SKIN: Final = {
    WHOLE: True,
    "/nodes/0/skin": 0,
    "/nodes/1": {},
    "/skins": [{"joints": [1], "inverseBindMatrices": VIEW["inverse_binds"]}],
    f"{PRIMITIVE}/attributes/JOINTS_0": VIEW["joints"],
    f"{PRIMITIVE}/attributes/WEIGHTS_0": VIEW["weights"],
}


LIGHT: Final = {
    "/extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
    "/nodes/0/extensions": {"KHR_lights_punctual": {"light": 0}},
}


CAMERA: Final = {
    "/cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
    "/nodes/0/camera": 0,
}


def matrix(*entries: float) -> Edits:
    return {"/nodes/0/matrix": entries}


def attribute(name: str, accessor: int) -> Edits:
    return {f"{PRIMITIVE}/attributes/{name}": accessor}


EDITED: Final[Mapping[str, Edits]] = {
    "nodes-cycle": {"/nodes": [{"mesh": 0, "children": [1]}, {"children": [0]}]},
    "nodes-own-child": {"/nodes/0/children": [0]},
    "nodes-cycle-apart": {"/nodes/1": {"children": [2]}, "/nodes/2": {"children": [1]}},
    "nodes-two-parents": {
        "/nodes": [{"children": [2]}, {"children": [2]}, {"mesh": 0}],
        "/scenes/0/nodes": [0, 1],
    },
    "nodes-child-twice": {"/nodes": [{"children": [1, 1]}, {"mesh": 0}]},
    "matrix-singular": matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1),
    "matrix-zero": matrix(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1),
    "matrix-projects": matrix(1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
    "matrix-of-15": matrix(*[0] * 15),
    "matrix-beside-scale": {
        **matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
        "/nodes/0/scale": [1, 1, 1],
    },
    "scale-zero": {"/nodes/0/scale": [0, 0, 0]},
    "scale-1e-40": {"/nodes/0/scale": [1e-40] * 3},
    "rotation-zero": {"/nodes/0/rotation": [0, 0, 0, 0]},
    "rotation-text": {"/nodes/0/rotation": ["0", 0, 0, 1]},
    "skin-sound": SKIN,
    "skin-own-joint": {**SKIN, "/skins/0/joints": [0], "/skins/0/skeleton": 0},
    "skin-dangling": {**SKIN, "/nodes/0/skin": 1},
    "skin-joints-missing": {**SKIN, "/skins/0/joints": DROP},
    "skin-joints-empty": {**SKIN, "/skins/0/joints": []},
    "skin-joint-dangling": {**SKIN, "/skins/0/joints": [9]},
    "skin-too-few-matrices": {**SKIN, "/skins/0/joints": [0, 1]},
    "skin-matrices-nan": {**SKIN, **values(inverse_binds=[[np.nan] * 16])},
    "skin-matrices-mat2": {**SKIN, f"/accessors/{VIEW['inverse_binds']}/type": "MAT2"},
    "skin-matrices-vectors": {**SKIN, "/skins/0/inverseBindMatrices": 0},
    "skin-joint-index-beyond": {**SKIN, **values(joints=[[0, 0, 0, 0], [7, 0, 0, 0], [0, 0, 0, 0]])},
    "skin-joint-index-negative": {
        **SKIN,
        f"/accessors/{VIEW['joints']}/componentType": 5120,
        **values(joints=[[255] * 4] * 3),
    },
    "skin-joint-index-float": {
        **SKIN,
        **attribute("JOINTS_0", VIEW["weights"]),
        **values(weights=[[3e38, 1, 1, 1]] * 3),
    },
    "skin-weights-negative": {**SKIN, **values(weights=[[2, -1, 0, 0]] * 3)},
    "skin-weights-missing": {**SKIN, f"{PRIMITIVE}/attributes/WEIGHTS_0": DROP},
    "scene-empty": {"/scenes/0/nodes": DROP},
    "scene-without-nodes": {"/scenes/0/nodes": []},
    "scene-beyond": {"/scene": 1},
    "scene-default-missing": {"/scene": DROP, "/scenes/1": {}},
    "scenes-missing": {"/scene": DROP, "/scenes": DROP},
    "scene-lists-a-child": {"/nodes": [{"children": [1]}, {"mesh": 0}], "/scenes/0/nodes": [0, 1]},
    "scene-of-points": {f"{PRIMITIVE}/mode": 0},
    "nodes-missing": {"/nodes": DROP, "/scenes": DROP, "/scene": DROP},
    "camera-of-no-view": {**CAMERA, "/cameras/0/perspective/yfov": 4},
    "camera-type-missing": {**CAMERA, "/cameras/0/perspective": DROP},
    "camera-scaled-to-0": {**CAMERA, "/nodes/0/scale": [0, 0, 0]},
    "light-dangling": {**LIGHT, "/nodes/0/extensions/KHR_lights_punctual/light": 1},
    "light-without-type": {**LIGHT, "/extensions/KHR_lights_punctual/lights/0": {}},
    "lights-text": {**LIGHT, "/extensions/KHR_lights_punctual/lights": "all"},
    "light-too-strong": {**LIGHT, "/extensions/KHR_lights_punctual/lights/0/intensity": 3e38},
}
