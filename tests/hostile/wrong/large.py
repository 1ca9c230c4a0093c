"""Cases that git cannot or should not hold: large files, symbolic links, pipes; tests make them."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

from wrong.bytes_of_files import SCENE, chunk
from wrong.sound import packed, png_of_chunks, text, uri

DEPTH: Final = 100_000
SIDE: Final = 4096  # of a picture of one bit a pixel: 4 kB as a file, 64 MiB as RGBA


def black_png() -> bytes:
    header = struct.pack(">IIBBBBB", SIDE, SIDE, 1, 0, 0, 0, 0)
    return png_of_chunks(header, zlib.compress(bytes((1 + SIDE // 8) * SIDE), 9))


def deep_nodes() -> bytes:
    chain = [{"children": [i + 1]} for i in range(600)]
    return text({"/nodes": [*chain, {"mesh": 0}]})


def many_nodes() -> bytes:
    return text({"/nodes/1": {}}).replace(b"{}]", b"{}" + b",{}" * DEPTH + b"]")


def many_chunks() -> bytes:
    body = SCENE + chunk(b"ACME", b"") * 2**20
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def with_buffer(path: Path, name: str) -> Path:
    """Write an asset whose buffer is the file `name` beside it; return the place of that file."""
    path.write_bytes(text({"/buffers/0/uri": name}))
    return path.parent / name


def link_out(path: Path) -> None:
    outside = path.parent.parent / "outside.bin"
    outside.write_bytes(packed(["positions"])[0] * 9)
    with_buffer(path, "inside.bin").symlink_to(outside)


def link_loop(path: Path) -> None:
    place = with_buffer(path, "loop.bin")
    place.symlink_to(place.name)


def pipe(path: Path) -> None:
    os.mkfifo(with_buffer(path, "pipe.bin"))


def folder(path: Path) -> None:
    with_buffer(path, "folder.bin").mkdir()


LARGE: Final[Mapping[str, Callable[[Path], object]]] = {
    "json-deep-arrays.gltf": lambda path: path.write_bytes(b"[" * DEPTH + b"]" * DEPTH),
    "json-deep-objects.gltf": lambda path: path.write_bytes(b'{"a":' * DEPTH + b"0" + b"}" * DEPTH),
    "json-deep-unclosed.gltf": lambda path: path.write_bytes(text()[:-1] + b',"extras":' + b"[" * DEPTH),
    "json-many-values.gltf": lambda path: path.write_bytes(b'{"extras":[' + b"{}," * 4_000_000 + b"0]}"),
    "glb-many-chunks.glb": lambda path: path.write_bytes(many_chunks()),
    "nodes-deep.gltf": lambda path: path.write_bytes(deep_nodes()),
    "nodes-many.gltf": lambda path: path.write_bytes(many_nodes()),
    "png-compressible.gltf": lambda path: path.write_bytes(
        text({"/images/0/uri": uri(black_png(), "image/png")})
    ),
    "link-out-of-the-folder.gltf": link_out,
    "link-loop.gltf": link_loop,
    "buffer-pipe.gltf": pipe,
    "buffer-folder.gltf": folder,
}
