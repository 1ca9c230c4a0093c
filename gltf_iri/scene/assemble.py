"""One scene of a file, flattened to primitives, cameras and lights in the world."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_NUMBER, MAX_REPEATED_VERTICES, VERTICES_PER_PRIMITIVE
from gltf_iri.errors import AssetError
from gltf_iri.material.fields import Kind, properties
from gltf_iri.material.material import Material
from gltf_iri.scene.camera import read_camera
from gltf_iri.scene.light import light_of_node
from gltf_iri.scene.mesh import read_primitive
from gltf_iri.scene.model import Camera, Light, Primitive, Scene
from gltf_iri.scene.morph import default_weights
from gltf_iri.scene.node import choose_scene, nodes_of_scene, world_matrices
from gltf_iri.scene.skin import joint_matrices
from gltf_iri.scene.triangles import MODES_WITHOUT_TRIANGLES

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["assemble_scene"]

Float64 = NDArray[np.float64]


def assemble_scene(document: Document, materials: tuple[Material, ...], index: int | None) -> Scene:
    """Return scene `index` of the document, or its default scene.

    Raises AssetError where the file contradicts itself or the scene has no triangles.
    """
    notes: list[str] = []
    if document.json.get("animations"):
        notes.append("Animations are not played: skins and morph targets stand in their default state.")
    name, roots = choose_scene(document.json, index, notes)
    worlds = world_matrices(document.json, notes)

    primitives: list[Primitive] = []
    cameras: list[Camera] = []
    lights: list[Light] = []
    rest_poses = _RestPoses(document, notes)
    for i in nodes_of_scene(document.json, roots):
        node: Mapping[str, Any] = document.json["nodes"][i]
        called = str(node.get("name", ""))
        if "mesh" in node:
            primitives.extend(rest_poses.place(node, called, worlds, i))
        if "camera" in node:
            description = document.json["cameras"][node["camera"]]
            label = str(description.get("name", "")) or called
            cameras.append(read_camera(description, worlds[i], label, f"/cameras/{node['camera']}"))
        light = light_of_node(document.json, node, worlds[i], f"/nodes/{i}")
        if light is not None:
            lights.append(light)

    if not primitives:
        passed_over = [note.rstrip(".") for note in notes if note.startswith("/meshes")]
        raise AssetError(
            ": ".join(["the scene has no triangles to draw", *passed_over[:1]]),
            pointer="/scenes" if document.json.get("scenes") else "/nodes",
        )
    notes.extend(_missing_uv_sets(primitives, materials))
    return Scene(name, tuple(primitives), tuple(cameras), tuple(lights), tuple(dict.fromkeys(notes)))


class _RestPoses:
    """Reads each mesh once for all the nodes that show it, so that instances share their arrays."""

    def __init__(self, document: Document, notes: list[str]) -> None:
        self._document = document
        self._notes = notes
        self._read: dict[tuple[int, tuple[float, ...]], tuple[Primitive, ...]] = {}
        self._counted = 0

    def place(
        self, node: Mapping[str, Any], name: str, worlds: tuple[Float64, ...], index: int
    ) -> Iterator[Primitive]:
        """Yield the primitives of the node's mesh, in the world."""
        mesh = node["mesh"]
        weights = default_weights(self._document.json["meshes"][mesh], node)
        self._count(mesh, weights, f"/nodes/{index}/mesh")
        if "skin" in node:
            self._counted += len(self._document.json["skins"][node["skin"]]["joints"])
            joints = joint_matrices(self._document, node["skin"], worlds)
            for primitive in self._primitives(mesh, weights, joints):
                yield replace(primitive, node_name=name)
            return
        if (mesh, weights) not in self._read:
            self._read[mesh, weights] = tuple(self._primitives(mesh, weights, None))
        for primitive in self._read[mesh, weights]:
            _refuse_far_away(primitive, worlds[index], f"/nodes/{index}")
            yield replace(primitive, node_name=name, world=worlds[index])

    def _count(self, mesh: int, weights: tuple[float, ...], pointer: str) -> None:
        """Refuse a scene of more vertices than the size of its files explains, before they are made."""
        self._counted += len(weights)
        for primitive in self._document.json["meshes"][mesh]["primitives"]:
            self._counted += VERTICES_PER_PRIMITIVE
            attributes = primitive["attributes"]
            if "POSITION" in attributes and primitive.get("mode", 4) not in MODES_WITHOUT_TRIANGLES:
                moved = sum(weight != 0.0 for weight in weights) if "targets" in primitive else 0
                self._counted += len(self._document.accessor(attributes["POSITION"])) * (1 + moved)
                if "indices" in primitive:
                    self._counted += len(self._document.accessor(primitive["indices"]))
            if self._counted > MAX_REPEATED_VERTICES + self._document.file_bytes:
                raise AssetError(
                    f"with this mesh the scene has more than {MAX_REPEATED_VERTICES} vertices and indices "
                    "beyond one for each byte of the files, every instance and morph target counted",
                    pointer=pointer,
                )

    def _primitives(
        self, mesh: int, weights: tuple[float, ...], joints: Float64 | None
    ) -> Iterator[Primitive]:
        for place in range(len(self._document.json["meshes"][mesh]["primitives"])):
            primitive = read_primitive(self._document, mesh, place, weights, joints, self._notes)
            if primitive is not None:
                yield primitive


def _refuse_far_away(primitive: Primitive, world: Float64, pointer: str) -> None:
    """Raise AssetError where OpenGL could not place the vertices; |M p| ≤ |M| max |p| in each component."""
    farthest = np.abs(primitive.positions).max(axis=0).astype(np.float64)
    if np.any(np.abs(world[:3, :3]) @ farthest + np.abs(world[:3, 3]) > MAX_NUMBER):
        raise AssetError(
            f"it places vertices of {primitive.pointer} beyond single precision", pointer=pointer
        )


def _missing_uv_sets(primitives: list[Primitive], materials: tuple[Material, ...]) -> Iterator[str]:
    """Yield a note for each primitive whose material reads a UV set that the primitive does not bring."""
    wanted = [sorted(set(_uv_sets(material))) for material in materials]
    for primitive in primitives:
        for uv_set in wanted[primitive.material] if primitive.material >= 0 else ():
            if uv_set >= len(primitive.uvs):
                yield (
                    f"{primitive.pointer} is textured by TEXCOORD_{uv_set}, "
                    + ("beyond the two sets that are read." if uv_set > 1 else "which it does not have.")
                )


def _uv_sets(stated: Any) -> Iterator[int]:
    for attribute, row in properties(type(stated)):
        value = getattr(stated, attribute)
        if value is None:
            continue
        if row.kind is Kind.TEXTURE:
            yield value.uv_set
        elif row.kind in (Kind.NESTED, Kind.EXTENSION):
            yield from _uv_sets(value)
        elif row.kind is Kind.NESTED_LIST:
            for each in value:
                yield from _uv_sets(each)
