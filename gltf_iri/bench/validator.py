"""Workload `validator`: what a verdict takes, beside the Khronos validator where Node.js and it are there.

Whole processes, from the call to the exit code, each once a round in turn; and ten thousand small files, by
one process and by several.
"""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.validation.khronos import find_khronos
from gltf_iri.validation.many.many import validate_many
from gltf_iri.validation.options import Options
from gltf_iri.whole_files import write_whole

__all__ = ["SMALL_FILES", "VALIDATOR_ROUNDS", "ManyRow", "ProcessRow", "measure_many", "measure_processes"]

VALIDATOR_ROUNDS: Final = 15
SMALL_FILES: Final = 10_000
_MANY_VERTICES: Final = 1_000_000


@dataclass(frozen=True, slots=True)
class ProcessRow:
    """One file: milliseconds of a whole process of ours and of theirs, None where it is not there."""

    file: str
    size_bytes: int
    ms: float
    khronos_ms: float | None
    workload: str = "validator"

    @property
    def ratio(self) -> float | None:
        """Our time over theirs."""
        return None if self.khronos_ms is None else self.ms / self.khronos_ms


@dataclass(frozen=True, slots=True)
class ManyRow:
    """Many small files at once: how many a second."""

    files: int
    jobs: int
    files_per_s: float
    workload: str = "validator"


def measure_processes(
    rounds: int, advance: Callable[[], None] = lambda: None
) -> tuple[list[ProcessRow], str]:
    """Time whole processes on a triangle and on a million vertices; returns also why theirs is left out."""
    reason, theirs = "", None
    try:
        theirs = find_khronos()
    except MissingCapabilityError as error:
        reason = str(error)
    rows = []
    # Bytecode is kept, as it is for every user after the first call.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    with tempfile.TemporaryDirectory() as folder:
        for name, data in {"triangle.gltf": _triangle(), "million-vertices.glb": _million()}.items():
            path = Path(folder) / name
            write_whole({path: data})
            command = [sys.executable, "-m", "gltf_iri", "validate", "--json", str(path)]
            runs: list[Callable[[], object]] = [
                partial(subprocess.run, command, capture_output=True, env=environment, check=True)
            ]
            if theirs is not None:
                runs.append(partial(theirs.judge, data, name, None, Options()))
            for run in runs:
                run()
            ms = [ns / 1e6 for ns in interleaved_ns(runs, rounds, advance)]
            rows.append(ProcessRow(name, len(data), ms[0], ms[1] if theirs is not None else None))
    return rows, reason


def measure_many(jobs: int, files: int = SMALL_FILES) -> ManyRow:
    """Time `files` triangles by so many processes, from the first path to the last report."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.gltf" for number in range(files)]
        data = _triangle()
        for path in paths:
            write_whole({path: data})
        begun = time.perf_counter()
        reports = sum(1 for _ in validate_many(map(str, paths), Options(), jobs=jobs))
        seconds = time.perf_counter() - begun
    return ManyRow(reports, jobs, reports / seconds)


def _triangle() -> bytes:
    positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    uri = f"data:application/octet-stream;base64,{b64encode(positions).decode('ascii')}"
    return json.dumps(_mesh(3, len(positions), [0, 0, 0], [1, 1, 0], {"uri": uri})).encode()


def _million() -> bytes:
    """Return a GLB of a million points without a fault: the time goes into looking at their numbers."""
    positions = np.random.default_rng(1).random((_MANY_VERTICES, 3), np.float32)
    low, high = positions.min(axis=0).tolist(), positions.max(axis=0).tolist()
    text = json.dumps(_mesh(_MANY_VERTICES, positions.nbytes, low, high, {})).encode()
    text += b" " * (-len(text) % 4)
    header = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + positions.nbytes)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", positions.nbytes, b"BIN\0")
    return header + chunks + positions.tobytes()


def _mesh(count: int, size: int, low: list[float], high: list[float], more: dict[str, Any]) -> dict[str, Any]:
    position = {
        "bufferView": 0,
        "componentType": 5126,
        "count": count,
        "type": "VEC3",
        "min": low,
        "max": high,
    }
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 4 if count == 3 else 0}]}],
        "accessors": [position],
        "bufferViews": [{"buffer": 0, "byteLength": size, "target": 34962}],
        "buffers": [{"byteLength": size, **more}],
    }
