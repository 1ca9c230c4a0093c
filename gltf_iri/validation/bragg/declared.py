"""EXT_materials_bragg: mirrors that must not be, cannot be drawn, or do nothing.

The rules themselves are loaded where a file declares the extension: few do.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from gltf_iri.validation.bragg.codes import BRAGG_CODES
from gltf_iri.validation.codes import add_codes

if TYPE_CHECKING:
    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["DATA_RULES", "RULES"]

_NAME = "EXT_materials_bragg"


def _layers(root: Entry, asset: Asset) -> Iterator[Issue]:
    if _NAME in asset.declared:
        from gltf_iri.validation.bragg.rules import layers

        yield from layers(root, asset)


def _data(root: Entry, asset: Asset) -> Iterator[Issue]:
    if _NAME in asset.declared:
        from gltf_iri.validation.bragg.rules import data

        yield from data(asset)


add_codes(BRAGG_CODES)
RULES: Rules = {"glTF": (_layers,)}
DATA_RULES: Rules = {"glTF": (_data,)}
