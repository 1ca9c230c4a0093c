"""How much a proposal may ask for: every bound of the checker, with its reason, and JSON within them."""

from __future__ import annotations

from typing import Any, Final

from gltf_iri.asset.strict_json import parse_json
from gltf_iri.errors import AssetError

__all__ = [
    "MAX_EXAMPLE_BYTES",
    "MAX_EXPANSION",
    "MAX_FINDINGS",
    "MAX_OBJECTS",
    "MAX_README_BYTES",
    "MAX_REF_DEPTH",
    "MAX_SCHEMAS",
    "MAX_SCHEMA_BYTES",
    "MAX_SIBLINGS",
    "MAX_STEPS",
    "parse_bounded",
]

# The longest README of glTF's registry has some 100 KB, the largest schema some 10 KB.
MAX_README_BYTES: Final = 2**20
MAX_SCHEMA_BYTES: Final = 2**16
MAX_EXAMPLE_BYTES: Final = 2**14

# Files of schemas in one folder; the interactivity extensions have about twenty.
MAX_SCHEMAS: Final = 64

# Folders beside the proposal whose READMEs may exclude it; the registry has about a hundred.
MAX_SIBLINGS: Final = 256

# References that lead through each other, and subschemas that one stands for once all are followed: a few
# lines that refer to each other twice, forty times, would stand for 2**40.
MAX_REF_DEPTH: Final = 32
MAX_EXPANSION: Final = 4096

# Objects inside objects that tables and pointers are made for.
MAX_OBJECTS: Final = 64

# Findings of one rule: who has more has one fault many times, or means to fill the disk.
MAX_FINDINGS: Final = 200

# Keywords that all validation together may look at; a proposal needs a few thousand.
MAX_STEPS: Final = 100_000

# jsonschema recurses for each level, some ten Python frames in 2020-12, and compares arrays pairwise.
_MAX_DEPTH: Final = 40
_MAX_ITEMS: Final = 1000


def parse_bounded(data: bytes) -> Any:
    """Parse strict JSON that validators can walk; AssetError where it is broken, too deep or too wide."""
    tree = parse_json(data)
    level = [tree]
    for _ in range(_MAX_DEPTH):
        for value in level:
            if isinstance(value, dict | list) and len(value) > _MAX_ITEMS:
                raise AssetError(f"an object or array has more than {_MAX_ITEMS} members")
        level = [child for value in level for child in _children(value)]
        if not level:
            return tree
    raise AssetError(f"it is nested deeper than {_MAX_DEPTH} levels, the most that is checked")


def _children(value: Any) -> list[Any]:
    children = list(value.values()) if isinstance(value, dict) else value
    return [c for c in children if isinstance(c, dict | list)] if isinstance(children, list) else []
