"""Small assets from dicts or bytes, and what the validator says of them."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from gltf_iri.validation.options import Options
from gltf_iri.validation.report import Report
from gltf_iri.validation.validate import validate

if TYPE_CHECKING:
    from judging import Codes, Judge

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))


def _judge(asset: dict[str, Any] | str | bytes, folder: Path | None = None, **options: Any) -> Report:
    """Check a glTF object (its "asset" filled in), JSON text, or the bytes of a file."""
    if isinstance(asset, dict):
        asset = json.dumps({"asset": {"version": "2.0"}, **asset})
    data = asset.encode() if isinstance(asset, str) else asset
    return validate(data, folder=folder, options=Options(**{"raises": True, **options}))


@pytest.fixture
def judge() -> Judge:
    """Return a function that checks an asset and returns the report; keywords are those of Options."""
    return _judge


@pytest.fixture
def codes() -> Codes:
    """Return a function that checks an asset and returns the set of (code, pointer or offset).

    UNUSED_OBJECT is left out unless `unused` is true: small assets for one rule hardly use what they hold.
    """

    def codes_of(
        asset: dict[str, Any] | str | bytes, *, unused: bool = False, **options: Any
    ) -> set[tuple[str, str | int | None]]:
        return {
            (issue.code, issue.pointer if issue.offset is None else issue.offset)
            for issue in _judge(asset, **options).issues
            if unused or issue.code != "UNUSED_OBJECT"
        }

    return codes_of
