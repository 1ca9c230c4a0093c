"""Methods `landmarks` and `landmarks-sub`: mirrors of many cells in a few boxes (Fourneau et al. 2024, §3.2).

The colour is a sum of differences of tabulated cumulative integrals (Eq. 15), s and p averaged.
`landmarks-sub` cuts each box of the band above the mode m into max(1, s − m).

Beyond the paper: a host other than n1 is coupled without interference, polarisation by polarisation, which
is the mean over the phase between the host's interface and the mirror; total reflection inside a cell, where
no modes are defined, reflects everything; where more than MODES_MAX gaps are visible, each k-th band stands
for the k from it on.
"""

from __future__ import annotations

from typing import Final, cast

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.colour.cumulative import CUMULATIVE_STEPS, cumulative_colour, cumulative_steps
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.landmark_boxes import lanes_of, lossless_cells, spectral_boxes
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.landmarks import ROOT_FINDERS, RootFinder, newton_steps
from gltf_iri.planning.method import ParameterValue

__all__ = ["cumulative_table", "evaluate_landmarks", "evaluate_landmarks_sub"]

Float64 = NDArray[np.float64]

_LANES_AT_ONCE: Final = 2048  # keeps temporaries inside a core's cache


def evaluate_landmarks(
    mirror: Mirror, white: White, *, root_finder: str = ROOT_FINDERS[0], backend: Backend = "numpy"
) -> Evaluation:
    """Return the colour from one box between two landmarks; raises UsageError for cells that absorb."""
    rgb = _colours(mirror, white, 1, cast(RootFinder, root_finder), backend)
    return Evaluation(rgb, "landmarks", str(white), undefined=_undefined(mirror))


def evaluate_landmarks_sub(
    mirror: Mirror,
    white: White,
    *,
    subdivisions: int = 3,
    root_finder: str = ROOT_FINDERS[0],
    backend: Backend = "numpy",
) -> Evaluation:
    """Return the colour from boxes cut into max(1, `subdivisions` − m); errors as `evaluate_landmarks`."""
    rgb = _colours(mirror, white, subdivisions, cast(RootFinder, root_finder), backend)
    return Evaluation(rgb, "landmarks-sub", str(white), undefined=_undefined(mirror))


def cumulative_table(white: White, **parameters: ParameterValue) -> NDArray[np.float32]:
    """Return (1, CUMULATIVE_STEPS + 1, 4) for the GLSL twins: C̄ in the first three channels.

    The fourth holds the method's parameters: the subdivisions (1 where it has none), then the number of
    Newton steps (0 for ten halvings).
    """
    table = np.zeros((1, CUMULATIVE_STEPS + 1, 4), dtype=np.float32)
    table[0, :, :3] = cumulative_steps(white)
    table[0, 0, 3] = parameters.get("subdivisions", 1)
    table[0, 1, 3] = newton_steps(cast(RootFinder, parameters.get("root_finder", ROOT_FINDERS[0])))
    return table


def _colours(
    mirror: Mirror, white: White, subdivisions: int, root_finder: RootFinder, backend: Backend
) -> Float64:
    if backend == "numba":
        return _compiled_colours(mirror, white, subdivisions, newton_steps(root_finder))
    lanes = lanes_of(mirror)
    count = len(lanes.path_nm)
    transmitted = np.zeros((count, 3))
    for start in range(0, count, _LANES_AT_ONCE):
        boxes = spectral_boxes(lanes.part(start, start + _LANES_AT_ONCE), subdivisions, root_finder)
        lane = start + boxes.lane
        ends = (boxes.stretched(t) / (2.0 * lanes.path_nm[lane]) for t in (boxes.low, boxes.high))
        low, high = (cumulative_colour(per_nm, white) for per_nm in ends)
        np.add.at(transmitted, lane, boxes.transmittance[:, None] * (high - low))
    rgb = 1.0 - 0.5 * (transmitted[: count // 2] + transmitted[count // 2 :])
    return np.asarray(rgb.reshape(*mirror.shape, 3))


def _undefined(mirror: Mirror) -> dict[str, NDArray[np.bool_]]:
    """Return where light runs in n1 and fades in n2: such a cell has no modes, and is taken to be white."""
    tangential = mirror.host_ior * np.sqrt((1.0 - mirror.cos_theta_h) * (1.0 + mirror.cos_theta_h))
    fades = (tangential > mirror.n2.real) & (tangential <= mirror.n1.real)
    mask = np.broadcast_to(fades, mirror.shape)
    return (
        {"total reflection inside a cell has no landmarks and is taken to be white": mask}
        if mask.any()
        else {}
    )


def _compiled_colours(mirror: Mirror, white: White, subdivisions: int, steps: int) -> Float64:
    from gltf_iri.compiled.landmarks import landmark_colours

    rgb = np.zeros((int(np.prod(mirror.shape, dtype=np.intp)), 3))
    for part, cells in lossless_cells(mirror):
        landmark_colours(cells, subdivisions, steps, cumulative_steps(white), rgb[part])
    return rgb.reshape(*mirror.shape, 3)
