"""Are the schemas legal: in a known draft, by that draft's own rules, with keywords that it knows?"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gltf_iri.asset.words import join, shown
from gltf_iri.proposal.drafts import ALL_KEYWORDS, ANNOTATIONS, DRAFTS, Draft
from gltf_iri.proposal.evaluation import illegality
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.schema_set import SchemaFile
from gltf_iri.proposal.schema_walk import Place, subschemas

__all__ = ["draft", "identifiers", "keywords", "legal"]


def draft(proposal: Proposal) -> Iterator[Finding]:
    """Every schema names a draft that glTF's tools know."""
    for file in proposal.schemas.own.values():
        named = file.tree.get("$schema")
        where = file.at("/$schema")
        if named is None:
            told = (
                f"it does not say which draft it is written in; add $schema, such as {next(iter(DRAFTS))!r}"
            )
            yield Finding("draft-missing", told, file.at(""))
        elif file.draft is None:
            yield Finding("draft-unknown", f"{shown(named)} is none of JSON Schema's drafts", where)
        elif not file.draft.is_usual:
            yield Finding("draft-unusual", f"it is written in {file.draft.name}", where)
        elif proposal.is_of_materials and file.draft.name != "draft-04":
            told = f"it is written in {file.draft.name}, Khronos' own material extensions in draft-04"
            yield Finding("draft-of-materials", told, where)


def legal(proposal: Proposal) -> Iterator[Finding]:
    """Every schema is legal in its own draft."""
    for file in proposal.schemas.own.values():
        if file.draft is not None:
            fault = illegality(file.tree, file.draft)
            if fault is not None:
                told = f"it is illegal in {file.draft.name}: {fault.reason}"
                yield Finding("schema-illegal", told, file.at(fault.place))


def keywords(proposal: Proposal) -> Iterator[Finding]:
    """Every keyword is one that the schema's own draft knows; glTF's own begin with ``gltf_``."""
    for file in proposal.schemas.own.values():
        if file.draft is None:
            continue
        for place in subschemas(file.tree):
            for keyword in place.schema:
                known = file.draft.keywords | ANNOTATIONS
                if keyword not in known and not keyword.startswith("gltf_"):
                    yield _foreign(file, file.draft, place, keyword)


def _foreign(file: SchemaFile, draft: Draft, place: Place, keyword: str) -> Finding:
    where = file.at(join(place.pointer, keyword))
    if keyword not in ALL_KEYWORDS:
        return Finding("keyword-unknown", f"{shown(keyword)} is a keyword of no draft", where)
    told = f"{keyword!r} is no keyword of {draft.name}, so it demands nothing"
    if place.keyword == "anyOf" and _is_open(place.parent, place.schema):
        return Finding("keyword-without-effect", f"{told}; another alternative allows as much", where)
    return Finding("keyword-of-another-draft", told, where)


def _is_open(parent: Mapping[str, Any] | None, schema: Mapping[str, Any]) -> bool:
    """Tell whether an alternative beside `schema` demands a type at most, as open enumerations end."""
    members = [] if parent is None else parent["anyOf"]
    return any(m is not schema and isinstance(m, dict) and set(m) - ANNOTATIONS <= {"type"} for m in members)


def identifiers(proposal: Proposal) -> Iterator[Finding]:
    """Where a schema has a ``$id``, it is the file's name, by which others refer to it."""
    for file in proposal.schemas.own.values():
        named = file.tree.get("$id")
        if isinstance(named, str) and named.rpartition("/")[2] != file.name:
            told = f"its $id is {shown(named)}, and others refer to it as {shown(file.name)}"
            yield Finding("id-differs", told, file.at("/$id"))
