"""Do references lead somewhere, stay inside the folder, and come to an end?"""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.words import shown
from gltf_iri.proposal.bounds import MAX_EXPANSION, MAX_REF_DEPTH
from gltf_iri.proposal.drafts import ANNOTATIONS
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.schema_set import DanglingError, SchemaFile
from gltf_iri.proposal.schema_walk import IN_PLACE, Place, children, subschemas

__all__ = ["expansion", "resolved", "siblings", "unused"]


def resolved(proposal: Proposal) -> Iterator[Finding]:
    """Every ``$ref`` leads to a schema of the folder or of glTF itself."""
    for file in proposal.schemas.own.values():
        for place in subschemas(file.tree):
            if "$ref" not in place.schema:
                continue
            try:
                target = proposal.schemas.find(file, place.pointer, place.schema["$ref"])
            except DanglingError as error:
                yield error.finding
                continue
            if target.file.is_stand_in and target.file.tree == {}:
                told = f"what {shown(target.file.name)} demands is not known here and was not checked"
                yield Finding("ref-not-known", told, file.at(place.pointer))


def siblings(proposal: Proposal) -> Iterator[Finding]:
    """Beside a ``$ref`` stands nothing that the draft would ignore."""
    for file in proposal.schemas.own.values():
        if file.draft is None or not file.draft.ignores_ref_siblings:
            continue
        for place in subschemas(file.tree):
            beside = sorted(place.schema.keys() - ANNOTATIONS - {"$ref", "$schema"})
            if "$ref" in place.schema and beside:
                told = f"{file.draft.name} ignores {shown(', '.join(beside))} beside $ref; write allOf"
                yield Finding("ref-siblings", told, file.at(place.pointer))


def unused(proposal: Proposal) -> Iterator[Finding]:
    """Every schema is an extension's own object or a part of one."""
    schemas = proposal.schemas
    reached = {entry.name for entry in proposal.entries}
    waiting = list(proposal.entries)
    while waiting:
        file = waiting.pop()
        for place in subschemas(file.tree):
            try:
                name = schemas.find(file, place.pointer, place.schema["$ref"]).file.name
            except (DanglingError, KeyError):
                continue
            if name in schemas.own and name not in reached:
                reached.add(name)
                waiting.append(schemas.own[name])
    for file in schemas.own.values():
        if proposal.entries and file.name not in reached:
            yield Finding("schema-unused", "no schema of the extension's own objects leads to it", file.where)


def expansion(proposal: Proposal) -> Iterator[Finding]:
    """References that judge the same value again come to an end, and to a small one."""
    sizes: dict[int, int] = {}
    for file in proposal.schemas.own.values():
        for place in subschemas(file.tree):
            finding = _Expansion(proposal, sizes).of(file, place, ())
            if isinstance(finding, Finding):
                yield finding
                return  # whatever leads to it would be named again


class _Expansion:
    """How many subschemas one stands for once its references are followed, each node measured once."""

    def __init__(self, proposal: Proposal, sizes: dict[int, int]) -> None:
        self._schemas = proposal.schemas
        self._sizes = sizes

    def of(self, file: SchemaFile, place: Place, above: tuple[int, ...]) -> int | Finding:
        known = self._sizes.get(id(place.schema))
        if known is not None:
            return known
        if id(place.schema) in above:
            told = "following it leads back to itself without looking at a part of the value"
            return Finding("ref-cycle", told, file.at(place.pointer))
        if len(above) > MAX_REF_DEPTH:
            told = f"references lead through each other more than {MAX_REF_DEPTH} times"
            return Finding("ref-expansion", told, file.at(place.pointer))
        size = 1
        for inside_file, inside in self._inside(file, place):
            one = self.of(inside_file, inside, (*above, id(place.schema)))
            if isinstance(one, Finding):
                return one
            size += one
            if size > MAX_EXPANSION:
                told = f"with its references followed it stands for more than {MAX_EXPANSION} schemas"
                return Finding("ref-expansion", told, file.at(place.pointer))
        self._sizes[id(place.schema)] = size
        return size

    def _inside(self, file: SchemaFile, place: Place) -> Iterator[tuple[SchemaFile, Place]]:
        for child in children(place):
            if child.keyword in IN_PLACE:
                yield file, child
        if "$ref" in place.schema:
            try:
                target = self._schemas.find(file, place.pointer, place.schema["$ref"])
            except DanglingError:
                return
            yield target.file, Place(target.pointer, target.schema)
