"""Morph targets at their default weights (glTF 2.0 §3.7.2.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["apply_morph_targets", "default_weights"]

Attributes = dict[str, NDArray[np.float32]]


def default_weights(mesh: Mapping[str, Any], node: Mapping[str, Any]) -> tuple[float, ...]:
    """Return the weights in force: the node's where it states them, else the mesh's, else none."""
    return tuple(float(w) for w in node.get("weights", mesh.get("weights", ())))


def apply_morph_targets(
    document: Document,
    attributes: Attributes,
    targets: Sequence[Mapping[str, int]],
    weights: Sequence[float],
    pointer: str,
) -> Attributes:
    """Return the attributes with each target's displacement added; a = a₀ + Σ wᵢ Δaᵢ.

    A tangent's handedness does not move; colours are clamped to [0, 1], as the text wants.
    Raises AssetError where the numbers of targets and weights, or of vertices, differ.
    """
    if not weights or not targets:
        return attributes
    if len(weights) != len(targets):
        raise AssetError(
            f"there are {len(targets)} morph targets and {len(weights)} weights", pointer=f"{pointer}/targets"
        )
    moved = {name: values.copy() for name, values in attributes.items()}
    for place, (target, weight) in enumerate(zip(targets, weights, strict=True)):
        if weight == 0.0:
            continue
        for name, accessor in target.items():
            if name not in moved:
                continue  # a displacement of something that is not there moves nothing
            where = f"{pointer}/targets/{place}/{name}"
            delta = document.accessor(accessor).astype(np.float32)
            width = delta.shape[1]
            if delta.ndim != 2 or len(delta) != len(moved[name]) or width > moved[name].shape[1]:
                raise AssetError(
                    f"the displacements have shape {delta.shape}, the attribute {moved[name].shape}",
                    pointer=where,
                )
            moved[name][:, :width] += np.float32(weight) * delta
    for name in moved:
        if name.startswith("COLOR_"):
            moved[name] = np.clip(moved[name], 0.0, 1.0)
    return moved
