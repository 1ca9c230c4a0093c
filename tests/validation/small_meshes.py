"""Accessors, meshes and animations of a few numbers each, for tests of one rule."""

from __future__ import annotations

from typing import Any

__all__ = ["BUFFER", "INDICES", "POSITIONS", "TIMES", "accessor", "animation", "mesh", "view"]

BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
__all__ += ["BYTE", "FLOAT", "SHORT", "UNSIGNED_BYTE", "UNSIGNED_INT", "UNSIGNED_SHORT"]

VERTICES_TARGET, INDICES_TARGET = 34962, 34963
__all__ += ["INDICES_TARGET", "VERTICES_TARGET"]


def accessor(kind: str = "VEC3", component: int = FLOAT, count: int = 3, **more: Any) -> dict[str, Any]:
    """Return an accessor, of zeros where `more` names no buffer view."""
    return {"componentType": component, "type": kind, "count": count, **more}


POSITIONS = accessor(min=[0, 0, 0], max=[0, 0, 0])
INDICES = accessor("SCALAR", UNSIGNED_SHORT)
TIMES = accessor("SCALAR", count=2, min=[0], max=[1])

# Nothing is read from a buffer without a URI.
BUFFER = {"byteLength": 1000}


def view(**more: Any) -> dict[str, Any]:
    """Return a buffer view of 200 bytes from the start of the buffer."""
    return {"buffer": 0, "byteLength": 200, **more}


def mesh(attributes: dict[str, Any], **more: Any) -> dict[str, Any]:
    """Return a mesh of one primitive."""
    return {"primitives": [{"attributes": attributes, **more}]}


def animation(path: str, *, node: int | None = 0, **sampler: Any) -> dict[str, Any]:
    """Return an animation of one channel, from accessor 0 to accessor 1."""
    target = {"path": path} if node is None else {"node": node, "path": path}
    return {
        "channels": [{"sampler": 0, "target": target}],
        "samplers": [{"input": 0, "output": 1, **sampler}],
    }
