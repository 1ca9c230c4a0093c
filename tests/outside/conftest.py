"""Mitsuba 3 for the tests of this folder, where it is installed: pip install 'gltf-iri[mitsuba]'.

GLTF_IRI_MITSUBA_VARIANT chooses another spectral variant than the interpreter, such as llvm_ad_spectral.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import ModuleType

import pytest

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))

VARIANT = "GLTF_IRI_MITSUBA_VARIANT"


@pytest.fixture(scope="session")
def mitsuba() -> ModuleType:
    """Mitsuba with its variant chosen and the plugins of this folder known to it."""
    module: ModuleType = pytest.importorskip(
        "mitsuba", reason="Mitsuba is not installed: pip install 'gltf-iri[mitsuba]'"
    )
    module.set_variant(os.environ.get(VARIANT, "scalar_spectral"))
    from mitsuba_plugins import register_plugins

    register_plugins()
    return module
