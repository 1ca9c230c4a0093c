"""Compiled loops: where their machine code is kept, and what is said where numba does not load."""

from __future__ import annotations

import importlib.util
import os
import shutil
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


def test_machine_code_is_kept_apart_for_every_state_of_what_it_inlines(tmp_path: Path) -> None:
    """numba by itself looks at a loop's own file only, and would go on with the old code of another."""
    numba = pytest.importorskip("numba")
    chosen, places = numba.config.CACHE_DIR, []
    shutil.copy(Path(__file__).parents[2] / "gltf_iri" / "compiled" / "loops.py", tmp_path)
    for state in ("FACTOR = 1.0\n", "FACTOR = 2.0\n", "FACTOR = 1.0\n"):
        (tmp_path / "inlined.py").write_text(state, encoding="utf-8")
        spec = importlib.util.spec_from_file_location("loops", tmp_path / "loops.py")
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        places.append(module.loop(lambda x: x).stats.cache_path)
    assert places[0] == places[2] != places[1]
    assert all(str(tmp_path) in place for place in places)
    assert chosen == numba.config.CACHE_DIR
