"""Names: of the extension, its files, their titles and its properties.

The rules are those of extensions/README.md in KhronosGroup/glTF ("Naming conventions") and the habits of the
schemas there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal, scope_of
from gltf_iri.proposal.objects import extension_objects
from gltf_iri.proposal.schema_set import CORE_NAMES, SUFFIX

__all__ = ["EXTENSION_NAME", "extension_name", "file_names", "property_names", "titles"]

# Names in text: lowercase behind the prefix, and more than a letter; FLOAT_VEC3 and TEXCOORD_n are none.
EXTENSION_NAME: Final = re.compile(r"\b[A-Z][A-Z0-9]*_[a-z][A-Za-z0-9_]{2,}\b")

# Scopes that are objects inside the document; those of extensions may also be kept in lists at its root.
_OF_PARTS: Final = re.compile(r"[A-Z0-9]+_(?:materials?|textures?|mesh|node|camera|image|buffer|sampler)_")
_FORM: Final = re.compile(r"[A-Z][A-Z0-9]*(_[A-Za-z0-9]+)+")
_SNAKE: Final = re.compile(r"[A-Z][A-Z0-9]*(_[a-z0-9]+)+")
_CAMEL: Final = re.compile(r"[a-z][A-Za-z0-9]*")


def extension_name(proposal: Proposal) -> Iterator[Finding]:
    """The folder is called as the extension: an uppercase prefix, then lowercase words."""
    name = proposal.name
    if not _FORM.fullmatch(name):
        told = f"{shown(name)} is no extension's name; call the folder PREFIX_scope_feature"
        yield Finding("name-form", told, "")
    elif not _SNAKE.fullmatch(name):
        yield Finding("name-case", f"write {shown(name)} in lowercase behind its prefix", "")
    elif name.count("_") < 2:
        yield Finding("name-parts", f"{shown(name)} names no scope and feature", "")


def file_names(proposal: Proposal) -> Iterator[Finding]:
    """A schema of the extension's own objects is called ``<scope>.<NAME>.schema.json``."""
    files = proposal.schemas.own.values()
    if files and not proposal.entries:
        told = f"no file is called <scope>.{proposal.name}{SUFFIX}, such as material.{proposal.name}{SUFFIX}"
        yield Finding("file-name", told, next(iter(files)).where)
    for file in files:
        for other in EXTENSION_NAME.findall(file.name.removesuffix(SUFFIX)):
            if other != proposal.name:
                told = f"its name speaks of {shown(other)}, the folder of {shown(proposal.name)}"
                yield Finding("file-name", told, file.where)
    for entry in proposal.entries:
        scope = scope_of(entry, proposal.name)
        if not scope:
            told = f"its name does not tell what is extended: <scope>.{proposal.name}{SUFFIX}"
            yield Finding("file-scope-missing", told, entry.where)
        elif scope not in CORE_NAMES:
            yield Finding("file-scope", f"{shown(scope)} is no object of glTF's core", entry.where)
        elif scope == "glTF" and len(proposal.entries) == 1 and _OF_PARTS.match(proposal.name):
            told = "its name says that the document's root is extended; name the object that is"
            yield Finding("scope-differs", told, entry.where)


def titles(proposal: Proposal) -> Iterator[Finding]:
    """Every schema has a title, and the extension's own objects are titled with its name."""
    for file in proposal.schemas.own.values():
        title = file.tree.get("title")
        if not isinstance(title, str) or not title.strip():
            yield Finding("title-missing", "it has no title", file.at(""))
        elif file in proposal.entries and proposal.name not in title:
            told = f"its title {shown(title)} does not name {proposal.name}"
            yield Finding("title-differs", told, file.at("/title"))


def property_names(proposal: Proposal) -> Iterator[Finding]:
    """Properties are called in camelCase."""
    for kind in extension_objects(proposal):
        for owner in kind.properties.values():
            if not _CAMEL.fullmatch(owner.name):
                yield Finding("property-case", f"{shown(owner.name)} is not camelCase", owner.where)
