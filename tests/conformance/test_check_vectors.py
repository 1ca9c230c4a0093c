"""The checker stands alone, passes what is right, finds what is not, and says so in a sentence."""

from __future__ import annotations

import ast
import copy
import json
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.colour.difference import delta_e_2000


def run(folder: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-I", folder / "check_vectors.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def write(path: Path, content: Any) -> Path:
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


@pytest.fixture
def few(bragg: dict[str, Any], tmp_path: Path) -> tuple[Path, list[dict[str, Any]]]:
    """Thirty rows, and the right answers to them."""
    short = {**bragg, "rows": bragg["rows"][:30]}
    return write(tmp_path / "few.json", short), [copy.deepcopy(row["output"]) for row in short["rows"]]


def test_the_checker_is_short_and_wants_numpy_only(folder: Path) -> None:
    text = (folder / "check_vectors.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 60
    imports = [node for node in ast.walk(ast.parse(text)) if isinstance(node, (ast.Import, ast.ImportFrom))]
    names = {alias.name if isinstance(n, ast.Import) else n.module for n in imports for alias in n.names}
    assert names == {"json", "sys", "pathlib", "numpy"}


@pytest.mark.parametrize("name", ["ext_materials_bragg.json", "khr_materials_iridescence.json"])
def test_right_answers_pass(name: str, folder: Path, tmp_path: Path) -> None:
    rows = json.loads((folder / name).read_text(encoding="utf-8"))["rows"]
    answers = write(tmp_path / "answers.json", {"rows": [row["output"] for row in rows]})
    done = run(folder, folder / name, answers)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == len(rows[0]["output"])
    assert all("max abs error 0," in line and "no rows fail" in line for line in done.stdout.splitlines())


def test_one_wrong_number_fails_and_is_found(folder: Path, few: Any, tmp_path: Path) -> None:
    vectors, answers = few
    answers[17]["entering"][1] += 2e-5
    done = run(folder, vectors, write(tmp_path / "a.json", answers))
    assert done.returncode == 1
    (line,) = [line for line in done.stdout.splitlines() if "no rows fail" not in line]
    assert line.startswith("entering: ")
    assert "max abs error 2e-05" in line
    assert line.endswith("worst row 17, 1 rows fail")
    assert run(folder, vectors, tmp_path / "a.json", "--quantity", "brdf").returncode == 0


def test_what_is_no_number_fails(folder: Path, few: Any, tmp_path: Path) -> None:
    vectors, answers = few
    answers[3]["brdf"] = [float("nan")] * 3
    done = run(folder, vectors, write(tmp_path / "a.json", answers))
    assert done.returncode == 1
    assert "worst row 3, 1 rows fail" in done.stdout


def test_rows_without_an_answer_are_not_counted(folder: Path, few: Any, tmp_path: Path) -> None:
    vectors, answers = few
    some = [answer if i in (1, 4) else {} for i, answer in enumerate(answers)]
    done = run(folder, vectors, write(tmp_path / "a.json", some))
    assert done.returncode == 0
    assert all(": 2 rows" in line for line in done.stdout.splitlines())


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ([{}], "1 answers to 30 rows"),
        ([{"colour": 1}] * 30, "to quantities []"),
        ([{"brdf": [0.0, 0.0]}] * 30, "another shape; rows: [1, 2,"),
        ([{"brdf": None}] * 30, "another shape; rows: [1, 2,"),
        (3, "Not vectors and answers to them: "),
        ({"answers": []}, "Not vectors and answers to them: 'rows'"),
        ([{"brdf": "red"}] * 30, "could not convert"),
    ],
    ids=str,
)
def test_what_is_no_answer_gets_a_sentence(
    content: Any, told: str, folder: Path, few: Any, tmp_path: Path
) -> None:
    done = run(folder, few[0], write(tmp_path / "a.json", content))
    assert done.returncode == 1
    assert told in done.stderr
    assert "Traceback" not in done.stderr


def test_a_file_that_is_missing_gets_a_sentence(folder: Path, few: Any) -> None:
    for arguments in ((), (few[0],), (few[0], "nowhere.json")):
        done = run(folder, *arguments)
        assert done.returncode == 1
        assert done.stderr.startswith("Hold answers to test vectors: python check_vectors.py")
        assert "Traceback" not in done.stderr


def test_its_colour_difference_is_colour_sciences(folder: Path) -> None:
    g = np.random.default_rng(0)
    a = g.uniform(-0.1, 1.2, (5_000, 3))
    b = a + g.normal(0.0, 0.1, a.shape)
    b[:4] = [[0.5] * 3, [0.0] * 3, [-1.0] * 3, a[3]]
    a[:2] = [[0.3] * 3, [0.0] * 3]
    own = runpy.run_path(str(folder / "check_vectors.py"))["ciede2000"](a, b)
    # colour-science rounds the two constants of CIELAB.
    assert np.abs(own - delta_e_2000(a, b)).max() <= 1e-6
