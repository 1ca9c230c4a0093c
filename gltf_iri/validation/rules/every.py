"""Gathers all rules, in the order in which they speak."""

from __future__ import annotations

from gltf_iri.validation.bragg import declared as bragg
from gltf_iri.validation.iridescence import declared as iridescence
from gltf_iri.validation.pointers import rules as pointers
from gltf_iri.validation.pointers import value_rules as pointer_values
from gltf_iri.validation.rules import (
    accessors,
    animation_pointer,
    animations,
    asset_version,
    buffer_views,
    cameras,
    claims,
    elements,
    extension_lists,
    inverse_bind_matrices,
    lights,
    materials,
    meshes,
    nodes,
    primitives,
    skinned_meshes,
    skins,
    surfaces,
    textures,
    transforms,
    uris,
    variants,
)
from gltf_iri.validation.rules.registry import add_data_rules, add_rules

__all__: list[str] = []

_MODULES = (
    asset_version,
    extension_lists,
    uris,
    buffer_views,
    accessors,
    claims,
    inverse_bind_matrices,
    animations,
    cameras,
    meshes,
    primitives,
    surfaces,
    transforms,
    nodes,
    skinned_meshes,
    skins,
    textures,
    materials,
    lights,
    variants,
    animation_pointer,
    pointers,
    pointer_values,
    iridescence,
    bragg,
    elements,
)


for _module in _MODULES:
    add_rules(_module.RULES)
    add_data_rules(getattr(_module, "DATA_RULES", {}))
