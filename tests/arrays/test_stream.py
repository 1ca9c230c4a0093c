"""Colours of mapped arrays: what is written, what is refused, and that blocks and threads change nothing."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.arrays import film_rows
from gltf_iri.arrays.film_rows import column_spans, open_rows
from gltf_iri.arrays.stream import check_out, stream_colours
from gltf_iri.errors import UsageError

Float64 = NDArray[np.float64]
TWO = ("cos", "thickness")


def films(count: int, dtype: str = "f4") -> NDArray[Any]:
    g = np.random.default_rng(5)
    return np.stack([g.uniform(0.0, 1.0, count), g.uniform(100.0, 800.0, count)], axis=1).astype(dtype)


def some_colour(block: Float64) -> Float64:
    """Return a colour that depends on every column of its row and on no other row."""
    return np.stack([block[:, 0], np.sin(block[:, 1]), block[:, 0] * block[:, 1]], axis=1)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "films.npy"
    np.save(path, films(1000))
    return path


@pytest.mark.parametrize("dtype", ["f4", "f8", ">f4"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_out_holds_the_colours_row_by_row(tmp_path: Path, dtype: str, order: Any) -> None:
    source, out = tmp_path / "films.npy", tmp_path / "out.npy"
    given = np.array(films(777), dtype=dtype, order=order)
    np.save(source, given)
    stream_colours(open_rows(source, TWO), out, some_colour, rows_at_once=100)
    written = np.load(out)
    expected = some_colour(given.astype(np.float64))
    assert written.dtype == np.dtype(dtype).newbyteorder("=")
    assert written.flags.c_contiguous
    assert np.array_equal(written, expected.astype(written.dtype))


@pytest.mark.parametrize(("threads", "rows_at_once"), [(1, 7), (2, 64), (3, 999), (2, 5000)])
def test_blocks_and_threads_change_nothing(
    source: Path, tmp_path: Path, threads: int, rows_at_once: int
) -> None:
    rows = open_rows(source, TWO)
    advanced: list[None] = []
    stream_colours(
        rows,
        tmp_path / "out.npy",
        some_colour,
        threads=threads,
        rows_at_once=rows_at_once,
        advance=lambda: advanced.append(None),
    )
    assert np.array_equal(
        np.load(tmp_path / "out.npy"), some_colour(np.load(source).astype("f8")).astype("f4")
    )
    assert len(advanced) == -(-1000 // rows_at_once)


def test_a_failure_leaves_no_file_and_the_earlier_one_as_it_was(source: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.npy"
    out.write_bytes(b"earlier")
    calls: list[int] = []

    def fails(block: Float64) -> Float64:
        calls.append(len(block))
        raise UsageError("no colour")

    with pytest.raises(UsageError, match="no colour"):
        stream_colours(open_rows(source, TWO), out, fails, rows_at_once=10)
    assert out.read_bytes() == b"earlier"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["films.npy", "out.npy"]
    assert len(calls) < 20  # of 100 blocks: what follows the failure is not begun


def test_a_disk_without_room_is_told_before_anything_is_computed(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shutil.disk_usage", lambda _: type("Usage", (), {"free": 10})())
    with pytest.raises(UsageError, match="12,000 bytes"):
        stream_colours(open_rows(source, TWO), tmp_path / "out.npy", some_colour)
    assert not (tmp_path / "out.npy").exists()


@pytest.mark.skipif(not hasattr(os, "posix_fallocate"), reason="the system cannot keep room for a file")
def test_a_disk_that_fills_meanwhile_is_told_in_a_sentence(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "posix_fallocate", full)
    with pytest.raises(UsageError, match="No space left"):
        stream_colours(open_rows(source, TWO), tmp_path / "out.npy", some_colour)
    assert [p.name for p in tmp_path.iterdir()] == ["films.npy"]


def test_spans_are_those_of_all_blocks(source: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(film_rows, "ROWS_AT_ONCE", 64)
    spans = column_spans(open_rows(source, TWO), TWO)
    given = np.load(source)
    for c, name in enumerate(TWO):
        assert (spans[name].low, spans[name].high) == (given[:, c].min(), given[:, c].max())


@pytest.mark.parametrize(
    ("column", "value"), [(0, np.nan), (0, 1.5), (0, -0.1), (1, -1.0), (1, np.inf), (1, np.nan)]
)
def test_a_number_out_of_range_is_named_with_its_row(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, column: int, value: float
) -> None:
    monkeypatch.setattr(film_rows, "ROWS_AT_ONCE", 64)
    given = films(300)
    given[201, column] = value
    np.save(tmp_path / "films.npy", given)
    with pytest.raises(UsageError, match=f"Row 201 .* {TWO[column]} = {value:g}"):
        column_spans(open_rows(tmp_path / "films.npy", TWO), TWO)


def raw(header: bytes, body: bytes = b"") -> Callable[[Path], None]:
    """Return what writes a .npy file of version 1 with any header."""

    def write(path: Path) -> None:
        path.write_bytes(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + body)

    return write


class Trap:
    """Ends the test where it is unpickled."""

    def __reduce__(self) -> tuple[Callable[[str], None], tuple[str]]:
        return pytest.fail, ("something was unpickled",)


def saved(array: NDArray[Any]) -> Callable[[Path], None]:
    return lambda path: np.save(path, array, allow_pickle=True)


def archive(path: Path) -> None:
    with path.open("wb") as file:
        np.savez(file, a=np.ones((3, 2)))


WRONG: dict[str, tuple[Callable[[Path], object], str]] = {
    "objects": (saved(np.array([[Trap(), 1.0]], dtype=object)), "no .npy array"),
    "integers": (saved(np.ones((3, 2), dtype=int)), "float32 or float64"),
    "halves": (saved(np.ones((3, 2), dtype="f2")), "float32 or float64"),
    "complex": (saved(np.ones((3, 2), dtype=complex)), "float32 or float64"),
    "fields": (saved(np.ones(3, dtype=[("a", "f4"), ("b", "O")])), "no .npy array"),
    "one axis": (saved(np.ones(3)), "shape"),
    "three columns": (saved(np.ones((3, 3))), "shape"),
    "three axes": (saved(np.ones((3, 2, 1))), "shape"),
    "no rows": (saved(np.ones((0, 2))), "no rows"),
    "nothing": (lambda path: path.write_bytes(b""), "no .npy array"),
    "text": (lambda path: path.write_text("1.0, 2.0"), "no .npy array"),
    "archive": (archive, "no .npy array"),
    "short": (raw(b"{'descr': '<f8', 'fortran_order': False, 'shape': (9, 2)}\n", b"x"), "no .npy array"),
    "endless": (raw(b"{'descr': '<f8', 'fortran_order': False, 'shape': (2**62, 2)}\n"), "no .npy array"),
    "huge": (
        raw(b"{'descr': '<f8', 'fortran_order': False, 'shape': (%d, 2)}\n" % 10**30),
        "no .npy array",
    ),
    "negative": (raw(b"{'descr': '<f8', 'fortran_order': False, 'shape': (-1, 2)}\n"), "no .npy array"),
    "both negative": (
        raw(b"{'descr': '<f8', 'fortran_order': False, 'shape': (-1, -2)}\n", b"x" * 99),
        "shape|no .npy array",
    ),
    "code": (
        raw(b"{'descr': __import__('os'), 'fortran_order': False, 'shape': (1, 2)}\n"),
        "no .npy array",
    ),
    "nested": (raw(b"(" * 9000), "no .npy array"),
    "no header": (raw(b""), "no .npy array"),
}


@pytest.mark.parametrize("name", WRONG)
def test_files_that_hold_no_films_are_refused_in_a_sentence(name: str, tmp_path: Path) -> None:
    write, says = WRONG[name]
    path = tmp_path / "films.npy"
    write(path)
    with pytest.raises(UsageError, match=says) as caught:
        open_rows(path, TWO)
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "none.npy", tmp_path):
        with pytest.raises(UsageError, match="no file"):
            open_rows(path, TWO)


@pytest.mark.parametrize(
    ("columns", "says"),
    [
        (("thickness",), "must be cos"),
        (("cos", "cos"), "twice"),
        (("cos", "colour"), "no column 'colour'"),
        (("cos", "base_r"), "three"),
        (("cos", "base_f0", "base_r", "base_g", "base_b"), "three"),
    ],
)
def test_columns_that_do_not_go_together_are_refused(
    columns: tuple[str, ...], says: str, source: Path
) -> None:
    with pytest.raises(UsageError, match=says):
        open_rows(source, columns)


def test_places_that_cannot_be_written_are_refused_first(source: Path, tmp_path: Path) -> None:
    (tmp_path / "folder.npy").mkdir()
    (tmp_path / "link.npy").hardlink_to(source)
    for out, says in (
        (source, "another one"),
        (tmp_path / "link.npy", "another one"),
        (tmp_path / "out.png", ".npy"),
        (tmp_path / "folder.npy", "is a folder"),
        (tmp_path / "none" / "out.npy", "no folder"),
    ):
        with pytest.raises(UsageError, match=says):
            check_out(out, source)
