"""The probe that calls GLSL, and the films; what they are made of stands in a module beside the tests."""

from __future__ import annotations

import sys
from pathlib import Path

import moderngl
import pytest

from gltf_iri.evaluation.film import Film
from gltf_iri.rendering.probe import Probe

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))


@pytest.fixture
def probe(gl_context: moderngl.Context) -> Probe:
    return Probe(gl_context)


@pytest.fixture(params=["random_films", "edge_films", "branch_films"])
def films(request: pytest.FixtureRequest) -> Film:
    import single_precision

    film: Film = getattr(single_precision, request.param)()
    return film
