"""The names of a primitive's attributes: which there are, and how sets are counted (§3.7.2.1)."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from gltf_iri.asset.formats import SEMANTICS_WITH_SETS
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.entry import Entry

__all__ = ["attribute_names", "count_of_sets", "is_attribute", "semantic_of", "targets_of"]


def semantic_of(name: str) -> str:
    """Return an attribute's name without its set: "TEXCOORD"; "" for an application's own."""
    return name.partition("_")[0]


def is_attribute(name: str, semantics: Collection[str]) -> bool:
    """Whether `name` is one of `semantics`, with a set's number where it must have one, or an own name."""
    semantic, underscore, number = name.partition("_")
    if not semantic and underscore:
        return True
    if semantic not in semantics:
        return False
    return _is_number(number) if semantic in SEMANTICS_WITH_SETS else not underscore


def count_of_sets(names: Collection[str], semantic: str) -> int | None:
    """Return how many sets of `semantic` there are, or None where they do not count from 0 without a gap."""
    start = f"{semantic}_"
    count = sum(name.startswith(start) and _is_number(name[len(start) :]) for name in names)
    return count if all(f"{start}{number}" in names for number in range(count)) else None


def attribute_names(primitive: Entry) -> Mapping[str, object]:
    """Return the attributes as the file names them, those that refer to nothing too."""
    return primitive.raw["attributes"] if "attributes" in primitive else {}


def targets_of(node: Entry, asset: Asset) -> list[dict[str, int]]:
    """Return the morph targets of a node's mesh: those of its first primitive, for all have as many."""
    mesh = asset.get("meshes", node.get("mesh"))
    primitives = mesh.get("primitives") if mesh is not None else None
    targets: list[dict[str, int]] = primitives[0].get("targets", []) if primitives else []
    return targets


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdigit() and (text == "0" or text[0] != "0")
