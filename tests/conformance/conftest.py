"""The committed vectors."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))

VECTORS = Path(__file__).resolve().parents[2] / "spec" / "vectors"


@pytest.fixture(scope="session")
def folder() -> Path:
    return VECTORS


@pytest.fixture(scope="session")
def bragg() -> dict[str, Any]:
    found: dict[str, Any] = json.loads((VECTORS / "ext_materials_bragg.json").read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="session")
def khr() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(
        (VECTORS / "khr_materials_iridescence.json").read_text(encoding="utf-8")
    )
    return found
