"""What the verbs share: strict JSON, tables, notes and progress.

Results go to stdout; notes and progress go to stderr, progress on a terminal only.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from enum import Enum
from pathlib import Path
from typing import Any

import click

from gltf_iri.asset.words import printable

__all__ = ["file_argument", "json_option", "material_label", "note", "print_json", "print_table", "printable"]
__all__ += ["progress", "working"]

_LABEL_MAX = 60  # a longer name would break the tables

json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of text.")

file_argument = click.argument(
    "file", type=click.Path(exists=True, dir_okay=False, readable=True, path_type=Path)
)


def material_label(index: int, name: str) -> str:
    """Return what people read for a material: its number and its name, which may be absent or endless."""
    if index < 0:
        return "glTF's default"
    shown = name if len(name) <= _LABEL_MAX else name[: _LABEL_MAX - 1] + "…"
    return f"{index} {shown or 'unnamed'}"


def print_json(value: Any) -> None:
    """Print `value` as strict JSON: arrays become lists, NaN and infinities null, paths and enums text."""
    click.echo(json.dumps(_plain(value), indent=2, allow_nan=False))


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):  # numpy arrays and scalars, without importing numpy
        value = value.tolist()
    if isinstance(value, Enum):
        return _plain(value.value)
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, Mapping):
        return {str(_plain(key)): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value


def note(text: str) -> None:
    """Tell the user something beside the result, on stderr."""
    click.echo(f"note: {printable(text)}", err=True)


def print_table(columns: Sequence[str], rows: Iterable[Sequence[object]], *, title: str = "") -> None:
    """Print a table: drawn with rich on a terminal, aligned plain text in a pipe."""
    cells = [[printable(str(cell)) for cell in row] for row in rows]
    if sys.stdout.isatty():
        _print_rich_table(columns, cells, title)
        return
    if title:
        click.echo(printable(title))
    widths = [max(map(len, column)) for column in zip(columns, *cells, strict=True)]
    for row in [list(columns), *cells]:
        click.echo("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())


def _print_rich_table(columns: Sequence[str], cells: Sequence[Sequence[str]], title: str) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(*columns, title=Text(printable(title)) if title else None, title_justify="left")
    for row in cells:
        table.add_row(*(Text(cell) for cell in row))  # Text: square brackets in a name are not markup
    Console().print(table)


@contextmanager
def working(what: str) -> Iterator[None]:
    """Show on a terminal that something of unknown length is under way while the block runs."""
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    with Console(stderr=True).status(what):
        yield


@contextmanager
def progress(what: str, total: int) -> Iterator[Callable[[], None]]:
    """Show progress over `total` steps while the block runs; yields the function that advances one step."""
    if not sys.stderr.isatty():
        yield lambda: None
        return
    from rich.console import Console
    from rich.progress import Progress

    # What is printed meanwhile stands above the bar; in a pipe, it must stay on its own way.
    with Progress(console=Console(stderr=True), transient=True, redirect_stdout=sys.stdout.isatty()) as bar:
        shown = bar.add_task(what, total=total)
        yield lambda: bar.advance(shown)
