"""The asset object: which glTF the file is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.schema.version import KNOWN, version_key

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def version_is_known(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """The version is one that there is, and the least version that the file asks for is not above it."""
    version, minimum = entry.get("version"), entry.get("minVersion")
    if version is None:
        return
    if minimum is not None and version_key(minimum) > version_key(version):
        code = "ASSET_MIN_VERSION_GREATER_THAN_VERSION"
        yield issue(code, entry.at("minVersion"), minimum=minimum, version=version)
    (major, minor), (known_major, known_minor) = version_key(version), version_key(KNOWN)
    if major != known_major:
        yield issue("UNKNOWN_ASSET_MAJOR_VERSION", entry.at("version"), version=version.partition(".")[0])
    elif minor > known_minor:
        yield issue("UNKNOWN_ASSET_MINOR_VERSION", entry.at("version"), version=version.partition(".")[2])


RULES: Rules = {"asset": (version_is_known,)}
