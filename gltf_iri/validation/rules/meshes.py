"""Meshes: names of attributes, and what the primitives of a mesh have in common."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import ATTRIBUTE_FORMATS, SEMANTICS_WITH_SETS, TARGET_FORMATS
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.attributes import attribute_names, count_of_sets, is_attribute
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def _morph_targets(mesh: Entry, asset: Asset) -> Iterator[Issue]:
    primitives = mesh.get("primitives")
    if not primitives:
        return
    count = len(primitives[0].get("targets", ()))
    for primitive in primitives:
        if len(primitive.get("targets", ())) != count:
            pointer = primitive.at("targets") if "targets" in primitive else primitive.pointer
            yield issue("MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", pointer)
    weights = mesh.get("weights")
    if weights is not None and len(weights) != count:
        yield issue("MESH_INVALID_WEIGHTS_COUNT", mesh.at("weights"), count=len(weights), targets=count)


def _names(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    names = attribute_names(primitive)
    if not names:
        return
    pointer = primitive.at("attributes")
    for name in names:
        if not is_attribute(name, ATTRIBUTE_FORMATS):
            yield issue("MESH_PRIMITIVE_INVALID_ATTRIBUTE", primitive.at("attributes", name))
    sets = {semantic: count_of_sets(names, semantic) for semantic in sorted(SEMANTICS_WITH_SETS)}
    for semantic, count in sets.items():
        if count is None:
            yield issue("MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", pointer, semantic=semantic)
    joints, weights = sets["JOINTS"] or 0, sets["WEIGHTS"] or 0
    if joints != weights:
        yield issue("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", pointer, joints=joints, weights=weights)
    if "POSITION" not in names:
        yield issue("MESH_PRIMITIVE_NO_POSITION", pointer)
    if "TANGENT" in names and "NORMAL" not in names:
        yield issue("MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL", primitive.at("attributes", "TANGENT"))


def _target_names(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    targets = primitive.raw.get("targets")
    for position, target in enumerate(targets if isinstance(targets, list) else ()):
        for name in target if isinstance(target, dict) else ():
            if not is_attribute(name, TARGET_FORMATS):
                pointer = primitive.at("targets", position, name)
                yield issue("MESH_PRIMITIVE_INVALID_ATTRIBUTE", pointer)


RULES: Rules = {"mesh": (_morph_targets,), "mesh.primitive": (_names, _target_names)}
