"""Every broken or hostile file ends in one sentence that says where, or in a picture.

cases.json says for each: `says` is part of the sentence, or of a note where the file is `accepted`; `plans`
is part of the plan of an accepted file.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import moderngl
import pytest
from road import walk
from write import FOLDER, files
from wrong.large import LARGE

from gltf_iri.cli.main import run
from gltf_iri.errors import AssetError

HERE = Path(__file__).resolve().parent
CASES: Mapping[str, Mapping[str, Any]] = json.loads((HERE / "cases.json").read_text(encoding="utf-8"))

# A sentence that fills more than some lines of a terminal is none; the file's own name comes on top.
LONGEST_SENTENCE = 300

MOST_ADDRESSES = 2 * 2**30  # bytes; as a limit that the system enforces
MOST_MEMORY = 300 * 2**20  # bytes
MOST_SECONDS = 10  # ends a hang; what a case really takes is printed

every_case = pytest.mark.parametrize("name", CASES)


@pytest.fixture(scope="session")
def place(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return a function from a case's name to its file, which it makes where it is not committed."""
    made: dict[str, Path] = {}

    def find(name: str) -> Path:
        if name not in LARGE:
            return FOLDER / name
        if name not in made:
            folder = tmp_path_factory.mktemp("large") / "asset"
            folder.mkdir()
            LARGE[name](folder / name)
            made[name] = folder / name
        return made[name]

    return find


def test_the_index_knows_every_case() -> None:
    assert set(CASES) == {*files(), *LARGE}
    for case in CASES.values():
        assert ("accepted" in case) + ("pointer" in case) + ("offset" in case) == 1


def test_the_files_are_as_their_script_writes_them() -> None:
    assert {path.name: path.read_bytes() for path in FOLDER.iterdir()} == files()


@every_case
def test_readers_refuse_with_the_place_or_note_what_is_odd(name: str, place: Callable[[str], Path]) -> None:
    case = CASES[name]
    path = place(name)
    if "accepted" in case:
        notes, plans = walk(path)
        assert len(notes) == ("says" in case)
        assert case.get("says", "") in "".join(notes)
        assert case.get("plans", "") in plans
        return
    with pytest.raises(AssetError) as caught:
        walk(path)
    error = caught.value
    assert error.file == path
    assert (error.pointer, error.offset) == (case.get("pointer"), case.get("offset"))
    assert case["says"] in error.what
    assert str(error).isprintable()
    assert len(error.what) < LONGEST_SENTENCE


@every_case
def test_the_command_line_says_one_sentence_and_leaves_nothing_behind(
    name: str,
    place: Callable[[str], Path],
    gl_context: moderngl.Context,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = tmp_path / "out.png"
    call = ["render", str(place(name)), "-o", str(out), "--size", "16x16", "--env", "none"]
    exit_code = run(call)
    lines = capsys.readouterr().err.splitlines()
    if "accepted" in CASES[name]:
        assert exit_code == 0
        assert out.is_file()
        assert all(line.startswith("note: ") for line in lines)
        assert CASES[name].get("says", "") in "\n".join(lines)
        return
    assert exit_code == 1
    assert len(lines) == 1
    assert CASES[name]["says"] in lines[0]
    assert lines[0].endswith(".")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")
def test_memory_stays_bounded(
    place: Callable[[str], Path], record_property: Callable[[str, object], None]
) -> None:
    paths = [str(place(name)) for name in CASES]
    road = [sys.executable, str(HERE / "road.py"), str(MOST_ADDRESSES), str(MOST_SECONDS), *paths]
    # OpenBLAS would reserve address space for each core, and forks must not carry its threads.
    environment = {"OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(HERE.parents[1])}
    done = subprocess.run(road, capture_output=True, text=True, check=True, env=environment)
    costs = [json.loads(line) for line in done.stdout.splitlines()]

    slowest = max(costs, key=lambda cost: cost["seconds"])
    largest = max(costs, key=lambda cost: cost["bytes"])
    record_property(
        "measured",
        f"{len(costs)} hostile files: slowest {slowest['file']} with {slowest['seconds']:.2f} s, "
        f"largest {largest['file']} with {largest['bytes'] / 2**20:.0f} MiB",
    )
    ends = {cost["file"]: cost["end"] for cost in costs}
    assert ends == {name: "accepted" if "accepted" in case else "refused" for name, case in CASES.items()}
    assert largest["bytes"] < MOST_MEMORY
