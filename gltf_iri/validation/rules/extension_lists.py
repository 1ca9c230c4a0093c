"""extensionsUsed and extensionsRequired."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.tables import EXTENSIONS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

# A vendor's prefix, "_" and a name (KhronosGroup/glTF, extensions/README.md, "Naming"); that names are in
# snake case is the registry's rule, which older ones do not follow.
_NAME = re.compile(r"[A-Z0-9]+_[A-Za-z0-9_]+")


def used_extensions_are_known(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Each name has the form of one, is an extension of our tables, and is required if it must be."""
    required = set(entry.get("extensionsRequired", ()))
    listed = entry.at("extensionsUsed")
    for position, name in enumerate(entry.get("extensionsUsed", ())):
        pointer = f"{listed}/{position}"
        if not _NAME.fullmatch(name):
            yield issue("INVALID_EXTENSION_NAME_FORMAT", pointer)
        if name not in EXTENSIONS:
            yield issue("UNSUPPORTED_EXTENSION", pointer, extension=name)
        elif EXTENSIONS[name].is_required and name not in required:
            yield issue("NON_REQUIRED_EXTENSION", pointer, extension=name)


def required_extensions_are_used(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """What is required stands in extensionsUsed too."""
    if "extensionsRequired" in entry.raw and "extensionsUsed" not in entry.raw:
        yield issue("UNSATISFIED_DEPENDENCY", entry.at("extensionsRequired"), property="extensionsUsed")
    for position, name in enumerate(entry.get("extensionsRequired", ())):
        if name not in asset.declared:
            pointer = entry.at("extensionsRequired", position)
            yield issue("UNUSED_EXTENSION_REQUIRED", pointer, extension=name)


RULES: Rules = {"glTF": (used_extensions_are_known, required_extensions_are_used)}
