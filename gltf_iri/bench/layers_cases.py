"""Random stacks of rough Bragg layers as float32 has them, on which GLSL and Python must agree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose
from gltf_iri.optics.layer_stack import Sight, sight_of

__all__ = ["Case", "random_case"]

Float64 = NDArray[np.float64]
Fields = TypeVar("Fields", BraggLayer, LayerBase, Pose)


@dataclass(frozen=True, slots=True)
class Case:
    """Stacks of a number of layers, and where they are seen from; arrays of rows, as float32 has them."""

    stack: LayerStack
    pose: Pose

    @property
    def sight(self) -> Sight:
        """What the layers see of light and viewer."""
        pose = self.pose
        return sight_of(self.stack.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)

    def rows(self, chosen: NDArray[np.intp]) -> Case:
        """Return the case of some rows."""
        stack, base, pose = self.stack, self.stack.base, self.pose
        return Case(
            LayerStack(
                tuple(_rows_of(layer, chosen) for layer in stack.layers),
                stack.host_ior[chosen],
                _rows_of(base, chosen),
            ),
            _rows_of(pose, chosen),
        )

    def steps(self) -> Iterator[Case]:
        """Yield the case with each thickness and each cosine up to four float32 steps off."""
        for ulp in (-4.0, -2.0, -1.0, 1.0, 2.0, 4.0):
            for number, layer in enumerate(self.stack.layers):
                for name in ("d1_nm", "d2_nm"):
                    given: dict[str, Any] = {name: _stepped(getattr(layer, name), ulp)}
                    moved = replace(layer, **given)
                    layers = (*self.stack.layers[:number], moved, *self.stack.layers[number + 1 :])
                    yield Case(replace(self.stack, layers=layers), self.pose)
            for name in ("cos_theta_i", "cos_theta_o"):
                cosine = np.minimum(_stepped(getattr(self.pose, name), ulp), 1.0)
                yield Case(self.stack, replace(self.pose, **{name: cosine}))

    def arguments(self) -> list[Float64]:
        """Return host, pose, base and layers as the probes of whole BRDFs take them."""
        base, pose = self.stack.base, self.pose
        return [
            self.stack.host_ior,
            _columns(pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi),
            base.diffuse,
            _columns(base.metal_share, base.metal_f0[..., 0], base.metal_alpha),
            *self._layers(),
        ]

    def colour_arguments(self) -> list[Float64]:
        """Return host, cosines of h, i and o there, and layers, as the probes of colours take them."""
        sight = self.sight
        return [self.stack.host_ior, _columns(sight.cos_h, sight.cos_i, sight.cos_o), *self._layers()]

    def _layers(self) -> list[Float64]:
        given = []
        for layer in self.stack.layers:
            given.append(_columns(layer.n1, layer.n2, layer.alpha))
            given.append(_columns(layer.d1_nm, layer.d2_nm, layer.cells))
        return given


def random_case(rows: int, layers: int, seed: int, *, cells_max: int, bends: bool = False) -> Case:
    """n2 1.3–2.2, periods 100–1000 nm, fills 0.2–0.8, α 0.01–0.6, cosines 0.05–1; half of all rows in air.

    The others lie in a host of 1 to 1.7, and every fourth row is seen close to the mirror direction. n1 is
    the host's index, but the last layer's is 1 to 1.7 where it `bends`. Bases are coloured, and metals of α
    0.01–0.6 by half of them, where nothing bends.
    """
    g = np.random.default_rng(seed)
    host = _rounded(np.where(g.random(rows) < 0.5, 1.0, g.uniform(1.0, 1.7, rows)))
    made = []
    for number in range(layers):
        period_nm, fill = g.uniform(100.0, 1000.0, rows), g.uniform(0.2, 0.8, rows)
        given = (g.uniform(1.3, 2.2, rows), fill * period_nm, (1.0 - fill) * period_nm)
        n2, d1_nm, d2_nm = (_rounded(a) for a in given)
        cells, alpha = g.integers(1, cells_max + 1, rows), g.uniform(0.01, 0.6, rows)
        n1 = _rounded(g.uniform(1.0, 1.7, rows)) if bends and number == layers - 1 else host
        made.append(BraggLayer.of(n1, n2, d1_nm, d2_nm, cells, _rounded(alpha)))
    metal = np.where(g.random(rows) < (1.0 if bends else 0.5), 0.0, g.random(rows))
    base = LayerBase.of(
        diffuse=_rounded(g.random((rows, 3))),
        metal_f0=np.repeat(_rounded(g.random(rows))[:, None], 3, axis=1),
        metal_share=_rounded(metal),
        metal_alpha=_rounded(g.uniform(0.01, 0.6, rows)),
    )
    i, o, phi = g.uniform(0.05, 1.0, rows), g.uniform(0.05, 1.0, rows), g.uniform(-1.0, 1.0, rows)
    near = np.arange(rows) % 4 == 0
    o = np.where(near, np.clip(i + 0.05 * g.normal(size=rows), 0.05, 1.0), o)
    phi = np.where(near, -1.0 + g.random(rows) ** 4, phi)
    return Case(LayerStack.of(tuple(made), host, base), Pose.of(_rounded(i), _rounded(o), _rounded(phi)))


def _rows_of(given: Fields, chosen: NDArray[np.intp]) -> Fields:
    return type(given)(*(getattr(given, field.name)[chosen] for field in fields(given)))


def _rounded(values: ArrayLike) -> Float64:
    """Return `values` as float32 sees them, in float64."""
    return np.asarray(values, dtype=np.float32).astype(np.float64)


def _stepped(values: Float64, ulp: float) -> Float64:
    return values * (1.0 + ulp * float(np.finfo(np.float32).eps))


def _columns(*columns: Float64 | NDArray[np.int64]) -> Float64:
    return np.stack(np.broadcast_arrays(*columns), axis=-1).astype(np.float64)
