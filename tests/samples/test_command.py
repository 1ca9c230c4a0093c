"""`gltf-iri samples`: what it prints, where it writes, how it refuses."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from gltf_iri.cli.main import run
from gltf_iri.samples.collection import collection_files

ROOT = Path(__file__).resolve().parents[2]


def test_json_lists_every_file_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "new"
    assert run(["samples", str(folder), "--json"]) == 0
    written = json.loads(capsys.readouterr().out)["written"]
    assert written == [str(folder / name) for name in collection_files()]
    assert all(Path(path).is_file() for path in written)


def test_default_folder_is_called_samples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["samples"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "samples/index.json"
    assert (tmp_path / "samples" / "index.json").is_file()


def test_folder_of_somebody_else_is_a_wrong_call(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "diary.txt").write_text("mine")
    assert run(["samples", str(tmp_path)]) == 2
    assert "holds other files" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["diary.txt"]


def test_a_full_disk_is_one_sentence_and_leaves_no_half_of_a_file(tmp_path: Path) -> None:
    # The largest file that this process may write is 8 KiB.
    command = 'ulimit -f 8; exec "$0" -m gltf_iri samples "$1"'
    done = subprocess.run(
        ["bash", "-c", command, sys.executable, tmp_path],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert (
        done.stderr == f"gltf-iri: {tmp_path} cannot be written to (File too large): name another folder.\n"
    )
    whole = collection_files()
    for path in (path for path in tmp_path.rglob("*") if path.is_file()):
        assert path.read_bytes() == whole[path.relative_to(tmp_path).as_posix()]
