"""Defaults: legal where they stand, and together the same as no extension at all."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from gltf_iri.asset.words import join, shown
from gltf_iri.proposal.evaluation import Judge, TooCostlyError
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal, scope_of
from gltf_iri.proposal.objects import Kind, Property, extension_objects
from gltf_iri.proposal.schema_walk import subschemas

__all__ = ["empty_object", "legal_defaults", "needless_defaults", "no_effect"]

# Quantities that a material has without any extension, and that a factor of one leaves as they are: core
# glTF's own, and what multiplies a colour.
_ALREADY_THERE: Final = re.compile(
    r"specular|emissive|ior|tint|colou?r|roughness|normal|occlusion|alpha|metallic", re.IGNORECASE
)
_FACTOR: Final = re.compile(r"(Factor|Strength)$")


def legal_defaults(proposal: Proposal) -> Iterator[Finding]:
    """Each default is valid against the schema that states it, in that schema's own draft."""
    judge = Judge(proposal.schemas)
    for file in proposal.schemas.own.values():
        for place in subschemas(file.tree):
            if "default" not in place.schema:
                continue
            value = place.schema["default"]
            where = file.at(join(place.pointer, "default"))
            try:
                fault = judge.first_fault(file, place.pointer, place.schema, value)
            except TooCostlyError:
                yield Finding("check-too-costly", "validating the default takes too many steps", where)
                return
            if fault is not None:
                yield Finding(
                    "default-invalid", f"the default {shown(value)} is invalid: {fault.reason}", where
                )


def needless_defaults(proposal: Proposal) -> Iterator[Finding]:
    """Nothing has a default that can never be assumed."""
    for kind in extension_objects(proposal):
        for owner in kind.properties.values():
            if "default" in owner.schema and owner.is_required:
                told = f"{shown(owner.name)} is required and has a default all the same"
                yield Finding("default-of-required", told, owner.where)
            elif "default" in owner.schema and owner.kind is Kind.TEXTURE:
                told = f"{shown(owner.name)} refers to a texture and has a default all the same"
                yield Finding("default-of-texture", told, owner.where)


def empty_object(proposal: Proposal) -> Iterator[Finding]:
    """For a material, an empty extension object is valid."""
    judge = Judge(proposal.schemas)
    for entry in proposal.entries:
        if scope_of(entry, proposal.name) != "material":
            continue
        try:
            fault = judge.first_fault(entry, "", entry.tree, {})
        except TooCostlyError:
            yield Finding("check-too-costly", "validating {} takes too many steps", entry.where)
            return
        if fault is not None:
            yield Finding("empty-invalid", f"the empty object is invalid: {fault.reason}", entry.at(""))


def no_effect(proposal: Proposal) -> Iterator[Finding]:
    """With its defaults a material extension changes nothing.

    What the extension adds is scaled by the factor that is called like it (``iridescenceFactor``), and that
    is 0 by default. Where it scales what a material has anyway (``specularFactor``, ``emissiveStrength``) a
    default of 1 changes nothing either, and what replaces a model by its mere presence has no such factor.
    """
    feature = _camel(proposal.name)
    harmless = (0, 1) if _ALREADY_THERE.search(feature) else (0,)
    for kind in extension_objects(proposal):
        if kind.path or kind.scope not in ("material", "glTF") or not proposal.is_of_materials:
            continue
        factors = [owner for owner in kind.properties.values() if _FACTOR.search(owner.name)]
        for owner in factors:
            if "default" not in owner.schema and not owner.is_required:
                told = f"the factor {shown(owner.name)} has no default"
                yield Finding("default-missing", told, owner.where)
        acting = [owner for owner in factors if any(n not in harmless for n in _numbers(owner))]
        is_named = any(_FACTOR.sub("", owner.name) == feature for owner in factors)
        for owner in acting:
            where = owner.file.at(join(owner.pointer, "default"))
            value = shown(owner.schema["default"])
            if _FACTOR.sub("", owner.name) == feature:
                told = f"with {shown(owner.name)} at {value} by default an empty object changes the material"
                yield Finding("default-acts", told, where)
            elif acting == factors and not is_named:
                told = (
                    f"no factor is 0 by default, and {shown(owner.name)} is {value}: is {{}} without effect?"
                )
                yield Finding("default-may-act", told, where)


def _numbers(owner: Property) -> list[float]:
    default = owner.schema.get("default")
    return [v for v in (default if isinstance(default, list) else [default]) if isinstance(v, int | float)]


def _camel(name: str) -> str:
    """Return the extension's feature as its properties are called: "diffuseTransmission"."""
    words = name.split("_")[2:]
    return "".join([*words[:1], *(word[:1].upper() + word[1:] for word in words[1:])])
