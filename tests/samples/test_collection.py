"""The collection in the checkout is what the code writes; writing it loses nothing of anybody else's."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from gltf_iri.errors import UsageError
from gltf_iri.samples.collection import NAMES, collection_files, write_samples

COMMITTED = Path(__file__).resolve().parents[2] / "samples"
LARGEST_SAMPLE = 200_000  # bytes: small enough to be read in an editor and sent in a mail


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()
    }


def test_checkout_holds_what_the_code_writes() -> None:
    expected = dict(collection_files())
    present = contents(COMMITTED)
    assert sorted(present) == sorted(expected)
    stale = [name for name in expected if present[name] != expected[name]]
    assert stale == [], "run `make samples`"


def test_each_sample_is_small_and_explains_itself() -> None:
    files = collection_files()
    for name in NAMES:
        own = {path: content for path, content in files.items() if path.startswith(f"{name}/")}
        assert sum(map(len, own.values())) < LARGEST_SAMPLE
        readme = own[f"{name}/README.md"].decode()
        assert "## What to look for" in readme
        assert "## Numbers" in readme


def test_index_lists_every_sample_and_its_file() -> None:
    files = collection_files()
    rows = json.loads(files["index.json"])["samples"]
    assert [row["name"] for row in rows] == list(NAMES)
    assert all(row["file"] in files for row in rows)


def test_both_containers_are_among_the_samples() -> None:
    suffixes = {Path(row["file"]).suffix for row in json.loads(collection_files()["index.json"])["samples"]}
    assert suffixes == {".glb", ".gltf"}


def test_writing_twice_gives_the_same_files(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "folder"
    written = write_samples(folder)
    once = contents(folder)
    assert sorted(path.relative_to(folder).as_posix() for path in written) == sorted(once)
    (folder / "pearl" / "README.md").write_text("spoiled")
    write_samples(folder)
    assert contents(folder) == once


def test_a_folder_with_other_files_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "index.json").write_text('{"my": "own"}')
    with pytest.raises(UsageError, match="holds other files"):
        write_samples(tmp_path)
    assert contents(tmp_path) == {"index.json": b'{"my": "own"}'}


def test_a_file_in_the_folders_place_is_left_alone(tmp_path: Path) -> None:
    taken = tmp_path / "samples"
    taken.write_text("mine")
    with pytest.raises(UsageError, match="not a folder"):
        write_samples(taken)
    assert taken.read_text() == "mine"
