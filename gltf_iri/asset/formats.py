"""The formats of accessors' elements: which there are, how they lie in memory, and what takes which.

A format is written as type and component type, "VEC2 UNSIGNED_BYTE", and " normalized" where it is. The
numbers are those of the glTF 2.0 specification, §3.6.2 (accessors), §3.7.2 (meshes) and §3.11 (animations),
and of KHR_mesh_quantization. Imports nothing: the validator starts with it.
"""

from __future__ import annotations

__all__ = ["ATTRIBUTE_FORMATS", "COMPONENT_BYTES", "COMPONENT_NAMES", "FLOAT", "INDEX_FORMATS"]
__all__ += ["INPUT_FORMATS", "INTEGER_RANGES", "INVERSE_BIND_MATRIX_FORMATS", "OUTPUT_FORMATS"]
__all__ += ["QUANTIZED_ATTRIBUTE_FORMATS", "QUANTIZED_TARGET_FORMATS", "SEMANTICS_WITH_SETS"]
__all__ += ["TARGET_FORMATS", "TYPE_SHAPE", "UNSIGNED_INT", "column_bytes", "format_of", "used_bytes"]

# Accessor component types (OpenGL enums) to the bytes of one component.
COMPONENT_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
COMPONENT_NAMES = {
    5120: "BYTE",
    5121: "UNSIGNED_BYTE",
    5122: "SHORT",
    5123: "UNSIGNED_SHORT",
    5125: "UNSIGNED_INT",
    5126: "FLOAT",
}
UNSIGNED_INT = 5125
FLOAT = 5126

# What the integer component types hold, both ends included.
INTEGER_RANGES = {
    5120: (-(2**7), 2**7 - 1),
    5121: (0, 2**8 - 1),
    5122: (-(2**15), 2**15 - 1),
    5123: (0, 2**16 - 1),
    5125: (0, 2**32 - 1),
}

# Accessor types to (columns, rows).
TYPE_SHAPE = {
    "SCALAR": (1, 1),
    "VEC2": (1, 2),
    "VEC3": (1, 3),
    "VEC4": (1, 4),
    "MAT2": (2, 2),
    "MAT3": (3, 3),
    "MAT4": (4, 4),
}

# §3.6.2.4: each column of a matrix starts on such a boundary, in bytes.
_COLUMN_ALIGNMENT = 4


def column_bytes(columns: int, rows: int, size: int) -> int:
    """Return the distance of an element's columns; `size` is that of a component, in bytes."""
    used = rows * size
    return used if columns == 1 else -(-used // _COLUMN_ALIGNMENT) * _COLUMN_ALIGNMENT


def used_bytes(columns: int, rows: int, size: int) -> int:
    """Return the extent of an element: the padding of its last column need not be there."""
    return (columns - 1) * column_bytes(columns, rows, size) + rows * size


def format_of(kind: str | None, component: int | None, *, is_normalized: bool = False) -> str:
    """Return the format of that accessor type and component type; a word of neither where one is missing."""
    name = COMPONENT_NAMES.get(component, "unknown") if component is not None else "unknown"
    return f"{kind or 'unknown'} {name} normalized" if is_normalized else f"{kind or 'unknown'} {name}"


# Short names for the tables below; an n at the end: normalized.
_COMPONENTS = {
    "f32": "FLOAT",
    "s8": "BYTE",
    "s8n": "BYTE normalized",
    "u8": "UNSIGNED_BYTE",
    "u8n": "UNSIGNED_BYTE normalized",
    "s16": "SHORT",
    "s16n": "SHORT normalized",
    "u16": "UNSIGNED_SHORT",
    "u16n": "UNSIGNED_SHORT normalized",
}


def _formats(types: str, components: str) -> tuple[str, ...]:
    return tuple(f"{t} {_COMPONENTS[c]}" for t in types.split() for c in components.split())


# Attribute semantics without their set's number (§3.7.2.1, table of attributes).
ATTRIBUTE_FORMATS = {
    "POSITION": _formats("VEC3", "f32"),
    "NORMAL": _formats("VEC3", "f32"),
    "TANGENT": _formats("VEC4", "f32"),
    "TEXCOORD": _formats("VEC2", "f32 u8n u16n"),
    "COLOR": _formats("VEC3 VEC4", "f32 u8n u16n"),
    "JOINTS": _formats("VEC4", "u8 u16"),
    "WEIGHTS": _formats("VEC4", "f32 u8n u16n"),
}
# Those that a name follows with "_" and the number of a set.
SEMANTICS_WITH_SETS = frozenset({"TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"})

# What morph targets may move, and the formats of the differences (§3.7.2.2).
TARGET_FORMATS = {
    "POSITION": _formats("VEC3", "f32"),
    "NORMAL": _formats("VEC3", "f32"),
    "TANGENT": _formats("VEC3", "f32"),
    "TEXCOORD": _formats("VEC2", "f32 s8n u8n s16n u16n"),
    "COLOR": _formats("VEC3 VEC4", "f32 s8n u8n s16n u16n"),
}

# KHR_mesh_quantization, "Extending Mesh Attributes" and "Extending Morph Target Attributes".
QUANTIZED_ATTRIBUTE_FORMATS = {
    **ATTRIBUTE_FORMATS,
    "POSITION": _formats("VEC3", "f32 s8 s8n u8 u8n s16 s16n u16 u16n"),
    "NORMAL": _formats("VEC3", "f32 s8n s16n"),
    "TANGENT": _formats("VEC4", "f32 s8n s16n"),
    "TEXCOORD": _formats("VEC2", "f32 s8 s8n u8 u8n s16 s16n u16 u16n"),
}
QUANTIZED_TARGET_FORMATS = {
    **TARGET_FORMATS,
    "POSITION": _formats("VEC3", "f32 s8 s8n s16 s16n"),
    "NORMAL": _formats("VEC3", "f32 s8n s16n"),
    "TANGENT": _formats("VEC3", "f32 s8n s16n"),
    "TEXCOORD": _formats("VEC2", "f32 s8 s8n u8n s16 s16n u16n"),
}

INDEX_FORMATS = ("SCALAR UNSIGNED_BYTE", "SCALAR UNSIGNED_SHORT", "SCALAR UNSIGNED_INT")
INVERSE_BIND_MATRIX_FORMATS = ("MAT4 FLOAT",)

# Keyframes: their times, and by the path of the target their values (§3.11).
INPUT_FORMATS = ("SCALAR FLOAT",)
OUTPUT_FORMATS = {
    "translation": _formats("VEC3", "f32"),
    "rotation": _formats("VEC4", "f32 s8n u8n s16n u16n"),
    "scale": _formats("VEC3", "f32"),
    "weights": _formats("SCALAR", "f32 s8n u8n s16n u16n"),
}
