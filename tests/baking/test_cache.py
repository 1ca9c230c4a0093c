"""What lies in the cache is what was filled, or is filled anew."""

from __future__ import annotations

import hashlib
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.cache import TableCache, user_folder
from gltf_iri.baking.fill import bake
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.reach import Span

COS = TableAxis("cos_theta", Span(0.0, 1.0), 6)
TABLE = FilmTable("dielectric", 1.3, 400.0, (0.04, 0.04, 0.04), (COS,), "f4", 0.2)
ROOT = Path(__file__).resolve().parents[2]


def test_what_was_filled_once_is_read_the_second_time(tmp_path: Path) -> None:
    cache = TableCache(tmp_path / "new")
    first, second = bake(TABLE, "D65", cache=cache), bake(TABLE, "D65", cache=cache)
    assert (first.is_cached, second.is_cached) == (False, True)
    assert second.texels.dtype == first.texels.dtype
    np.testing.assert_array_equal(second.texels, first.texels)
    assert second.filled_in_s == pytest.approx(first.filled_in_s, rel=1e-5)
    assert cache.notes == []


def test_a_key_names_all_that_texels_depend_on_and_nothing_else(tmp_path: Path) -> None:
    cache = TableCache(tmp_path)
    others = [
        replace(TABLE, film_ior=np.nextafter(1.3, 2.0)),
        replace(TABLE, thickness_nm=401.0),
        replace(TABLE, base_f0=(0.04, 0.04, 0.05)),
        replace(TABLE, axes=(replace(COS, nodes=7),)),
        replace(TABLE, axes=(COS, TableAxis("thickness_nm", Span(0.0, 9.0), 2))),
        replace(TABLE, texel="f2"),
    ]
    assert len({cache.path(table, "D65") for table in (TABLE, *others)} | {cache.path(TABLE, "E")}) == 8
    assert cache.path(replace(TABLE, delta_e=0.1), "D65") == cache.path(TABLE, "D65")


def damaged(content: bytes) -> list[bytes]:
    flipped = bytearray(content)
    flipped[-5] ^= 1
    return [b"", content[:-1], content + b"\0", bytes(flipped), b"\x80\x04" + content, b"\0" * (1 << 16)]


def signed(content: bytes) -> bytes:
    return hashlib.sha256(content).digest() + content


def hostile(content: bytes) -> list[bytes]:
    """Files whose checksum is right and whose content is not."""
    body = content[32:]
    line, took, texels = body.split(b"\n", 2)
    not_a_number = np.frombuffer(texels, np.float32).copy()
    not_a_number[3] = np.nan
    return [
        signed(b"\n".join((line, took, texels[:-12]))),
        signed(b"\n".join((line, took, texels + texels))),
        signed(b"\n".join((line, b"-1", texels))),
        signed(b"\n".join((line, b"soon", texels))),
        signed(b"\n".join((line.replace(b"D65", b"E"), took, texels))),
        signed(b"\n".join((line, took, not_a_number.tobytes()))),
        signed(b""),
    ]


@pytest.mark.parametrize("wrong", [damaged, hostile], ids=lambda function: function.__name__)
def test_what_is_not_sound_is_refused_and_filled_anew(tmp_path: Path, wrong: object) -> None:
    cache = TableCache(tmp_path)
    sound = bake(TABLE, "D65", cache=cache)
    path = cache.path(TABLE, "D65")
    content = path.read_bytes()
    for bad in wrong(content):  # type: ignore[operator]
        path.write_bytes(bad)
        assert cache.read(TABLE, "D65") is None
        assert not path.exists()
        path.write_bytes(bad)
        again = bake(TABLE, "D65", cache=cache)
        assert not again.is_cached
        np.testing.assert_array_equal(again.texels, sound.texels)
        assert bake(TABLE, "D65", cache=cache).is_cached


def test_without_a_folder_tables_are_filled_all_the_same(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    cache = TableCache(tmp_path / "file" / "tables")
    for _ in range(2):
        assert not bake(TABLE, "D65", cache=cache).is_cached
    (note,) = cache.notes
    assert note.startswith(f"Tables are not kept in {cache.folder}: ")


def test_the_least_recently_used_go_first(tmp_path: Path) -> None:
    tables = [replace(TABLE, thickness_nm=float(nm)) for nm in range(4)]
    cache = TableCache(tmp_path)
    for age, table in enumerate(tables[:3]):
        bake(table, "D65", cache=cache)
        os.utime(cache.path(table, "D65"), (1000.0 + age, 1000.0 + age))
    assert cache.read(tables[0], "D65") is not None  # used: now the newest
    size = cache.path(tables[0], "D65").stat().st_size
    cache.largest_bytes = 3 * size + size // 2
    bake(tables[3], "D65", cache=cache)
    assert [cache.path(table, "D65").exists() for table in tables] == [True, False, True, True]


def test_the_folder_is_the_users_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert user_folder() == tmp_path / "gltf-iri" / "tables"
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    assert user_folder() == Path.home() / ".cache" / "gltf-iri" / "tables"


WRITER = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[2])
from tests_table import TABLES
from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.fill import bake
cache = TableCache(Path(sys.argv[1]))
print("ready", flush=True)
sys.stdin.readline()
while True:
    for table in TABLES:
        cache.write(bake(table, "D65"))
"""


def test_processes_that_write_and_die_leave_nothing_wrong(tmp_path: Path) -> None:
    tables = [replace(TABLE, thickness_nm=float(nm), axes=(replace(COS, nodes=20_000),)) for nm in (100, 200)]
    (tmp_path / "tests_table.py").write_text(
        "from gltf_iri.planning.film_table import FilmTable, TableAxis\n"
        f"from gltf_iri.planning.reach import Span\nTABLES = {tables!r}\n",
        encoding="utf-8",
    )
    folder = tmp_path / "cache"
    call = [sys.executable, "-c", WRITER.replace("bake(table", "kept(table"), str(folder), str(tmp_path)]
    call[2] = call[2].replace("cache =", "from functools import cache as keep\nkept = keep(bake)\ncache =", 1)
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    writers = [
        subprocess.Popen(call, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    cache = TableCache(folder)
    expected: list[BakedTable] = [bake(table, "D65") for table in tables]
    found = 0
    try:
        for writer in writers:
            assert writer.stdout is not None and writer.stdin is not None
            assert writer.stdout.readline() == "ready\n"
            writer.stdin.write("\n")
            writer.stdin.flush()
        deadline = time.monotonic() + 20.0
        while found < 40 and time.monotonic() < deadline:
            for table, sound in zip(tables, expected, strict=True):
                read = cache.read(table, "D65")
                if read is not None:
                    found += 1
                    np.testing.assert_array_equal(read.texels, sound.texels)
        writers[0].send_signal(signal.SIGKILL)
        writers[0].wait()
        for table, sound in zip(tables, expected, strict=True):
            read = bake(table, "D65", cache=cache)
            np.testing.assert_array_equal(read.texels, sound.texels)
            assert cache.path(table, "D65").exists()
    finally:
        for writer in writers:
            writer.kill()
            writer.communicate()
    assert found >= 40
    assert cache.notes == []
