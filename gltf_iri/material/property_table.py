"""The property table of the docs, from the rows that the parser and the shaders read."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from gltf_iri.material.fields import Kind, Property, properties
from gltf_iri.material.material import Material
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo, TextureTransform

__all__ = ["properties_markdown"]

_COLUMNS = ("glTF", "here", "default", "range", "unit", "channels", "colour space", "about")
_HEAD = f"| {' | '.join(_COLUMNS)} |\n|{'---|' * len(_COLUMNS)}"


def properties_markdown() -> str:
    """Return the text of spec/properties.md."""
    core = [("material", Material)]
    nested = list(_inside(Material))
    textures: list[tuple[str, type]] = [
        ("textureInfo", TextureInfo),
        ("normalTextureInfo", NormalTextureInfo),
        ("occlusionTextureInfo", OcclusionTextureInfo),
        (TextureTransform.EXTENSION, TextureTransform),
    ]
    parts = [
        "# Material properties",
        "Every property that the program reads, with its default and range. "
        "Written by `python -m gltf_iri.generate` from `gltf_iri/material/`; do not edit.",
    ]
    for title, cls in (*core, *nested, *textures):
        own = [_line(name, row) for name, row in properties(cls) if row.kind is not Kind.NESTED]
        body = "\n".join([_HEAD, *own]) if own else "No properties: its presence is its meaning."
        parts.append(f"## {title}\n\n{body}")
    return "\n\n".join(parts) + "\n"


def _inside(cls: type, prefix: str = "") -> Iterator[tuple[str, type]]:
    """Yield the objects that `cls` holds, and right after each the objects that lists of it hold."""
    for _, row in properties(cls):
        if row.cls is not None and row.kind in {Kind.NESTED, Kind.EXTENSION, Kind.NESTED_LIST}:
            title = f"{prefix}{row.key}{'[]' if row.kind is Kind.NESTED_LIST else ''}"
            yield title, row.cls
            yield from _inside(row.cls, f"{title}.")


def _line(attribute: str, row: Property) -> str:
    default = "required" if row.required else _value(row)
    about = row.about.replace("|", "\\|")
    unit = "" if row.unit == "1" else row.unit
    cells = (
        f"`{row.key}`",
        f"`{attribute}`",
        default,
        _range(row),
        unit,
        row.channels,
        row.colour_space,
        about,
    )
    return "| " + " | ".join(cells) + " |"


def _value(row: Property) -> str:
    value: Any = row.default
    if value is None:
        return "absent"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return "[" + ", ".join(f"{component:g}" for component in value) + "]"
    if isinstance(value, float):
        return "∞" if math.isinf(value) else f"{value:g}"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _range(row: Property) -> str:
    if row.choices:
        return ", ".join(row.choices)
    if row.low is None and row.high is None:
        return ""
    return row.range_text
