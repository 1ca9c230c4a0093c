from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.asset.glb import split_glb
from gltf_iri.errors import AssetError

JSON = (b"JSON", b"{}  ")
BIN = (b"BIN\0", b"12345678")
OTHER = (b"XYZ1", b"abcd")


def test_both_chunks_come_out_and_unknown_ones_are_ignored(glb: Callable[..., bytes]) -> None:
    container = split_glb(glb(JSON, BIN, OTHER, OTHER))
    assert bytes(container.json) == b"{}  "
    assert container.binary is not None
    assert bytes(container.binary) == b"12345678"
    assert container.notes == ()


def test_the_binary_chunk_is_optional(glb: Callable[..., bytes]) -> None:
    assert split_glb(glb(JSON)).binary is None
    assert split_glb(glb(JSON, OTHER)).binary is None


def test_bytes_after_the_end_are_noted(glb: Callable[..., bytes]) -> None:
    (note,) = split_glb(glb(JSON) + b"tail").notes
    assert "4 bytes" in note


def test_each_fault_names_its_byte(glb: Callable[..., bytes]) -> None:
    good = glb(JSON, BIN)
    faults = {
        b"": 0,
        good[:7]: 7,
        b"gltf" + good[4:]: 0,
        glb(JSON, version=1): 4,
        glb(JSON, version=3): 4,
        glb(length=12): 8,
        glb(JSON, length=10**9): 8,
        good[:-1]: 8,
        glb(BIN, JSON): 16,
        glb(OTHER, JSON): 16,
        glb(JSON, JSON): 28,
        glb(JSON, BIN, BIN): 44,
        glb(JSON, OTHER, BIN): 40,
        glb((b"JSON", b"{} ")): 12,
        glb((b"JSON", b"")): 12,
    }
    for data, offset in faults.items():
        with pytest.raises(AssetError) as caught:
            split_glb(data)
        assert caught.value.offset == offset, data


def test_a_chunk_may_not_claim_more_than_the_file_has(glb: Callable[..., bytes]) -> None:
    data = bytearray(glb(JSON, BIN))
    data[24:28] = (0xFFFFFFFC).to_bytes(4, "little")
    with pytest.raises(AssetError, match="claims 4294967292 bytes, but 8 are left") as caught:
        split_glb(bytes(data))
    assert caught.value.offset == 24


def test_a_file_that_ends_inside_a_chunk_header_says_so(glb: Callable[..., bytes]) -> None:
    whole = glb(JSON) + b"\4\0\0\0"
    data = whole[:8] + len(whole).to_bytes(4, "little") + whole[12:]
    with pytest.raises(AssetError, match="inside a chunk header") as caught:
        split_glb(data)
    assert caught.value.offset == 24


@given(st.binary(), st.booleans())
def test_any_bytes_give_chunks_or_an_asset_error(data: bytes, with_header: bool) -> None:
    if with_header:
        data = b"glTF\2\0\0\0" + (len(data) + 12).to_bytes(4, "little") + data
    try:
        container = split_glb(data)
    except AssetError as error:
        assert error.offset is not None
    else:
        assert len(container.json) + len(container.binary or b"") < len(data)
