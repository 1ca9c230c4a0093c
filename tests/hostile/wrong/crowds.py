"""Cases for the validator alone: few kinds of things, each of them very often, or one shared by thousands."""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any, Final

from wrong.bytes_of_files import chunk, glb
from wrong.sound import png_of_chunks, uri

ASSET: Final = b'{"asset":{"version":"2.0"},'
KEYFRAMES: Final = {"componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [0]}
POSITIONS: Final = {"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}
FILM: Final = "KHR_materials_iridescence"
POINTER: Final = "KHR_animation_pointer"
VARIANTS: Final = "KHR_materials_variants"


def text(**stated: object) -> bytes:
    return json.dumps({"asset": {"version": "2.0"}, **stated}, separators=(",", ":")).encode()


def of_one_buffer(data: bytes, **stated: object) -> bytes:
    scene = text(buffers=[{"byteLength": len(data)}], **stated)
    return glb(chunk(b"JSON", scene, b" "), chunk(b"BIN\0", data))


def objects(count: int) -> bytes:
    return ASSET + b'"nodes":[' + b"{}," * count + b"{}]}"


def deep_and_wide() -> bytes:
    return ASSET + b'"extras":{"a":[' + (b"[" * 100 + b"]" * 100 + b",") * 5000 + b"0]}}"


def animated(targets: list[dict[str, Any]], **stated: object) -> bytes:
    channels = [{"sampler": 0, "target": target} for target in targets]
    animation = {"samplers": [{"input": 0, "output": 1}], "channels": channels}
    return text(accessors=[KEYFRAMES, KEYFRAMES], animations=[animation], **stated)


def pointers_to_nothing() -> bytes:
    target = {"path": "pointer", "extensions": {POINTER: {"pointer": "/materials/0/normalTexture/scale"}}}
    return animated([target] * 20_000, extensionsUsed=[POINTER], materials=[{}])


def bad_normals() -> bytes:
    count = 3000
    view = {"buffer": 0, "byteLength": 12 * count, "target": 34962}
    normals = {"componentType": 5126, "count": count, "type": "VEC3"}
    return of_one_buffer(
        bytes(12 * count) + struct.pack("<3f", 5, 5, 5) * count,
        bufferViews=[view, {**view, "byteOffset": 12 * count}],
        accessors=[{**POSITIONS, "count": count, "bufferView": 0}, {**normals, "bufferView": 1}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}] * 1000}],
    )


def accessors_of_one_view() -> bytes:
    numbers = 200_000
    accessor = {"bufferView": 0, "componentType": 5126, "type": "SCALAR", "min": [0], "max": [0]}
    return of_one_buffer(
        bytes(4 * numbers),
        bufferViews=[{"buffer": 0, "byteLength": 4 * numbers}],
        accessors=[{**accessor, "count": numbers - place} for place in range(3000)],
    )


def skins_of_one_chain() -> bytes:
    joints = list(range(2000))
    chain = [{"children": [joint + 1]} for joint in joints]
    return text(nodes=[*chain, {}], skins=[{"joints": joints, "skeleton": 1000}] * 300)


def morph_targets() -> bytes:
    primitive = {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0, "TANGENT": 0}] * 200}
    return text(accessors=[POSITIONS], meshes=[{"primitives": [primitive] * 200}])


def variants() -> bytes:
    mappings = [{"material": 0, "variants": list(range(1000))}] * 300
    primitive = {"attributes": {"POSITION": 0}, "extensions": {VARIANTS: {"mappings": mappings}}}
    return text(
        extensionsUsed=[VARIANTS],
        extensions={VARIANTS: {"variants": [{"name": f"v{place}"} for place in range(1000)]}},
        accessors=[POSITIONS],
        materials=[{}],
        meshes=[{"primitives": [primitive]}],
    )


def films() -> bytes:
    """Write films that all differ, on pictures that are all one."""
    header = struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)
    picture = uri(png_of_chunks(header, zlib.compress(bytes(52))), "image/png")
    films = [
        {"iridescenceThicknessMaximum": 1000 + place, "iridescenceThicknessTexture": {"index": place % 1000}}
        for place in range(5000)
    ]
    return text(
        extensionsUsed=[FILM],
        images=[{"uri": picture}],
        textures=[{"source": 0}] * 1000,
        materials=[{"extensions": {FILM: {"iridescenceFactor": 1, **film}}} for film in films],
    )


def pictures_of_one_view() -> bytes:
    empty = struct.pack(">I4sI", 0, b"tEXt", zlib.crc32(b"tEXt"))
    picture = png_of_chunks(struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0), zlib.compress(bytes(52)))
    data = picture[:33] + empty * 300_000 + picture[33:]  # behind the header's chunk
    return of_one_buffer(
        data,
        bufferViews=[{"buffer": 0, "byteLength": len(data)}],
        images=[{"bufferView": 0, "mimeType": "image/png"}] * 3000,
    )


def written(make: Callable[[], bytes], path: Path) -> None:
    path.write_bytes(make())


def zeros(path: Path) -> None:
    """Write a GLB whose JSON chunk has 300 MiB of nothing, which the disk need not hold."""
    size = 300 * 2**20
    with path.open("wb") as file:
        file.write(struct.pack("<4sIII4s", b"glTF", 2, size, size - 20, b"JSON"))
        file.truncate(size)


# Each is told, or refused, within what any hostile file may cost.
WRITTEN: Final[Mapping[str, Callable[[], bytes]]] = {
    "objects-nearly-too-many.gltf": lambda: objects(390_000),
    "objects-too-many.gltf": lambda: objects(1_000_000),
    "json-deep-and-wide.gltf": deep_and_wide,
    "json-keys-twice.gltf": lambda: ASSET + b'"extras":{"a":[' + b'{"a":1,"a":1},' * 200_000 + b"0]}}",
    "json-escapes.gltf": lambda: ASSET + b'"extras":{"a":"' + rb"\u0041" * 5_000_000 + b'"}}',
    "keys-many.gltf": lambda: text(**{f"key{place}": 1 for place in range(100_000)}),
    "keys-long.gltf": lambda: text(nodes=[{"x" * 100_000: 1} for _ in range(300)]),
    "extensions-many.gltf": lambda: text(extensionsUsed=[f"EXT_{place}" for place in range(100_000)]),
    "attributes-many.gltf": lambda: text(
        accessors=[{"componentType": 5126, "count": 3, "type": "VEC2"}],
        meshes=[{"primitives": [{"attributes": {f"TEXCOORD_{place}": 0 for place in range(50_000)}}]}],
    ),
    "channels-of-one-sampler.gltf": lambda: animated(
        [{"node": 0, "path": "translation"}] * 40_000, nodes=[{}]
    ),
    "pointers-to-nothing.gltf": pointers_to_nothing,
    "normals-of-one-accessor.glb": bad_normals,
    "accessors-of-one-view.glb": accessors_of_one_view,
    "skins-of-one-chain.gltf": skins_of_one_chain,
    "nodes-in-a-loop.gltf": lambda: text(
        nodes=[{"children": [(place + 1) % 50_000]} for place in range(50_000)],
        scenes=[{"nodes": list(range(50_000))}],
    ),
    "children-twice.gltf": lambda: text(nodes=[{"children": [1] * 300_000}, {}]),
    "targets-many.gltf": morph_targets,
    "variants-many.gltf": variants,
    "films-many.gltf": films,
    "pictures-of-one-view.glb": pictures_of_one_view,
    "buffer-percent-encoded.gltf": lambda: text(
        buffers=[{"byteLength": 5_000_000, "uri": "data:application/octet-stream," + "%41" * 5_000_000}]
    ),
}
CROWDS: Final[Mapping[str, Callable[[Path], object]]] = {
    "glb-zeros.glb": zeros,
    **{name: partial(written, make) for name, make in WRITTEN.items()},
}
