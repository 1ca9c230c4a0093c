"""What accessors and buffer views are used for: each serves one purpose.

Who comes first decides. The order is that of the Khronos validator: sparse accessors, images, meshes, skins,
animations, each as listed in the file.
"""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.accessors import sparse_parts
from gltf_iri.validation.rules.animation_parts import parts
from gltf_iri.validation.rules.buffer_views import INDICES_TARGET, VERTICES_TARGET
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

_VERTICES, _INDICES, _PICTURE = "vertices", "indices", "a picture"
_MATRICES, _TIMES, _KEYFRAMES = "inverse bind matrices", "times", "keyframes"
# Buffer views do not tell sparse elements, times and keyframes apart.
_OTHER = "other data"

_BY_TARGET = {VERTICES_TARGET: _VERTICES, INDICES_TARGET: _INDICES}


class _Claims:
    """What each accessor and each buffer view is used for so far."""

    __slots__ = ("_accessors", "_asset", "_readers", "_views")

    def __init__(self, asset: Asset) -> None:
        self._asset = asset
        self._accessors: dict[Entry, str] = {}
        self._views: dict[Entry, str] = {}
        # Buffer views to the accessors of vertices that read them.
        self._readers: dict[Entry, set[Entry]] = {}

    def view(self, view: Entry, use: str, user: Entry, *keys: str | int) -> Iterator[Issue]:
        """Use a buffer view for `use`; `user` does, at `keys`."""
        view.is_used = True  # also by an accessor whose own format is broken
        initial = self._views.get(view) or _BY_TARGET.get(view.get("target", 0))
        if initial is None and use in _BY_TARGET.values():
            yield issue("BUFFER_VIEW_TARGET_MISSING", user.at(*keys))
        if initial is None or initial == use:
            self._views[view] = use
        else:
            yield issue("BUFFER_VIEW_TARGET_OVERRIDE", user.at(*keys), initial=initial, new=use)

    def accessor(self, index: int | None, use: str, user: Entry, *keys: str | int) -> Iterator[Issue]:
        """Use an accessor, if there is one, and the buffer view that it reads."""
        accessor = self._asset.get("accessors", index)
        if accessor is None:
            return
        initial = self._accessors.setdefault(accessor, use)
        if initial != use:
            yield issue("ACCESSOR_USAGE_OVERRIDE", user.at(*keys), initial=initial, new=use)
        view = self._asset.get("bufferViews", accessor.get("bufferView"))
        if view is None:
            return
        yield from self.view(view, _OTHER if use in (_TIMES, _KEYFRAMES) else use, user, *keys)
        if use == _VERTICES and "byteStride" not in view:
            readers = self._readers.setdefault(view, set())
            if readers and accessor not in readers:
                yield issue("MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", user.at(*keys))
            readers.add(accessor)


def _claims(root: Entry, asset: Asset) -> Iterator[Issue]:
    claims = _Claims(asset)
    for accessor in asset.array("accessors"):
        if accessor is not None:
            yield from _of_sparse(accessor, asset, claims)
    for image in asset.array("images"):
        view = asset.get("bufferViews", image.get("bufferView")) if image is not None else None
        if image is not None and view is not None:
            yield from claims.view(view, _PICTURE, image, "bufferView")
    for mesh in asset.array("meshes"):
        for primitive in mesh.get("primitives", ()) if mesh is not None else ():
            yield from _of_primitive(primitive, claims)
    for skin in asset.array("skins"):
        if skin is not None:
            index = skin.get("inverseBindMatrices")
            yield from claims.accessor(index, _MATRICES, skin, "inverseBindMatrices")
    for animation in asset.array("animations"):
        for sampler in parts(animation)[1] if animation is not None else ():
            yield from claims.accessor(sampler.get("input"), _TIMES, sampler, "input")
            yield from claims.accessor(sampler.get("output"), _KEYFRAMES, sampler, "output")


def _of_sparse(accessor: Entry, asset: Asset, claims: _Claims) -> Iterator[Issue]:
    for part, view in sparse_parts(accessor, asset):
        yield from claims.view(view, _OTHER, part, "bufferView")
        if "byteStride" in view:
            yield issue("BUFFER_VIEW_INVALID_BYTE_STRIDE", part.at("bufferView"))


def _of_primitive(primitive: Entry, claims: _Claims) -> Iterator[Issue]:
    for name, index in primitive.get("attributes", {}).items():
        yield from claims.accessor(index, _VERTICES, primitive, "attributes", name)
    yield from claims.accessor(primitive.get("indices"), _INDICES, primitive, "indices")
    for position, target in enumerate(primitive.get("targets", ())):
        for name, index in target.items():
            yield from claims.accessor(index, _VERTICES, primitive, "targets", position, name)


RULES: Rules = {"glTF": (_claims,)}
