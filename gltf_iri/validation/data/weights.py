"""Joints and weights of skinned vertices."""

from __future__ import annotations

from array import array
from itertools import combinations, compress
from operator import add, eq, mul, not_
from typing import TYPE_CHECKING, Any

from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, tell_unread
from gltf_iri.validation.data.indices import count_of_vertices
from gltf_iri.validation.data.normalised import columns_of
from gltf_iri.validation.data.vertices import attribute_elements
from gltf_iri.validation.rules.attributes import attribute_names, count_of_sets

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.data.elements import Elements
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["weights_of_joints_add_up"]

# glTF 2.0, §3.7.3.3: the sum of a vertex' weights may be off by so much for each of them that is not 0.
_SUM_ERROR_PER_WEIGHT = 2e-7

# Numbers of one block of vertices are held at once: of these sets, some 50 MB. Real models have one or two.
_MOST_SETS = 16

# From so many joints on, comparing each with each takes longer than gathering those of every vertex.
_MANY_JOINTS = 16

_Column = list[Any]


def weights_of_joints_add_up(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of joints that the skin does not have, of joints without weight, and of weights off 1 together."""
    skin = _skins(asset).get(primitive.parent)
    names = attribute_names(primitive)
    sets = count_of_sets(names, "JOINTS")
    if skin is None or not sets or count_of_sets(names, "WEIGHTS") != sets:
        return
    if sets > _MOST_SETS:
        tell_unread(asset, primitive.at("attributes"), f"{_MOST_SETS} sets of joints are the most")
        return
    joints = [attribute_elements(primitive, f"JOINTS_{number}", asset) for number in range(sets)]
    weights = [attribute_elements(primitive, f"WEIGHTS_{number}", asset) for number in range(sets)]
    parts = [part for part in (*joints, *weights) if part is not None]
    if len(parts) < 2 * sets or {part.count for part in parts} != {count_of_vertices(primitive, asset)}:
        return
    name = ("weights", (*parts, skin[0]))
    if name in asset.resources.found:
        return
    is_clean = True
    for part in parts[1:]:
        blocks(part, asset, primitive.pointer)
    for first in blocks(parts[0], asset, primitive.pointer):
        vertices = _Vertices(parts[:sets], parts[sets:], first)
        if not vertices.are_sound(skin[0]):
            for remark in vertices.faults(primitive, *skin):
                is_clean = False
                yield remark
    if is_clean:
        asset.resources.found[name] = True


def _skins(asset: Asset) -> dict[Entry | None, tuple[int, int]]:
    """Return of each mesh how many joints the smallest skin has that a node gives it, and which that is."""
    found = asset.resources.found
    if ("skins", None) not in found:
        smallest: dict[Entry | None, tuple[int, int]] = {}
        for node in asset.array("nodes"):
            mesh = asset.get("meshes", node.get("mesh")) if node is not None else None
            skin = asset.get("skins", node.get("skin")) if node is not None else None
            if node is not None and mesh is not None and skin is not None and "joints" in skin:
                candidate = (len(skin["joints"]), node["skin"])
                smallest[mesh] = min(smallest.get(mesh, candidate), candidate)
        found["skins", None] = smallest
    skins: dict[Entry | None, tuple[int, int]] = found["skins", None]
    return skins


class _Vertices:
    """A block of vertices: a column for each joint, and one for its weight."""

    __slots__ = ("first", "joints", "weights")

    def __init__(self, joints: list[Elements], weights: list[Elements], first: int) -> None:
        self.first = first
        # All sets' first components, then their second ones: the order in which they are looked at.
        self.joints: list[_Column] = _interleaved([part.columns(first) for part in joints])
        self.weights: list[_Column] = _interleaved([columns_of(part, first) for part in weights])

    def are_sound(self, joint_count: int) -> bool:
        """Whether nothing is wrong with any vertex of the block."""
        pairs = list(zip(self.joints, self.weights, strict=True))
        return (
            len(pairs) < _MANY_JOINTS
            and all(max(column) < joint_count for column in self.joints)
            and all(min(column) >= 0.0 for column in self.weights)
            and not any(any(compress(joints, map(not_, weights))) for joints, weights in pairs)
            and not any(
                any(compress(map(mul, weights, others), map(eq, joints, those)))
                for (joints, weights), (those, others) in combinations(pairs, 2)
            )
            and self._add_up()
        )

    def _add_up(self) -> bool:
        # Sums are rounded to float32 after each weight, as those of the Khronos validator are.
        sums = array("f", self.weights[0])
        for column in self.weights[1:]:
            sums = array("f", map(add, sums, column))
        error = _SUM_ERROR_PER_WEIGHT
        if min(sums) >= 1.0 - error and max(sums) <= 1.0 + error:
            return True
        return all(
            abs(total - 1.0) <= error or abs(total - 1.0) <= error * self._count(vertex)
            for vertex, total in enumerate(sums)
        )

    def _count(self, vertex: int) -> int:
        return sum(column[vertex] != 0.0 for column in self.weights)

    def faults(self, primitive: Entry, joint_count: int, skin: int) -> Iterator[Issue]:
        """Tell of each fault."""
        for offset, (joints, weights) in enumerate(
            zip(zip(*self.joints, strict=True), zip(*self.weights, strict=True), strict=True)
        ):
            yield from _faults(primitive, self.first + offset, joints, weights, joint_count, skin)


def _interleaved(sets: list[list[_Column]]) -> list[_Column]:
    return [column for columns in zip(*sets, strict=True) for column in columns]


def _faults(
    primitive: Entry,
    vertex: int,
    joints: tuple[int, ...],
    weights: tuple[float, ...],
    joint_count: int,
    skin: int,
) -> Iterator[Issue]:
    """Tell what is wrong with one vertex; what is told of a weight, or its joint, keeps it from the sum."""
    total, count, seen, sets = 0.0, 0, set(), len(joints) // 4
    for place, (joint, weight) in enumerate(zip(joints, weights, strict=True)):
        component, number = divmod(place, sets)
        at: dict[str, Any] = {"index": 4 * vertex + component, "component": component, "value": joint}
        pointer = primitive.at("attributes", f"JOINTS_{number}")
        if joint >= joint_count:
            yield issue("ACCESSOR_JOINTS_INDEX_OOB", pointer, **at, last=joint_count - 1, skin=skin)
        elif weight == 0.0:
            if joint:
                yield issue("ACCESSOR_JOINTS_USED_ZERO_WEIGHT", pointer, **at)
        else:
            if joint in seen:
                yield issue("ACCESSOR_JOINTS_INDEX_DUPLICATE", pointer, **at)
            if weight < 0.0:
                at["value"] = weight
                yield issue(
                    "ACCESSOR_WEIGHTS_NEGATIVE", primitive.at("attributes", f"WEIGHTS_{number}"), **at
                )
            elif joint not in seen:
                total = array("f", (total + weight,))[0]
                count += 1
            seen.add(joint)
    if abs(total - 1.0) > _SUM_ERROR_PER_WEIGHT * count:
        for number in range(sets):
            pointer, first = primitive.at("attributes", f"WEIGHTS_{number}"), 4 * vertex
            yield issue("ACCESSOR_WEIGHTS_NON_NORMALIZED", pointer, first=first, last=first + 3, sum=total)
