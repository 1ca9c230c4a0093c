"""What the validator keeps of a file, and that it leaves the process as it was."""

from __future__ import annotations

import gc
import json

import pytest

from gltf_iri.validation.collector import Collector
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.options import Options
from gltf_iri.validation.pointers.target import Unresolved, resolve
from gltf_iri.validation.schema.walk import Walk
from gltf_iri.validation.validate import validate

FILE = {"asset": {"version": "2.0"}, "nodes": [{}, {}]}


@pytest.mark.parametrize("is_on", [True, False])
def test_garbage_is_collected_afterwards_as_it_was_before(is_on: bool) -> None:
    try:
        (gc.enable if is_on else gc.disable)()
        validate(json.dumps(FILE).encode())
        validate(b"no JSON")
        assert gc.isenabled() is is_on
    finally:
        gc.enable()


def test_no_object_of_a_file_waits_to_be_found_as_garbage() -> None:
    stated = {**FILE, "nodes": [{"children": [1]}, {"mesh": 0}], "meshes": [{"primitives": []}]}
    gc.collect()
    gc.disable()
    try:
        before = sum(type(thing) is Entry for thing in gc.get_objects())
        validate(json.dumps(stated).encode())
        assert sum(type(thing) is Entry for thing in gc.get_objects()) == before
    finally:
        gc.enable()


def test_objects_without_extensions_share_one_empty_mapping() -> None:
    film = {"extensions": {"KHR_materials_iridescence": {}}}
    stated = {**FILE, "extensionsUsed": ["KHR_materials_iridescence"], "materials": [film, {}]}
    root = Walk(Collector(Options())).root(stated)
    one, other = root["nodes"]
    carrier, bare = root["materials"]
    assert one.extensions is other.extensions is bare.extensions
    assert list(carrier.extensions) == ["KHR_materials_iridescence"]
    assert not bare.extensions


def test_a_pointer_to_nothing_keeps_no_frames_alive() -> None:
    root = Walk(Collector(Options())).root(FILE)
    found = resolve(root, "/nodes/7/translation")
    assert isinstance(found, Unresolved)
    assert found.__traceback__ is None
