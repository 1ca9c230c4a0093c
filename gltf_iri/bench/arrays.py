"""Workload `arrays`: colours of a .npy file of films, as `gltf-iri evaluate --in --out` computes them.

Each way runs in a process of its own, so that its memory is its own. The converged truth and the brute force
(471 wavelengths, a nanometre apart) run on fewer rows of the same films, with as many threads.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.arrays.film_rows import ROWS_AT_ONCE
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.whole_files import write_whole

__all__ = ["ARRAY_COUNT", "ARRAY_STEPS", "ArrayRow", "measure_arrays"]

ARRAY_COUNT: Final = 4_000_000

_FILM_IOR: Final = 1.33
_BASE_IOR: Final = 1.5
_THICKNESS_NM: Final = (100.0, 800.0)
_BYTES_A_ROW: Final = 2 * 4 + 3 * 4  # of films and colours

_BRUTE_FORCE: Final = "spectral-grid"
_ON_FEW: Final = (("spectral",), (_BRUTE_FORCE, "--set", "samples=471"))
_FEW: Final = 1 << 15
_JUDGED: Final = 4096
_WAYS: Final = (
    ("--budget", "0.5"),
    ("--budget", "0.05"),
    ("--method", "fourier"),
)
ARRAY_STEPS: Final = len(_WAYS) + len(_ON_FEW) + 2


@dataclass(frozen=True, slots=True)
class ArrayRow:
    """One way; times are of the clock, with `threads` threads, what is read and written included.

    asked : its options. planning_s : of reading spans, choosing and filling tables; not in `seconds`.
    ratio : ns over those of the brute force in numpy.
    anonymous_bytes : the most memory of its own that the process held, libraries included.
    delta_e_mean, delta_e_p95, max_abs : against the converged truth, on rows spread over the file.
    """

    workload: str
    method: str
    asked: str
    backend: str
    threads: int
    rows: int
    ns_per_eval: float
    seconds: float
    planning_s: float
    ratio: float
    anonymous_bytes: int | None
    max_abs: float
    delta_e_mean: float
    delta_e_p95: float

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)


def measure_arrays(
    count: int = ARRAY_COUNT,
    *,
    few: int = _FEW,
    ways: Sequence[tuple[str, str]] = _WAYS,
    advance: Callable[[], None] = lambda: None,
) -> list[ArrayRow]:
    """Return a row for each way, and for the truth and brute force; advances ARRAY_STEPS times.

    The files lie in a temporary folder; raises UsageError where its disk has no room for them.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        needed, free = _BYTES_A_ROW * count, shutil.disk_usage(folder).free
        if needed > free:
            raise UsageError(
                f"{count:,} films and their colours take {needed / 1e9:.1f} GB in {folder.parent}, which has "
                f"{free / 1e9:.1f}: take a smaller --count, or set TMPDIR to a larger disk."
            )
        runs = [(("--method", *options), min(few, count)) for options in _ON_FEW]
        runs += [(way, count) for way in ways]
        rows = []
        for options, of in runs:
            films = folder / f"{of}.npy"
            if not films.exists():
                write_whole({films: partial(_write_films, count=of)})
                advance()
            rows.append(_run(films, folder / "colours.npy", options))
            advance()
    brute_ns = next(row.ns_per_eval for row in rows if row.method.startswith(_BRUTE_FORCE))
    return [replace(row, ratio=row.ns_per_eval / brute_ns) for row in rows]


def _write_films(path: Path, count: int) -> None:
    """Write random films, cosine and thickness, both uniform; fewer begin more of them."""
    rows = np.lib.format.open_memmap(path, mode="w+", dtype=np.float32, shape=(count, 2))
    low_nm, high_nm = _THICKNESS_NM
    for start in range(0, count, ROWS_AT_ONCE):
        block = rows[start : start + ROWS_AT_ONCE]
        drawn = np.random.default_rng(start).random((len(block), 2))
        block[:, 0], block[:, 1] = drawn[:, 0], low_nm + (high_nm - low_nm) * drawn[:, 1]
    rows.flush()


def _run(films: Path, colours: Path, options: Sequence[str]) -> ArrayRow:
    """Evaluate in another process; raises UsageError with its words where it fails."""
    constants = ("--film-ior", str(_FILM_IOR), "--base-ior", str(_BASE_IOR), "--white", WHITE, "--json")
    command = [sys.executable, "-m", "gltf_iri", "evaluate", "--in", str(films), "--out", str(colours)]
    done = subprocess.run(
        [*command, *options, *constants], capture_output=True, encoding="utf-8", check=False
    )
    if done.returncode != 0:
        raise UsageError(f"evaluate {' '.join(options)} failed: {done.stderr.strip().splitlines()[-1]}")
    told = json.loads(done.stdout)
    max_abs, delta_e = _errors(films, colours)
    return ArrayRow(
        workload="arrays",
        method=told["way"],
        asked=" ".join(options),
        backend=told["backend"],
        threads=told["threads"],
        rows=told["rows"],
        ns_per_eval=told["ns_per_colour"],
        seconds=told["seconds"],
        planning_s=told["planning_s"],
        ratio=np.nan,
        anonymous_bytes=told["anonymous_bytes"],
        max_abs=max_abs,
        delta_e_mean=float(delta_e.mean()),
        delta_e_p95=float(np.percentile(delta_e, 95)),
    )


def _errors(films: Path, colours: Path) -> tuple[float, NDArray[np.float64]]:
    """Return max |colour − truth| and ΔE of rows spread over the file."""
    rows, found = (np.lib.format.open_memmap(path, mode="r") for path in (films, colours))
    step = -(-len(rows) // _JUDGED)
    cosine, thickness_nm = rows[::step].T.astype(np.float64)
    film = Film.of(cosine, thickness_nm, _FILM_IOR, base_from_ior(_BASE_IOR))
    truth = evaluate("spectral", film, white=WHITE, backend="numpy").rgb
    mine = found[::step].astype(np.float64)
    return float(np.abs(mine - truth).max()), delta_e_2000(mine, truth)
