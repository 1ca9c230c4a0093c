"""Real assets and the validator's own cases, where they lie beside the checkout."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.asset.document import Document, open_document
from gltf_iri.errors import AssetError, UsageError

# These come without their .bin file: they open, but their geometry cannot be read.
WITHOUT_BUFFER = {"CompareIridescence", "IridescenceMetallicSpheres"}


def gltf_files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*.gl*") if path.suffix in (".gltf", ".glb"))


def read_all(document: Document) -> None:
    for index in range(len(document.json.get("accessors", []))):
        document.accessor(index)
    for index in range(len(document.json.get("textures", []))):
        document.image(document.texture(index).image)
    document.to_pygltflib()


def test_every_real_asset_is_read_whole_and_without_notes(shared_dir: Path) -> None:
    paths = gltf_files(shared_dir / "assets")
    assert len(paths) > 15
    for path in paths:
        document = open_document(path)
        assert document.notes == []
        if path.stem in WITHOUT_BUFFER:
            with pytest.raises(AssetError, match="is missing") as caught:
                document.accessor(0)
            assert caught.value.pointer == "/buffers/0/uri"
        else:
            read_all(document)
            assert document.notes == []


def test_binary_and_text_form_of_an_asset_agree(shared_dir: Path) -> None:
    folder = shared_dir / "assets" / "iridescence" / "IridescenceSuzanne"
    text = open_document(folder / "glTF" / "IridescenceSuzanne.gltf")
    binary = open_document(folder / "glTF-Binary" / "IridescenceSuzanne.glb")
    for index in range(len(text.json["accessors"])):
        np.testing.assert_array_equal(text.accessor(index), binary.accessor(index))
    for index in range(len(text.json["images"])):
        np.testing.assert_array_equal(text.image(index).pixels, binary.image(index).pixels)


def test_interleaved_and_plain_boxes_have_the_same_vertices(shared_dir: Path) -> None:
    def corners(name: str) -> set[tuple[float, ...]]:
        document = open_document(shared_dir / "assets" / "plain" / name / f"{name}.glb")
        attributes = document.json["meshes"][0]["primitives"][0]["attributes"]
        joined = np.hstack(
            [document.accessor(attributes["POSITION"]), document.accessor(attributes["NORMAL"])]
        )
        return {tuple(row.tolist()) for row in joined}

    assert corners("Box") == corners("BoxInterleaved")


def test_declared_bounds_hold_for_every_real_accessor(shared_dir: Path) -> None:
    for path in gltf_files(shared_dir / "assets"):
        if path.stem in WITHOUT_BUFFER:
            continue
        document = open_document(path)
        for index, description in enumerate(document.json["accessors"]):
            values = document.accessor(index)
            if "min" in description and not description.get("normalized") and values.ndim == 2:
                # JSON carries the float32 bounds in decimal, with six digits or more.
                np.testing.assert_allclose(values.min(axis=0), description["min"], rtol=1e-5, atol=1e-5)
                np.testing.assert_allclose(values.max(axis=0), description["max"], rtol=1e-5, atol=1e-5)


def test_the_validators_cases_open_or_fail_with_a_sentence(shared_dir: Path) -> None:
    corpus = shared_dir / "validator-corpus"
    paths = [path for path in gltf_files(corpus) if path.with_name(f"{path.name}.report.json").exists()]
    assert len(paths) > 150
    for path in paths:
        report = json.loads(path.with_name(f"{path.name}.report.json").read_text(encoding="utf-8"))
        is_sound = report["issues"]["numErrors"] == 0
        try:
            document = open_document(path)
        except (AssetError, UsageError) as error:
            assert not is_sound, f"{path} is sound, but: {error}"
            assert "\n" not in str(error)
            continue
        try:
            read_all(document)
        except AssetError as error:
            assert error.file == path
            assert error.pointer is not None


def test_damaged_copies_of_a_real_file_give_nothing_but_asset_errors(
    shared_dir: Path, tmp_path: Path
) -> None:
    source = (shared_dir / "assets" / "plain" / "BoxInterleaved" / "BoxInterleaved.glb").read_bytes()
    path = tmp_path / "damaged.glb"
    generator = np.random.default_rng(5)
    outcomes = set()
    for _ in range(300):
        data = bytearray(source)
        for position in generator.integers(0, len(data), 3):
            data[position] = generator.integers(0, 256)
        struct.pack_into("<I", data, 8, len(data))
        path.write_bytes(data)
        try:
            read_all(open_document(path))
            outcomes.add("read")
        except AssetError:
            outcomes.add("refused")
    assert outcomes == {"read", "refused"}
