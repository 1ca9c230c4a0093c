"""Compiled loops where numba is installed and does not load, as it does not beside a numpy newer than it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("failure", ["ImportError('wants an older numpy')", "OSError('no LLVM')"])
def test_a_numba_that_does_not_load_is_told_in_one_sentence(failure: str, tmp_path: Path) -> None:
    (tmp_path / "numba.py").write_text(f"raise {failure}\n", encoding="utf-8")
    root = str(Path(__file__).parents[2])
    call = [sys.executable, "-m", "gltf_iri", "evaluate", "--method", "fourier", "--backend", "numba"]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join((str(tmp_path), root))}
    done = subprocess.run(call, env=environment, capture_output=True, text=True, encoding="utf-8")
    assert done.returncode == 3
    assert done.stderr.count("\n") == 1
    assert failure.split("'")[1] in done.stderr
    assert done.stdout == ""
