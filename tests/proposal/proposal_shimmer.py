"""A small proposal of our own, without a fault, as a registry's folder has it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gltf_iri.proposal.check import check_proposal
from gltf_iri.proposal.finding import Finding

__all__ = ["LAYER", "MATERIAL", "NAME", "README", "Edit", "findings", "in_json", "in_text", "write"]

NAME = "EXT_materials_shimmer"
MATERIAL = f"schema/material.{NAME}.schema.json"
LAYER = f"schema/material.{NAME}.layer.schema.json"
README = "README.md"

Edit = Callable[[Path], None]

_DRAFT = "http://json-schema.org/draft-04/schema"
_BASE = [{"$ref": "glTFProperty.schema.json"}]
_MATERIAL = {
    "$schema": _DRAFT,
    "title": f"{NAME} glTF Material Extension",
    "type": "object",
    "description": "Shimmer.",
    "allOf": _BASE,
    "properties": {
        "shimmerFactor": {
            "type": "number",
            "description": "How much shimmer there is.",
            "default": 0.0,
            "minimum": 0.0,
            "maximum": 1.0,
        },
        "shimmerTexture": {
            "allOf": [{"$ref": "textureInfo.schema.json"}],
            "description": "How much shimmer there is: the R channel, linear, 1.0 if it is not given.",
        },
        "shimmerColorFactor": {
            "type": "array",
            "items": {"type": "number", "minimum": 0.0, "maximum": 1.0},
            "minItems": 3,
            "maxItems": 3,
            "description": "The colour, linear.",
            "default": [1.0, 1.0, 1.0],
        },
        "layers": {
            "type": "array",
            "description": "The layers, outermost first.",
            "items": {"$ref": f"material.{NAME}.layer.schema.json"},
            "minItems": 1,
        },
        "extensions": {},
        "extras": {},
    },
}
_LAYER = {
    "$schema": _DRAFT,
    "title": f"{NAME} Layer",
    "type": "object",
    "description": "A layer.",
    "allOf": _BASE,
    "properties": {
        "thickness": {"type": "number", "description": "In nanometers.", "default": 250.0, "minimum": 0.0},
        "cells": {"type": "integer", "description": "How many.", "minimum": 1},
        "extensions": {},
        "extras": {},
    },
    "required": ["cells"],
}
_TEXT = f"""<!-- a comment
# that is no heading -->
# EXT\\_materials\\_shimmer

## Contributors

- Nobody, [@nobody](https://example.org/nobody)

## Status

Draft

## Dependencies

Written against the glTF 2.0 spec.

## Exclusions

- This extension must not be used on a material that also uses `EXT_materials_glimmer`.

## Overview

Shimmer, see [the layers](#layers) and ![a figure](./figures/shimmer.png).

## Extending Materials

```json
{{
  "asset": {{ "version": "2.0" }},
  "extensionsUsed": ["{NAME}"],
  "materials": [
    {{
      "extensions": {{
        "{NAME}": {{
          "shimmerFactor": 0.5,
          "shimmerTexture": {{
            "index": 0, "extensions": {{ "KHR_texture_transform": {{ "scale": [2, 2] }} }}
          }},
          "layers": [{{ "thickness": 300.0, "cells": 4 }}]
        }}
      }}
    }}
  ]
}}
```

## Properties

| | Type | Description | Required |
|-|------|-------------|----------|
| **shimmerFactor** | `number` | How much shimmer. | No, default:`0.0` |
| **shimmerTexture** | [`textureInfo`](https://example.org/#info) | The same, as a texture. | No |
| **shimmerColorFactor** | `number[3]` | The colour. | No, default: `[1,1,1]` |
| **layers** | `layer[1-*]` | The layers. | No |

### Layers

| Property | Type | Description | Required |
|----------|------|-------------|----------|
| `thickness` | `number` | In nm. | No, default: `250` |
| `cells` | `integer` | How many. | :white_check_mark: Yes |

## Interaction with other extensions

`KHR_materials_ior` is defined with this extension; `EXT_materials_glimmer` is excluded.

## Object Model

| Pointer | Type |
|---------|------|
| `/materials/{{}}/extensions/{NAME}/shimmerFactor` | `float` |
| `/materials/{{}}/extensions/{NAME}/shimmerColorFactor` | `float3` |
| `/materials/{{}}/extensions/{NAME}/layers/{{}}/thickness` | `float` |
| `/materials/{{}}/extensions/{NAME}/layers.length` | `int` |
| `/materials/{{}}/extensions/{NAME}/shimmerTexture/extensions/KHR_texture_transform/offset` | `float2` |
| `/materials/{{}}/extensions/{NAME}/shimmerTexture/extensions/KHR_texture_transform/rotation` | `float` |
| `/materials/{{}}/extensions/{NAME}/shimmerTexture/extensions/KHR_texture_transform/scale` | `float2` |

## Schema

- [the material](schema/material.{NAME}.schema.json)
"""
_GLIMMER = f"""# EXT_materials_glimmer

## Exclusions

Must not stand on a material that also uses `{NAME}`.
"""


def write(folder: Path) -> Path:
    """Write the proposal, and the one that it excludes beside it; return its folder."""
    root = folder / NAME
    (root / "schema").mkdir(parents=True)
    (root / "figures").mkdir()
    (root / "figures" / "shimmer.png").write_bytes(b"")
    (root / MATERIAL).write_text(json.dumps(_MATERIAL, indent=2), encoding="utf-8")
    (root / LAYER).write_text(json.dumps(_LAYER, indent=2), encoding="utf-8")
    (root / README).write_text(_TEXT, encoding="utf-8")
    (folder / "EXT_materials_glimmer").mkdir()
    (folder / "EXT_materials_glimmer" / README).write_text(_GLIMMER, encoding="utf-8")
    return root


def findings(folder: Path) -> list[Finding]:
    """Return what the checker finds in a folder."""
    return list(check_proposal(folder).findings)


def in_json(file: str, change: Callable[[Any], object]) -> Edit:
    """Return an edit that lets `change` alter the tree of a JSON file."""

    def edit(root: Path) -> None:
        tree = json.loads((root / file).read_text(encoding="utf-8"))
        change(tree)
        (root / file).write_text(json.dumps(tree), encoding="utf-8")

    return edit


def in_text(file: str, old: str, new: str) -> Edit:
    """Return an edit that replaces the first place of `old`, which must be there."""

    def edit(root: Path) -> None:
        text = (root / file).read_text(encoding="utf-8")
        assert old in text, f"{old!r} is not in {file}"
        (root / file).write_text(text.replace(old, new, 1), encoding="utf-8")

    return edit
