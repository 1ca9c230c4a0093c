"""The mirrors on which mirror methods are judged; seeds and ranges are fixed, so that numbers compare."""

from __future__ import annotations

from typing import Final

import numpy as np

from gltf_iri.evaluation.mirror import Mirror

__all__ = ["LOW_CONTRAST_CELLS", "MIRROR_CELLS", "low_contrast_set", "mirror_set"]

COUNT: Final = 300

MIRROR_CELLS: Final = (5, 10, 20, 50, 200)
LOW_CONTRAST_CELLS: Final = (8, 30)


def mirror_set(cells: int, count: int = COUNT) -> Mirror:
    """Return `count` mirrors of `cells` cells with n1 = 1 = host and n2 in [1.3, 2.2].

    Drawn one by one, afresh for each number of cells: Λ in [150, 1000] nm, d1/Λ in [0.1, 0.9], n2, and
    cos θ in [0.1, 1].
    """
    g = np.random.default_rng(1)
    rows = [
        (g.uniform(150.0, 1000.0), g.uniform(0.1, 0.9), g.uniform(1.3, 2.2), g.uniform(0.1, 1.0))
        for _ in range(count)
    ]
    period_nm, share, n2, cosine = np.array(rows).T
    return Mirror.of(cosine, 1.0, n2, share * period_nm, (1.0 - share) * period_nm, cells)


def low_contrast_set(cells: int, count: int = COUNT) -> Mirror:
    """Return `count` mirrors like those of an insect's cuticle: n1 = 1.59, n2 = 1.67, under air.

    The same draws as `mirror_set`, of which the index is not used.
    """
    drawn = mirror_set(cells, count)
    return Mirror.of(drawn.cos_theta_h, 1.59, 1.67, drawn.d1_nm, drawn.d2_nm, cells, 1.0)
