"""KHR_materials_iridescence: films that do nothing, cannot be seen, or look different everywhere.

One rule for the whole file, which loads the others where the file declares the extension.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import add_codes
from gltf_iri.validation.iridescence.codes import IRIDESCENCE_CODES, NAME

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["DATA_RULES", "RULES"]


def _films(root: Entry, asset: Asset) -> Iterator[Issue]:
    if NAME in asset.declared:
        from gltf_iri.validation.iridescence.rules import films

        yield from films(root, asset)


def _pictures(root: Entry, asset: Asset) -> Iterator[Issue]:
    if NAME in asset.declared:
        from gltf_iri.validation.iridescence.rules import pictures

        yield from pictures(asset)


add_codes(IRIDESCENCE_CODES)
RULES: Rules = {"glTF": (_films,)}
DATA_RULES: Rules = {"glTF": (_pictures,)}
