"""The probe that calls GLSL, and the way to the cases, which stand in a module beside the tests."""

from __future__ import annotations

import sys
from pathlib import Path

import moderngl
import pytest

from gltf_iri.rendering.probe import Probe

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))


@pytest.fixture
def probe(gl_context: moderngl.Context) -> Probe:
    return Probe(gl_context)
