"""The stacks on which methods for layers are judged; seeds and ranges are fixed, so that numbers compare."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose

__all__ = ["layer_set", "named_stacks"]

_SEED: Final = 7
_SMOOTH: Final = 0.15  # share of layers that are
_IN_AIR: Final = 0.6


def layer_set(count: int, layers: int, most_cells: int = 30) -> tuple[LayerStack, Pose]:
    """Return `count` stacks (count,) on white, each seen once; fewer of them begin more.

    Six of ten lie in air, the others in an index of 1.2–1.7. Uniform for each layer: n2/n1 in 1.03–1.25 or as
    often, 1.25–2; Λ√n1 150–1000 nm; d1/Λ 0.1–0.9; 2–`most_cells` cells; log α in 0.01–0.4, or (15 %) smooth.
    Cosines of light and viewer in [0, 1], the turn between them in [0, 2π].
    """
    drawn = [_one(np.random.default_rng((_SEED, number)), layers, most_cells) for number in range(count)]
    host = np.array([each[0] for each in drawn])
    columns: NDArray[np.float64] = np.array([each[1] for each in drawn])  # (count, layers, 5)
    seen = np.array([each[2] for each in drawn])
    stack = tuple(
        BraggLayer.of(
            host,
            host * columns[:, number, 0],
            columns[:, number, 1] * columns[:, number, 2] / np.sqrt(host),
            columns[:, number, 1] * (1.0 - columns[:, number, 2]) / np.sqrt(host),
            columns[:, number, 3],
            columns[:, number, 4],
        )
        for number in range(layers)
    )
    return LayerStack.of(stack, host, LayerBase.of(1.0)), Pose.of(*seen.T)


def _one(
    g: np.random.Generator, layers: int, most_cells: int
) -> tuple[float, list[tuple[float, ...]], tuple[float, float, float]]:
    """Return a host's index, each layer's n2/n1, Λ√n1, fill, cells and α, and the pose."""
    host = 1.0 if g.random() < _IN_AIR else g.uniform(1.2, 1.7)
    seen = g.random(), g.random(), float(np.cos(g.uniform(0.0, 2.0 * np.pi)))
    found: list[tuple[float, ...]] = []
    for _ in range(layers):
        contrast = g.uniform(1.03, 1.25) if g.random() < 0.5 else g.uniform(1.25, 2.0)
        cell = g.uniform(150.0, 1000.0), g.uniform(0.1, 0.9), float(g.integers(2, most_cells + 1))
        alpha = 0.0 if g.random() < _SMOOTH else float(10.0 ** g.uniform(-2.0, np.log10(0.4)))
        found.append((contrast, *cell, alpha))
    return host, found, seen


def named_stacks() -> dict[str, LayerStack]:
    """Return single stacks on white: those of Fourneau et al. 2024, Fig. 7, and an insect's cuticle on it.

    A is 10 cells of 250 + 250 nm, B of 494 + 494, in air with n2 = 1.5; A′ lies in 1.35. The cuticle is the
    green area of Table 3, in air.
    """

    def cells_of(d_nm: float, alpha: float, n1: float = 1.0) -> BraggLayer:
        return BraggLayer.of(n1, 1.5, d_nm, d_nm, 10, alpha)

    a, b, coated = cells_of(250.0, 0.1), cells_of(494.0, 0.05), cells_of(250.0, 0.1, 1.35)
    cuticle = BraggLayer.of(1.59, 1.67, 0.51 * 160.0, 0.49 * 160.0, 8, 0.05)
    white = LayerBase.of(1.0)
    return {
        "A": LayerStack.of((a,), 1.0, white),
        "B": LayerStack.of((b,), 1.0, white),
        "A over B": LayerStack.of((a, b), 1.0, white),
        "B over A": LayerStack.of((b, a), 1.0, white),
        "A over A": LayerStack.of((a, a), 1.0, white),
        "A′": LayerStack.of((coated,), 1.35, white),
        "cuticle": LayerStack.of((cuticle,), 1.0, white),
        "A over cuticle": LayerStack.of((a, cuticle), 1.0, white),
    }
