"""Prepared environments: kept while they are used, given back when many others were."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from gltf_iri.rendering import image_light
from gltf_iri.scene.environment import white


@pytest.fixture
def prepared(monkeypatch):
    """Prepare nothing; tell which environments are held."""
    held = {}

    def prepare(_, environment):
        held[id(environment)] = environment
        names = dict.fromkeys(("sharp", "rest", "lamps", "layers"))
        return SimpleNamespace(**names, release=lambda: held.pop(id(environment)))

    monkeypatch.setattr(image_light, "prepare_environment", prepare)
    monkeypatch.setattr(image_light, "compute_dfg_table", lambda _: SimpleNamespace(release=lambda: None))
    return held


def test_the_environments_used_last_are_kept(prepared):
    store = image_light.ImageLightStore(None)
    often, *others = (white() for _ in range(30))
    for other in others:
        store.textures(often)
        store.textures(other)
    assert len(prepared) < 10
    assert id(often) in prepared
    assert id(others[-1]) in prepared
    store.release()
    assert prepared == {}
