"""HTML pages from templates, safe with whatever a file calls its things."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import jinja2

__all__ = ["load_template"]


def load_template(path: Path, figure: Callable[[float | None], str]) -> jinja2.Template:
    """Return the template at `path`; its filter `figure` writes numbers for people.

    Names in assets may hold markup: everything is escaped. What a template lacks is an error.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    templates = Environment(
        loader=FileSystemLoader(path.parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters["figure"] = figure
    return templates.get_template(path.name)
