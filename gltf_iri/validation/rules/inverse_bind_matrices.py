"""The inverse bind matrices of skins: their format, and one for each joint (§3.7.3)."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import INVERSE_BIND_MATRIX_FORMATS
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.primitives import accessor_format
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def _matrices(skin: Entry, asset: Asset) -> Iterator[Issue]:
    matrices = asset.get("accessors", skin.get("inverseBindMatrices"))
    if matrices is None:
        return
    pointer, given = skin.at("inverseBindMatrices"), accessor_format(matrices)
    if given not in INVERSE_BIND_MATRIX_FORMATS:
        allowed = ", ".join(INVERSE_BIND_MATRIX_FORMATS)
        yield issue("SKIN_IBM_INVALID_FORMAT", pointer, format=given, allowed=allowed)
    view = asset.get("bufferViews", matrices.get("bufferView"))
    if view is not None and "byteStride" in view:
        yield issue("SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", pointer)
    # A joint that does not exist counts: its matrix stands at its place.
    count, joints = matrices.get("count", 0), len(skin.get("joints", ()))
    if count < joints:
        yield issue("INVALID_IBM_ACCESSOR_COUNT", pointer, count=count, joints=joints)


RULES: Rules = {"skin": (_matrices,)}
