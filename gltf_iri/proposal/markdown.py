"""What the checker needs of a README: headings, tables, fenced blocks, links, and text in blocks.

Line by line and in linear time; a README is untrusted. GitHub's dialect, as the registry shows it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

__all__ = ["Block", "Fence", "Heading", "Link", "Markdown", "Table", "parse_markdown", "plain"]

_FENCE: Final = re.compile(r"([ \t]*)(`{3,}|~{3,})[ \t]*([A-Za-z0-9_+-]*)")
_BULLET: Final = re.compile(r"[ \t]*(?:[-*+]|\d{1,4}[.)])[ \t]")
_CODE: Final = re.compile(r"`+[^`]*`+")
_LINK: Final = re.compile(r"\]\([ \t]*<?([^\s()<>]*(?:\([^\s()<>]*\)[^\s()<>]*)*)")
_HTML_LINK: Final = re.compile(r"<(?:img|a)\b[^<>]*?\s(?:src|href)=[\"']([^\"'<>]*)[\"']")
_HTML_ANCHOR: Final = re.compile(r"<[a-z]+\b[^<>]*?\s(?:id|name)=[\"']([^\"'<>]*)[\"']")
_NAMED_LINK: Final = re.compile(r"[ ]{0,3}\[[^\[\]]+\]:[ \t]*<?([^\s<>]+)")
_LINK_TEXT: Final = re.compile(r"!?\[([^\[\]]*)\]\([^()]*\)")


@dataclass(frozen=True)
class Heading:
    """A heading: its level, its text without markup, its line."""

    level: int
    text: str
    line: int

    @property
    def anchor(self) -> str:
        """What links call it, as GitHub makes it: lowercase, spaces to hyphens, no punctuation."""
        kept = (c for c in self.text.lower() if c.isalnum() or c in "-_ ")
        return "".join(kept).replace(" ", "-")


@dataclass(frozen=True)
class Fence:
    """A fenced block: the word behind the fence, its text, the line of its first line."""

    language: str
    text: str
    line: int


@dataclass(frozen=True)
class Table:
    """A table: the cells of its head and of its rows, each row with its line."""

    head: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    line: int


@dataclass(frozen=True)
class Link:
    """Where a link or a picture leads."""

    target: str
    line: int


@dataclass(frozen=True)
class Block:
    """A paragraph, an item of a list or a row of a table, under the headings that it stands below."""

    text: str
    line: int
    headings: tuple[Heading, ...]


@dataclass
class Markdown:
    """A README, taken apart."""

    name: str
    headings: list[Heading] = field(default_factory=list)
    fences: list[Fence] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)

    def at(self, line: int) -> str:
        """Return the place of a line, as editors take it."""
        return f"{self.name}:{line}"


def plain(text: str) -> str:
    """Return what a reader sees of a line: no escapes, no emphasis, no code marks, the text of links."""
    text = _LINK_TEXT.sub(r"\1", text)
    return re.sub(r"\\([_*`|\[\]#.])|\*\*|`", r"\1", text).strip().strip("*")


def parse_markdown(text: str, name: str) -> Markdown:
    """Take a README apart; nothing in it is an error."""
    found = Markdown(name)
    path: tuple[Heading, ...] = ()
    block: list[str] = []
    start = 0
    rows: list[tuple[int, str]] = []

    def end_block() -> None:
        if block:
            found.blocks.append(Block(plain(" ".join(block)), start, path))
            block.clear()

    for number, line in _outside_fences(text, found):
        stripped = line.strip()
        is_row = "|" in stripped and not _BULLET.match(line)
        if rows and not is_row:
            _end_table(rows, found, path)
        if is_row:
            end_block()
            rows.append((number, stripped))
        elif 0 < len(stripped) - len(stripped.lstrip("#")) <= 6 and stripped.lstrip("#")[:1] in (
            " ",
            "\t",
            "",
        ):
            end_block()
            level = len(stripped) - len(stripped.lstrip("#"))
            heading = Heading(level, plain(stripped.strip("#").strip()), number)
            path = (*(above for above in path if above.level < level), heading)
            found.headings.append(heading)
            found.blocks.append(Block(heading.text, number, path))
        elif not stripped:
            end_block()
        else:
            if _BULLET.match(line):
                end_block()
            if not block:
                start = number
            block.append(stripped)
        _take_links(line, number, found)
    _end_table(rows, found, path)
    end_block()
    _name_anchors(found)
    return found


def _outside_fences(text: str, found: Markdown) -> Iterator[tuple[int, str]]:
    """Yield the lines that are neither in a fence nor in a comment; fences are put into `found`."""
    fence: tuple[str, str, str, int] | None = None
    inside: list[str] = []
    in_comment = False
    for number, line in enumerate(text.splitlines(), start=1):
        if in_comment:
            in_comment = "-->" not in line
            continue
        mark = _FENCE.match(line)
        if fence is not None:
            is_closed = (
                mark and mark[2].startswith(fence[1]) and not line[mark.end() :].strip() and not mark[3]
            )
            if is_closed:
                found.fences.append(Fence(fence[2], "\n".join(inside), fence[3]))
                fence = None
            else:
                inside.append(line.removeprefix(fence[0]))
            continue
        if mark and "`" not in line[mark.end() :]:
            fence, inside = (mark[1], mark[2], mark[3].lower(), number + 1), []
            yield number, ""
            continue
        if line.lstrip().startswith("<!--"):
            in_comment = "-->" not in line
            continue
        yield number, line
    if fence is not None:
        found.fences.append(Fence(fence[2], "\n".join(inside), fence[3]))


def _end_table(rows: list[tuple[int, str]], found: Markdown, path: tuple[Heading, ...]) -> None:
    cells = [(number, tuple(_cells(row))) for number, row in rows]
    for number, row in rows:
        found.blocks.append(Block(plain(row), number, path))
    rows.clear()
    if len(cells) > 1 and all("-" in cell and not cell.strip(":- ") for cell in cells[1][1]):
        found.tables.append(Table(cells[0][1], tuple(cells[2:]), cells[0][0]))


def _cells(row: str) -> Iterator[str]:
    """Split a row at its bars, but not at escaped ones nor within code."""
    row = row.removeprefix("|")
    cell: list[str] = []
    in_code = is_escaped = False
    for character in row:
        if character == "|" and not in_code and not is_escaped:
            yield "".join(cell).strip()
            cell = []
            continue
        if character == "`":
            in_code = not in_code
        is_escaped = character == "\\" and not is_escaped
        cell.append(character)
    if "".join(cell).strip():
        yield "".join(cell).strip()


def _take_links(line: str, number: int, found: Markdown) -> None:
    shown = _CODE.sub("", line)
    found.links += [Link(match[1], number) for match in _LINK.finditer(shown)]
    found.links += [Link(match[1], number) for match in _HTML_LINK.finditer(shown)]
    found.anchors |= {match[1].lower() for match in _HTML_ANCHOR.finditer(shown)}
    named = _NAMED_LINK.match(shown)
    if named and not named[1].startswith("^"):
        found.links.append(Link(named[1], number))


def _name_anchors(found: Markdown) -> None:
    counts: dict[str, int] = {}
    for heading in found.headings:
        seen = counts.get(heading.anchor, 0)
        counts[heading.anchor] = seen + 1
        found.anchors.add(f"{heading.anchor}-{seen}" if seen else heading.anchor)
