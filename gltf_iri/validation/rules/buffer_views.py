"""Buffer views: whether they fit their buffers, and what may have a stride."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of

__all__ = ["INDICES_TARGET", "RULES", "VERTICES_TARGET"]

# OpenGL's ARRAY_BUFFER and ELEMENT_ARRAY_BUFFER.
VERTICES_TARGET = 34962
INDICES_TARGET = 34963


def _stride(view: Entry, asset: Asset) -> Iterator[Issue]:
    stride, length = view.get("byteStride"), view.get("byteLength")
    if stride is None:
        return
    if length is not None and stride > length:
        yield issue("BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", view.at("byteStride"), stride=stride, length=length)
    if view.get("target") == INDICES_TARGET:
        yield issue("BUFFER_VIEW_INVALID_BYTE_STRIDE", view.at("byteStride"))


def _extent(view: Entry, asset: Asset) -> Iterator[Issue]:
    buffer = asset.get("buffers", view.get("buffer"))
    if buffer is None or "byteLength" not in buffer:
        return
    # Wherever a view of a broken offset starts, its length may be too much.
    start = sound_value_of(view, "byteOffset") or 0
    available = buffer["byteLength"]
    index = view["buffer"]
    if start >= available:
        yield issue("BUFFER_VIEW_TOO_LONG", view.at("byteOffset"), buffer=index, length=available)
    elif start + view.get("byteLength", 0) > available:
        yield issue("BUFFER_VIEW_TOO_LONG", view.at("byteLength"), buffer=index, length=available)


RULES: Rules = {"bufferView": (_stride, _extent)}
