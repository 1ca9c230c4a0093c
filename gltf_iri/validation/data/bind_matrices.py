"""Inverse bind matrices: affine ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.asset.formats import INVERSE_BIND_MATRIX_FORMATS
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, elements_of
from gltf_iri.validation.rules.primitives import accessor_format

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["bind_matrices_are_affine"]

# The last row of a matrix that is stored by columns: 0, 0, 0, 1, to the last bit (glTF 2.0, §3.7.3.1).
_LAST_ROW = {3: 0.0, 7: 0.0, 11: 0.0, 15: 1.0}


def bind_matrices_are_affine(skin: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of matrices whose last row is another than 0, 0, 0, 1."""
    accessor = asset.get("accessors", skin.get("inverseBindMatrices"))
    if accessor is None or accessor_format(accessor) not in INVERSE_BIND_MATRIX_FORMATS:
        return
    elements = elements_of(accessor, asset)
    if elements is None or ("affine", accessor) in asset.resources.found:
        return
    is_clean = True
    for first in blocks(elements, asset, accessor.pointer):
        columns = elements.columns(first)
        for place, wanted in _LAST_ROW.items():
            column = columns[place]
            if column.count(wanted) == len(column):
                continue
            is_clean = False
            for element, value in enumerate(column, first):
                if value != wanted:
                    pointer, index = skin.at("inverseBindMatrices"), 16 * element + place
                    yield issue("ACCESSOR_INVALID_IBM", pointer, index=index, component=place, value=value)
    if is_clean:
        asset.resources.found["affine", accessor] = True
