"""JSON text and GLB containers that are broken before a property can be read."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import Final

from wrong.sound import BASIC, DROP, FILM, packed, text, with_token

TEXT: Final = text()
RAW: Final[Mapping[str, bytes]] = {
    "json-nan.gltf": with_token("/nodes/0/translation", b"[0,NaN,0]"),
    "json-infinity.gltf": with_token(f"{FILM}/iridescenceIor", b"Infinity"),
    "json-1e999.gltf": with_token(f"{FILM}/iridescenceThicknessMaximum", b"1e999"),
    "json-long-integer.gltf": with_token("/accessors/0/count", b"9" * 4400),
    "json-key-twice-in-root.gltf": b'{"nodes":[],' + TEXT[1:],
    "json-key-twice-in-material.gltf": with_token("/materials/0/name", b'"a","name":"b"'),
    "json-key-twice-in-extension.gltf": with_token(f"{FILM}/iridescenceIor", b'1.3,"iridescenceIor":1.9'),
    "json-byte-order-mark.gltf": b"\xef\xbb\xbf" + TEXT,
    "json-utf16.gltf": TEXT.decode().encode("utf-16-le"),
    "json-lone-surrogate.gltf": with_token("/nodes/0/name", b'"\\ud800"'),
    "json-lone-surrogate-key.gltf": with_token("/extras", b'{"\\udfff":0}'),
    "json-invalid-utf8.gltf": with_token("/nodes/0/name", b'"\xc3\x28"'),
    "json-truncated.gltf": TEXT[: len(TEXT) // 2],
    "json-trailing-text.gltf": TEXT + b" and more",
    "json-trailing-comma.gltf": TEXT[:-1] + b",}",
    "json-comment.gltf": b"// glTF\n" + TEXT,
    "json-empty.gltf": b"",
    "json-blank.gltf": b" \n\t",
    "json-null.gltf": b"null",
    "json-array.gltf": b"[" + TEXT + b"]",
    "json-control-character.gltf": with_token("/nodes/0/name", b'"\x01"'),
}


def chunk(kind: bytes, body: bytes, pad: bytes = b"\0", length: int | None = None) -> bytes:
    body += pad * (-len(body) % 4)
    return struct.pack("<I4s", len(body) if length is None else length, kind) + body


def glb(*chunks: bytes, magic: bytes = b"glTF", version: int = 2, more: int = 0) -> bytes:
    body = b"".join(chunks)
    return struct.pack("<4sII", magic, version, 12 + len(body) + more) + body


DATA: Final = packed(BASIC)[0]
SCENE: Final = chunk(b"JSON", text({"/buffers/0/uri": DROP}), b" ")
BINARY: Final = chunk(b"BIN\0", DATA)
BINARY_AT: Final = 12 + len(SCENE)
GLB: Final[Mapping[str, bytes]] = {
    "glb-sound.glb": glb(SCENE, BINARY),
    "glb-magic.glb": glb(SCENE, BINARY, magic=b"glTf"),
    "glb-version-1.glb": glb(SCENE, BINARY, version=1),
    "glb-length-too-long.glb": glb(SCENE, BINARY, more=4),
    "glb-length-too-short.glb": glb(SCENE, BINARY, more=-4),
    "glb-length-0.glb": struct.pack("<4sII", b"glTF", 2, 0) + SCENE,
    "glb-trailing-bytes.glb": glb(SCENE, BINARY) + b"more",
    "glb-chunk-too-large.glb": glb(SCENE, chunk(b"BIN\0", DATA, length=2**32 - 4)),
    "glb-chunk-misaligned.glb": glb(SCENE, chunk(b"BIN\0", DATA, length=len(DATA) - 1)),
    "glb-json-missing.glb": glb(BINARY),
    "glb-json-empty.glb": glb(chunk(b"JSON", b""), BINARY),
    "glb-json-twice.glb": glb(SCENE, SCENE),
    "glb-json-broken.glb": glb(chunk(b"JSON", TEXT[:100], b" "), BINARY),
    "glb-json-invalid-utf8.glb": glb(chunk(b"JSON", TEXT + b"\xff", b" "), BINARY),
    "glb-binary-first.glb": glb(BINARY, SCENE),
    "glb-binary-third.glb": glb(SCENE, chunk(b"ACME", b""), BINARY),
    "glb-binary-twice.glb": glb(SCENE, BINARY, BINARY),
    "glb-binary-missing.glb": glb(SCENE),
    "glb-binary-too-short.glb": glb(SCENE, chunk(b"BIN\0", DATA[:64])),
    "glb-truncated-in-header.glb": glb(SCENE)[:10],
    "glb-truncated-in-chunk-header.glb": glb(SCENE, BINARY)[: BINARY_AT + 4],
    "glb-truncated-in-chunk.glb": glb(SCENE, BINARY)[: BINARY_AT + 40],
    "glb-cut-in-chunk-header.glb": glb(SCENE, b"\4\0\0\0"),
}
