"""The README's tables of properties against the schema: names, types, defaults and what is required."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.markdown import Markdown, Table, plain
from gltf_iri.proposal.objects import INHERITED, Kind, ObjectType, Property, extension_objects, item_kind

__all__ = ["tables"]

_NAME: Final = re.compile(r"[A-Za-z_]\w*")
_DEFAULT: Final = re.compile(
    r"default(?: value)?\s*(?::|is|=)?\s*(?:`([^`]*)`|(\[[^\]]*\]|[^\s,;]+))", re.IGNORECASE
)
_SIZE: Final = re.compile(r"\[\s*(\d*)")
# What tables write → what a schema calls it. Words that are not here may be any object's name.
_WORDS: Final[Mapping[str, Kind]] = {
    "number": Kind.NUMBER,
    "numbers": Kind.NUMBER,
    "float": Kind.NUMBER,
    "floats": Kind.NUMBER,
    "integer": Kind.INTEGER,
    "integers": Kind.INTEGER,
    "int": Kind.INTEGER,
    "boolean": Kind.BOOLEAN,
    "bool": Kind.BOOLEAN,
    "string": Kind.STRING,
    "strings": Kind.STRING,
    "textureinfo": Kind.TEXTURE,
    "normaltextureinfo": Kind.TEXTURE,
    "occlusiontextureinfo": Kind.TEXTURE,
}


@dataclass(frozen=True)
class _Row:
    line: int
    cells: Mapping[str, str]


def tables(proposal: Proposal) -> Iterator[Finding]:
    """Each object's table names the schema's properties, all of them, as the schema states them."""
    readme = proposal.readme
    if readme is None:
        return
    kinds = [kind for kind in extension_objects(proposal) if kind.properties]
    rows: dict[int, dict[str, _Row]] = {}
    for table in readme.tables:
        found = _rows(table)
        # The object that shares most names; the first of equals is the outermost.
        shared = [len(found.keys() & kind.properties.keys()) for kind in kinds]
        if shared and max(shared) > 0:
            rows.setdefault(shared.index(max(shared)), {}).update(found)
    for position, kind in enumerate(kinds):
        if position not in rows:
            if not any(_same_object(kind, kinds[other]) for other in rows):
                yield Finding("table-missing", f"there is no table for {kind.label}", readme.name)
            continue
        told = {kinds[other].path for other in rows}
        yield from _lacking(readme, kind, rows[position], told)
        yield from _compare(proposal, readme, kind, rows[position])


def _same_object(one: ObjectType, other: ObjectType) -> bool:
    return (one.file.name, one.pointer, one.properties.keys()) == (
        *(other.file.name, other.pointer, other.properties.keys()),
    )


def _lacking(
    readme: Markdown, kind: ObjectType, rows: Mapping[str, _Row], told: Container[tuple[str, ...]]
) -> Iterator[Finding]:
    """Yield the properties without a row, but for an object that a table of its own describes."""
    last = max(row.line for row in rows.values())
    for name in (name for name in kind.properties if name not in rows):
        if (*kind.path, name) not in told:
            text = f"the table of {kind.label} lacks {shown(name)}"
            yield Finding("table-missing-property", text, readme.at(last))


def _compare(
    proposal: Proposal, readme: Markdown, kind: ObjectType, rows: Mapping[str, _Row]
) -> Iterator[Finding]:
    for name, row in rows.items():
        owner = kind.properties.get(name)
        if owner is None:
            if name not in INHERITED | {"name"}:
                told = f"the schema of {kind.label} has no {shown(name)}"
                yield Finding("table-unknown-property", told, readme.at(row.line))
            continue
        yield from _compare_type(proposal, owner, row, readme.at(row.line))
        yield from _compare_need(owner, row, readme.at(row.line))
        yield from _compare_default(owner, row, readme.at(row.line), kind.properties.keys())


def _rows(table: Table) -> dict[str, _Row]:
    """Return a table's rows by the property in their first cell; nothing where it is no such table."""
    head = [plain(cell).lower() for cell in table.head]
    columns = ["name", *head[1:]]
    is_of_properties = "description" in head and any(
        word.startswith(("type", "required", "default")) for word in head
    )
    if not is_of_properties or head[0] not in ("", "property", "name", "property name", "parameter"):
        return {}
    rows = {}
    for line, cells in table.rows:
        name = plain(cells[0]) if cells else ""
        if _NAME.fullmatch(name):
            rows[name] = _Row(line, dict(zip(columns, cells, strict=False)))
    return rows


def _cell(row: _Row, word: str) -> str:
    cell = next((cell for column, cell in row.cells.items() if column.startswith(word)), "")
    return " ".join(cell.split())  # so that no pattern meets a megabyte of blanks


def _compare_type(proposal: Proposal, owner: Property, row: _Row, where: str) -> Iterator[Finding]:
    cell = plain(_cell(row, "type")).lower()
    if not cell or owner.kind is Kind.ANY:
        return
    is_array = owner.kind is Kind.ARRAY
    base = item_kind(proposal.schemas, owner) if is_array else owner.kind
    words = [_WORDS[word] for word in re.findall(r"[a-z]+", cell) if word in _WORDS]
    size = _SIZE.search(cell)
    says_array = size is not None or "array" in cell
    length = int(size[1]) if size and size[1] and "-" not in cell and "*" not in cell else None
    differs = says_array != is_array or (length is not None and owner.length not in (None, length))
    if words and base is not Kind.ANY:
        # An index into one of glTF's arrays is an integer, and every integer a number.
        differs |= base not in words and not (base is Kind.INTEGER and Kind.NUMBER in words)
    if not words and base not in (Kind.OBJECT, Kind.ANY):
        differs |= "array" not in cell
    if differs:
        size_told = f"[{owner.length}]" if owner.length is not None else "[]"
        told = f"{base.value}{size_told if is_array else ''}"
        yield Finding("table-type", f"{owner.name} is {shown(cell)} here, {told} in the schema", where)


def _compare_need(owner: Property, row: _Row, where: str) -> Iterator[Finding]:
    cell = plain(_cell(row, "required")).lower()
    says_required = bool(re.search(r"\byes\b|check_mark|✓|✅", cell))
    if (says_required or re.match(r"\W*no\b", cell)) and says_required != owner.is_required:
        told = "required" if owner.is_required else "optional"
        yield Finding("table-required", f"{owner.name} is {told} in the schema", where)


def _compare_default(owner: Property, row: _Row, where: str, names: Container[str]) -> Iterator[Finding]:
    stated = _stated_default(row)
    has_default = "default" in owner.schema
    expected = owner.schema.get("default")
    if stated is None:
        if (
            has_default
            and owner.kind is not Kind.TEXTURE
            and (_cell(row, "default") or _cell(row, "required"))
        ):
            told = f"{owner.name} is {shown_json(expected)} by default in the schema, not stated here"
            yield Finding("table-default-missing", told, where)
        return
    try:
        value = json.loads(stated)
    except (ValueError, RecursionError):
        value = stated
        if not (isinstance(expected, str) and expected == stated.strip("\"'")):
            if has_default:
                told = f"{owner.name}'s default {shown(stated)} is not JSON, so it was not compared"
                yield Finding("table-default-unread", told, where)
            elif stated not in names:
                told = f"{owner.name}'s default {shown(stated)} is stated here only"
                yield Finding("table-default-unread", told, where)
        return
    if not has_default:
        told = f"{owner.name} is {stated} by default here, and has no default in the schema"
        yield Finding("table-default", told, where)
    elif not _is_same(value, expected):
        told = f"{owner.name} is {stated} by default here, {shown_json(expected)} in the schema"
        yield Finding("table-default", told, where)


def _stated_default(row: _Row) -> str | None:
    column = _cell(row, "default").strip().strip("`")
    if column and column.lower() not in ("-", "—", "–", "none", "n/a"):
        return column
    match = _DEFAULT.search(_cell(row, "required"))
    return None if match is None else (match[1] if match[1] is not None else match[2])


def _is_same(one: Any, other: Any) -> bool:
    """Compare as JSON does: 1 and 1.0 are the same number, true is none."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(_is_same(a, b) for a, b in zip(one, other, strict=True))
    return isinstance(one, bool) is isinstance(other, bool) and bool(one == other)


def shown_json(value: Any) -> str:
    """Write a default as JSON."""
    return json.dumps(value)[:60]
