"""Reports as a table for spreadsheets (RFC 4180), a row for each remark."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator

from gltf_iri.asset.words import printable
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.issue import SEVERITY_NAMES

__all__ = ["COLUMNS", "written"]

COLUMNS = ("file", "severity", "code", "pointer", "offset", "line", "message")

# What spreadsheets take for the start of a formula; a name in a file could run one.
_FORMULA = ("=", "+", "-", "@")


def written(files: Iterable[Judged]) -> Iterator[str]:
    """Yield the header and the rows; files without remarks have none."""
    yield _row(COLUMNS)
    for file in files:
        for message, line in zip(file.messages, file.lines(), strict=True):
            yield _row(
                (
                    file.path,
                    SEVERITY_NAMES[message["severity"]],
                    message["code"],
                    message.get("pointer", ""),
                    str(message.get("offset", "")),
                    "" if line is None else str(line),
                    message["message"],
                )
            )


def _row(cells: Iterable[str]) -> str:
    row = io.StringIO()
    csv.writer(row, lineterminator="\r\n").writerow([_harmless(cell) for cell in cells])
    return row.getvalue()


def _harmless(cell: str) -> str:
    """Return a cell that is text in every spreadsheet: an apostrophe before what would be a formula."""
    told = printable(cell)
    return f"'{told}" if told.lstrip().startswith(_FORMULA) else told
