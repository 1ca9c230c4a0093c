"""Which files a user means, by names, folders, patterns and a dash."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from gltf_iri.errors import UsageError
from gltf_iri.validation.find import find_files


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name in ("b.gltf", "a.GLB", "notes.md", "sub/c.glb", "sub/deep/d.gltf", "z/e.gltf"):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("{}")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_folder_means_the_assets_in_it_and_below_in_one_order(tree: Path) -> None:
    assert find_files(["."]).files == [
        "./a.GLB",
        "./b.gltf",
        "./sub/c.glb",
        "./sub/deep/d.gltf",
        "./z/e.gltf",
    ]


def test_a_named_file_is_taken_whatever_its_ending(tree: Path) -> None:
    assert find_files(["notes.md"]).files == ["notes.md"]


def test_no_file_comes_twice_by_whatever_name_it_is_met(tree: Path) -> None:
    (tree / "link.gltf").symlink_to(tree / "b.gltf")
    (tree / "mirror").symlink_to(tree / "sub", target_is_directory=True)
    named = [
        "b.gltf",
        "./b.gltf",
        str(tree / "b.gltf"),
        "link.gltf",
        "sub",
        "mirror",
        "sub/deep",
        "sub/c.glb",
    ]
    assert find_files([*named, "-", "-"]).files == ["b.gltf", "sub/c.glb", "sub/deep/d.gltf", "-"]


@pytest.mark.parametrize(
    ("pattern", "files"),
    [
        ("*.gltf", ["b.gltf"]),
        ("**/*.gl*", ["b.gltf", "sub/c.glb", "sub/deep/d.gltf", "z/e.gltf"]),
        ("s?b/*.glb", ["sub/c.glb"]),
        ("[sz]*", ["sub/c.glb", "sub/deep/d.gltf", "z/e.gltf"]),
        ("**", ["a.GLB", "b.gltf", "sub/c.glb", "sub/deep/d.gltf", "z/e.gltf"]),
    ],
)
def test_patterns_that_the_shell_left_alone_are_resolved(tree: Path, pattern: str, files: list[str]) -> None:
    assert [str(Path(file)) for file in find_files([pattern]).files] == files


def test_an_absolute_pattern_finds_absolute_files(tree: Path) -> None:
    assert find_files([f"{tree}/sub/*.glb"]).files == [f"{tree}/sub/c.glb"]


def test_a_file_whose_name_looks_like_a_pattern_is_itself(tree: Path) -> None:
    (tree / "b[1].gltf").write_text("{}")
    assert find_files(["b[1].gltf"]).files == ["b[1].gltf"]


def test_loops_of_links_end(tree: Path) -> None:
    (tree / "sub" / "up").symlink_to(tree, target_is_directory=True)
    (tree / "self.gltf").symlink_to("self.gltf")
    found = find_files(["sub", "**/*.gltf", "."])
    assert [Path(file).name for file in found.files] == ["c.glb", "d.gltf", "b.gltf", "e.gltf", "a.GLB"]


def test_what_is_no_file_is_passed_over_and_named(tree: Path) -> None:
    (tree / "broken.gltf").symlink_to("nowhere")
    os.mkfifo(tree / "pipe.glb")
    (tree / "folder.gltf").mkdir()
    found = find_files(["."])
    assert len(found.files) == 5
    assert [told.partition(":")[0] for told in found.passed_over] == ["./broken.gltf", "./pipe.glb"]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("missing.gltf", "missing.gltf does not exist."),
        ("*.obj", "Nothing matches *.obj."),
        ("b.gltf/c", "b.gltf/c cannot be read: Not a directory."),
        ("a**b", "Nothing matches a**b."),
        ("pipe", "pipe is not a regular file; '-' reads standard input."),
        ("/dev/null", "/dev/null is not a regular file; '-' reads standard input."),
        ("empty", "There is no .gltf or .glb file in empty."),
        ("zero\0byte", "'zero\\x00byte' is not the name of a file."),
    ],
)
def test_what_cannot_be_meant_is_refused_in_a_sentence(tree: Path, name: str, told: str) -> None:
    (tree / "empty").mkdir()
    os.mkfifo(tree / "pipe")
    with pytest.raises(UsageError) as refused:
        find_files([name])
    assert str(refused.value) == told


def test_an_endless_name_is_cut_in_its_refusal(tree: Path) -> None:
    with pytest.raises(UsageError) as refused:
        find_files(["x" * 100_000])
    assert len(str(refused.value)) < 400
