"""Skins in their default pose, applied on the CPU (glTF 2.0 §3.7.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["apply_skin", "is_mirroring", "joint_matrices"]

Float64 = NDArray[np.float64]
Attributes = Mapping[str, NDArray[np.float32]]

# Exporters that normalise in float32 leave weights of −1e-8 where they mean 0.
_WEIGHT_SLACK = 1e-6


def joint_matrices(document: Document, skin: int, worlds: Sequence[Float64]) -> Float64:
    """Return (joints, 4, 4): what takes a vertex of the bind pose to world space, J = W_joint · B⁻¹.

    The node that carries the mesh has no part in it (§3.7.3.3). Raises AssetError where there are fewer
    inverse bind matrices than joints.
    """
    description = document.json["skins"][skin]
    joints = description["joints"]
    placed = np.stack([worlds[joint] for joint in joints])
    if "inverseBindMatrices" not in description:
        return placed
    inverse_binds = document.accessor(description["inverseBindMatrices"]).astype(np.float64)
    if inverse_binds.shape[1:] != (4, 4) or len(inverse_binds) < len(joints):
        raise AssetError(
            f"the skin has {len(joints)} joints and needs as many 4×4 matrices",
            pointer=f"/skins/{skin}/inverseBindMatrices",
        )
    return np.asarray(placed @ inverse_binds[: len(joints)], dtype=np.float64)


def apply_skin(attributes: Attributes, joints: Float64, pointer: str) -> dict[str, NDArray[np.float32]]:
    """Return the attributes with POSITION, NORMAL and TANGENT moved to world space.

    Each vertex moves by M = Σ wᵢ Jᵢ, its normal by the cofactor matrix of M, which is det M · M⁻ᵀ and stays
    finite for a flattened joint. Mirroring joints flip normals with the sign of det M.
    Raises AssetError where a joint does not exist or a weight is negative.
    """
    blended = _blend(attributes, joints, pointer)
    linear = blended[:, :, :3]
    moved = dict(attributes)
    position = attributes["POSITION"].astype(np.float64)
    moved["POSITION"] = _float32(np.einsum("nij,nj->ni", linear, position) + blended[:, :, 3])
    if "NORMAL" in attributes:
        cofactor = np.cross(linear[:, :, [1, 2, 0]], linear[:, :, [2, 0, 1]], axis=1)
        sign = np.where(np.linalg.det(linear) < 0.0, -1.0, 1.0)
        normal = attributes["NORMAL"].astype(np.float64)
        moved["NORMAL"] = _float32(np.einsum("nij,nj->ni", cofactor, normal) * sign[:, None])
    if "TANGENT" in attributes:
        tangent = attributes["TANGENT"].astype(np.float64)
        moved["TANGENT"] = _float32(
            np.column_stack([np.einsum("nij,nj->ni", linear, tangent[:, :3]), tangent[:, 3]])
        )
    return moved


def is_mirroring(joints: Float64) -> bool:
    """True where most joints turn the winding of triangles around."""
    return bool(np.mean(np.linalg.det(joints[:, :3, :3]) < 0.0) > 0.5)


def _blend(attributes: Attributes, joints: Float64, pointer: str) -> Float64:
    """Return (n, 3, 4), Σ wᵢ Jᵢ with the weights brought to the sum 1."""
    sets = [s for s in range(2) if f"JOINTS_{s}" in attributes and f"WEIGHTS_{s}" in attributes]
    if not sets:
        raise AssetError("a skinned mesh needs JOINTS_0 and WEIGHTS_0", pointer=f"{pointer}/attributes")
    index = np.concatenate([attributes[f"JOINTS_{s}"] for s in sets], axis=1).astype(np.int64)
    weight = np.concatenate([attributes[f"WEIGHTS_{s}"] for s in sets], axis=1).astype(np.float64)
    if np.any((index >= len(joints)) & (weight != 0.0)):
        raise AssetError(
            f"a vertex names joint {int(index.max())}; the skin has {len(joints)}",
            pointer=f"{pointer}/attributes",
        )
    if np.any(weight < -_WEIGHT_SLACK):
        raise AssetError(
            f"a vertex has the joint weight {weight.min():g}; weights are 0 or more",
            pointer=f"{pointer}/attributes",
        )
    weight = np.maximum(weight, 0.0)
    index = np.where(weight != 0.0, index, 0)  # unused slots may hold anything
    total = weight.sum(axis=1)
    weight[total <= 0.0, 0] = 1.0  # a vertex without weights would collapse into the origin
    weight /= np.where(total > 0.0, total, 1.0)[:, None]
    blended = np.zeros((len(index), 3, 4))
    for slot in range(index.shape[1]):
        blended += weight[:, slot, None, None] * joints[index[:, slot], :3, :]
    return blended


def _float32(values: Float64) -> NDArray[np.float32]:
    return values.astype(np.float32)
