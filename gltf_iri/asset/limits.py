"""How much a file may ask for: every bound of the reader, each with the reason for its size.

A bound is there so that a small hostile file cannot ask for a large machine; each lies well above what real
assets need, and each error that one of them causes names it.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "GREATEST_NUMBER",
    "MAX_ASSET_BYTES",
    "MAX_BUFFERLESS_COUNT",
    "MAX_DECODED_PER_BYTE",
    "MAX_FILE_BYTES",
    "MAX_GLB_CHUNKS",
    "MAX_IMAGE_FILE_BYTES",
    "MAX_IMAGE_PIXELS",
    "MAX_JSON_BYTES",
    "MAX_JSON_DEPTH",
    "MAX_JSON_INTEGER",
    "MAX_JSON_OBJECTS",
    "MAX_JSON_VALUES",
    "MAX_NODE_DEPTH",
    "MAX_NUMBER",
    "MAX_REPEATED_VERTICES",
    "MAX_UNVOUCHED_BYTES",
    "VERTICES_PER_PRIMITIVE",
]

# One .glb or .bin: signed 32-bit offsets end here, and so do most other readers.
MAX_FILE_BYTES: Final = 2**31

# glTF knows two; extensions may add some. Without a bound, 2 GiB of empty chunks are walked for minutes.
MAX_GLB_CHUNKS: Final = 1024

# JSON text, embedded buffers included; parsing keeps the text and its decoded copy in memory at once.
MAX_JSON_BYTES: Final = 128 * 2**20

# Commas and opening brackets: a Python object costs up to 200 bytes for 4 bytes of text, so 128 MiB of "{},"
# would take many gigabytes. Four million values are about a hundred thousand nodes.
MAX_JSON_VALUES: Final = 4_000_000

# Opening braces, for the validator alone: of each object it keeps what stands in the file, what of it is
# sound, and where, up to 700 bytes together, and some microseconds go into it: so many take two seconds. A
# file of a hundred thousand nodes, each with a mesh of its own, has about as many.
MAX_JSON_OBJECTS: Final = 400_000

# The core schema nests 8 deep; the rest is for extras. Python's parser recurses and gives up near 1000.
MAX_JSON_DEPTH: Final = 128

# Integers beyond this lose digits in any reader that keeps JSON numbers as doubles (RFC 8259 §6).
MAX_JSON_INTEGER: Final = 2**53

# Largest float32: matrices, factors and distances end on the GPU in single precision.
MAX_NUMBER: Final = 3.4028234663852886e38

# What the validator cuts numbers to before it computes with them: JSON's integers have no end, floats have.
GREATEST_NUMBER: Final = 1e300

# Everything held for one asset: file bytes, decoded accessors and pixels. Many accessors may share the same
# few bytes of a file, so that bounding each alone would not bound their sum.
MAX_ASSET_BYTES: Final = 4 * 2**30

# Elements of an accessor without a buffer view, for which no file byte vouches. Sparse morph targets are made
# so; a million vertices is more than any face has.
MAX_BUFFERLESS_COUNT: Final = 2**20

# Decoded accessors for each byte of the files: 4 where bytes become floats, and accessors share few of their
# bytes. The unvouched part lets small files have sparse morph targets.
MAX_DECODED_PER_BYTE: Final = 8
MAX_UNVOUCHED_BYTES: Final = 2**27

# Vertices and indices of a scene, each instance and each morph target in force counted, beyond one for each
# byte of the files: a hundred trees of a hundred thousand triangles are within it, a million copies of a
# million vertices in a kilobyte of JSON are not.
MAX_REPEATED_VERTICES: Final = 2**24

# What a primitive counts for beside its vertices: one call to OpenGL costs as much as some hundred of them.
VERTICES_PER_PRIMITIVE: Final = 256

# A compressed picture: 8192 × 8192 RGBA as an uncompressed PNG is 256 MiB.
MAX_IMAGE_FILE_BYTES: Final = 256 * 2**20

# 8192 × 8192, 256 MiB as RGBA: what OpenGL 3.3 implementations commonly take as a texture's largest side.
MAX_IMAGE_PIXELS: Final = 8192 * 8192

# Chain of node children: deeper than any real skeleton, and code that walks the tree recursively still holds.
MAX_NODE_DEPTH: Final = 512
