from __future__ import annotations

import os
from pathlib import Path

import pytest

from gltf_iri.asset.guard import Budget, decode_data_uri, read_given, read_inside
from gltf_iri.errors import AssetError, UsageError

WHERE = "/buffers/0/uri"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """An asset folder with files inside, and a secret beside it."""
    inside = tmp_path / "asset"
    (inside / "sub").mkdir(parents=True)
    (inside / "plain.bin").write_bytes(b"inside")
    (inside / "sub" / "deep.bin").write_bytes(b"deep")
    (inside / "Farbe Grün é.bin").write_bytes(b"umlaut")
    (inside / "100%.bin").write_bytes(b"percent")
    (inside / "%2e%2e").mkdir()
    (inside / "%2e%2e" / "secret").write_bytes(b"literal")
    (tmp_path / "secret").write_bytes(b"outside")
    (tmp_path / "asset-evil").mkdir()
    (tmp_path / "asset-evil" / "secret").write_bytes(b"outside")
    return inside


@pytest.mark.parametrize(
    ("uri", "content"),
    [
        ("plain.bin", b"inside"),
        ("./plain.bin", b"inside"),
        ("sub/deep.bin", b"deep"),
        ("sub%2Fdeep.bin", b"deep"),
        ("Farbe Grün é.bin", b"umlaut"),
        ("Farbe%20Gr%C3%BCn%20%c3%a9.bin", b"umlaut"),
        ("100%25.bin", b"percent"),
        ("%252e%252e/secret", b"literal"),
    ],
)
def test_relative_uris_are_read_and_decoded_once(folder: Path, uri: str, content: bytes) -> None:
    assert read_inside(folder, uri, WHERE, 100) == content


@pytest.mark.parametrize(
    "uri",
    [
        "../secret",
        "sub/../../secret",
        "sub/../plain.bin",
        "%2e%2e/secret",
        "..%2fsecret",
        "%2E%2E%2Fsecret",
        "..\\secret",
        "..%5Csecret",
        "../asset-evil/secret",
        "/etc/passwd",
        "%2Fetc%2Fpasswd",
        "//host/share/file",
        "file:///etc/passwd",
        "FILE:/etc/passwd",
        "fi%6ce:///etc/passwd",
        "http://example.org/a.bin",
        "https://example.org/a.bin",
        "ftp:a.bin",
        "C:/secret",
        "C%3A/secret",
        "javascript:alert(1)",
        "plain.bin\0.png",
        "plain.bin%00.png",
        "a%0Ab",
        "",
        ".",
        "/",
        "%FF%FE.bin",
        "sub",
        "missing.bin",
        "plain.bin/below",
        "n" * 5000,
    ],
)
def test_everything_else_is_refused_with_its_pointer(folder: Path, uri: str) -> None:
    with pytest.raises(AssetError) as caught:
        read_inside(folder, uri, WHERE, 100)
    assert caught.value.pointer == WHERE
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 250


def test_a_backslash_is_refused_even_where_a_file_has_one_in_its_name(folder: Path) -> None:
    (folder / "sub\\deep.bin").write_bytes(b"odd")  # on other systems the same URI names another file
    with pytest.raises(AssetError, match="write '/' between folders"):
        read_inside(folder, "sub\\deep.bin", WHERE, 100)


def test_symbolic_links_may_stay_inside_but_not_lead_out(folder: Path) -> None:
    (folder / "alias").symlink_to(folder / "plain.bin")
    (folder / "out").symlink_to(folder.parent / "secret")
    (folder / "outside").symlink_to(folder.parent)
    (folder / "loop").symlink_to(folder / "loop")
    assert read_inside(folder, "alias", WHERE, 100) == b"inside"
    for uri in ("out", "outside/secret", "loop"):
        with pytest.raises(AssetError) as caught:
            read_inside(folder, uri, WHERE, 100)
        assert caught.value.pointer == WHERE


def test_a_folder_reached_through_a_link_is_still_the_assets_folder(folder: Path) -> None:
    link = folder.parent / "link"
    link.symlink_to(folder)
    assert read_inside(link, "plain.bin", WHERE, 100) == b"inside"


def test_named_pipes_and_devices_are_refused_without_waiting(folder: Path) -> None:
    os.mkfifo(folder / "pipe")
    with pytest.raises(AssetError, match="not a regular file"):
        read_inside(folder, "pipe", WHERE, 100)
    with pytest.raises(UsageError, match="not a regular file"):
        read_given(Path("/dev/zero"), 100)


def test_size_is_checked_before_reading(folder: Path) -> None:
    with (folder / "sparse.bin").open("wb") as file:
        file.truncate(2**40)  # a hole: reading it would need a terabyte of memory
    with pytest.raises(AssetError, match=str(2**40)):
        read_inside(folder, "sparse.bin", WHERE, 2**20)
    assert read_inside(folder, "plain.bin", WHERE, 6) == b"inside"
    with pytest.raises(AssetError, match="more than the 5 allowed"):
        read_inside(folder, "plain.bin", WHERE, 5)


def test_a_path_that_cannot_be_read_is_a_usage_error(tmp_path: Path) -> None:
    for path in (tmp_path / "none.gltf", tmp_path, Path("a\0b")):
        with pytest.raises(UsageError):
            read_given(path, 100)


@pytest.mark.parametrize(
    ("uri", "data", "media_type"),
    [
        ("data:application/octet-stream;base64,AAEC", b"\0\1\2", "application/octet-stream"),
        ("DATA:image/PNG;name=x;BASE64,AAE=", b"\0\1", "image/png"),
        ("data:;base64,", b"", ""),
        ("data:text/plain,a%00b", b"a\0b", "text/plain"),
    ],
)
def test_data_uris_give_data_and_media_type(uri: str, data: bytes, media_type: str) -> None:
    assert decode_data_uri(uri, WHERE, 100) == (data, media_type)


@pytest.mark.parametrize(
    "uri",
    [
        "data:application/octet-stream;base64,A",
        "data:application/octet-stream;base64,AAE",
        "data:application/octet-stream;base64,AA E=",
        "data:application/octet-stream;base64,AAE=AAE=",
        "data:application/octet-stream;base64,AA*E",
        "data:application/octet-stream;base64,AAéE",
        "data:application/octet-stream;base64",
        "data:" + "x" * 100_000,
    ],
)
def test_broken_data_uris_are_refused(uri: str) -> None:
    with pytest.raises(AssetError) as caught:
        decode_data_uri(uri, WHERE, 2**20)
    assert caught.value.pointer == WHERE
    assert len(str(caught.value)) < 250


def test_data_uris_are_bounded_before_decoding() -> None:
    with pytest.raises(AssetError, match="more than the 100 allowed"):
        decode_data_uri("data:;base64," + "A" * 400, WHERE, 100)


def test_the_budget_bounds_the_sum() -> None:
    budget = Budget(limit=10)
    budget.spend(6, "/a")
    budget.spend(4, "/b")
    with pytest.raises(AssetError) as caught:
        budget.spend(1, "/c")
    assert caught.value.pointer == "/c"
