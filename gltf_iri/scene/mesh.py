"""Mesh primitives to triangles in their rest pose (glTF 2.0 §3.7.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.formats import ATTRIBUTE_FORMATS, TYPE_SHAPE
from gltf_iri.errors import AssetError
from gltf_iri.material.material import DEFAULT_MATERIAL
from gltf_iri.scene.model import Primitive
from gltf_iri.scene.morph import apply_morph_targets
from gltf_iri.scene.normals import face_normals, repaired_normals, unit
from gltf_iri.scene.skin import apply_skin, is_mirroring
from gltf_iri.scene.triangles import MODES_WITHOUT_TRIANGLES, read_triangles

if TYPE_CHECKING:
    import trimesh

    from gltf_iri.asset.document import Document

__all__ = ["read_primitive", "to_trimesh"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
UInt32 = NDArray[np.uint32]
Attributes = dict[str, Float32]

# What a primitive may carry that this program reads, and how many components each has.
_READ = (
    *("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"),
    *("JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"),
)
_COMPONENTS: dict[str, set[int]] = {
    name: {TYPE_SHAPE[stated.partition(" ")[0]][1] for stated in ATTRIBUTE_FORMATS[name.partition("_")[0]]}
    for name in _READ
}


def read_primitive(
    document: Document,
    mesh: int,
    place: int,
    weights: tuple[float, ...],
    joints: Float64 | None,
    notes: list[str],
) -> Primitive | None:
    """Return primitive `place` of mesh `mesh` in its own space, or None where it holds no triangles.

    weights : of the morph targets, () for the undisplaced mesh.
    joints : (j, 4, 4) from `joint_matrices`; the primitive is then in world space.
    Raises AssetError where counts, indices or numbers contradict each other.
    """
    description: dict[str, Any] = document.json["meshes"][mesh]["primitives"][place]
    pointer = f"/meshes/{mesh}/primitives/{place}"
    mode = description.get("mode", 4)
    if mode in MODES_WITHOUT_TRIANGLES:
        notes.append(f"{pointer} holds {MODES_WITHOUT_TRIANGLES[mode]}, which are not drawn.")
        return None
    if "POSITION" not in description["attributes"]:
        notes.append(f"{pointer} has no positions and is not drawn.")
        return None

    attributes = _read_attributes(document, description["attributes"], pointer)
    triangles = read_triangles(document, description, len(attributes["POSITION"]), pointer, notes)
    if not len(triangles):
        notes.append(f"{pointer} has no triangles and is not drawn.")
        return None
    # Huge displacements overflow float32; what comes of it is refused below instead of warned about here.
    with np.errstate(over="ignore", invalid="ignore"):
        targets = description.get("targets", ())
        attributes = apply_morph_targets(document, attributes, targets, weights, pointer)
        if joints is not None:
            attributes = apply_skin(attributes, joints, pointer)
    if not all(np.isfinite(values).all() for values in attributes.values()):
        raise AssetError("morph targets or joints move a vertex beyond what float32 holds", pointer=pointer)
    if joints is not None and is_mirroring(joints):
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    if "NORMAL" not in attributes:
        attributes, triangles = _flat(attributes, triangles)
    normals, lost = repaired_normals(attributes["POSITION"], attributes["NORMAL"], triangles)
    if lost:
        notes.append(f"{pointer} has {lost} normals of length 0: the mean of the triangles around stands in.")

    return Primitive(
        pointer=pointer,
        node_name="",
        material=description.get("material", DEFAULT_MATERIAL),
        positions=np.ascontiguousarray(attributes["POSITION"]),
        normals=normals,
        triangles=triangles,
        world=np.eye(4),
        tangents=_tangents(attributes, pointer, notes),
        uvs=_uv_sets(attributes),
        colours=_colours(attributes),
    )


def to_trimesh(primitive: Primitive) -> trimesh.Trimesh:
    """Return the primitive's triangles in world space as trimesh sees them, vertex for vertex.

    Nothing is merged, dropped or turned around except the winding of a mirrored node, so that face normals
    point outwards in the world too.
    """
    import trimesh

    world = primitive.world
    faces = primitive.triangles[:, ::-1] if primitive.is_mirrored else primitive.triangles
    return trimesh.Trimesh(
        vertices=primitive.positions.astype(np.float64) @ world[:3, :3].T + world[:3, 3],
        faces=faces.astype(np.int64),
        process=False,
    )


def _read_attributes(document: Document, references: dict[str, int], pointer: str) -> Attributes:
    attributes: Attributes = {}
    for name, allowed in _COMPONENTS.items():
        if name not in references:
            continue
        where = f"{pointer}/attributes/{name}"
        stored = document.accessor(references[name])
        if name.startswith("JOINTS") and stored.dtype.kind != "u":
            raise AssetError(f"{name} must be unsigned integers that are not normalised", pointer=where)
        values = stored.astype(np.float32)
        if values.ndim != 2 or values.shape[1] not in allowed:
            raise AssetError(f"{name} cannot have the shape {values.shape[1:]}", pointer=where)
        count = len(attributes.get("POSITION", values))
        if len(values) != count:
            raise AssetError(f"{name} has {len(values)} entries for {count} vertices", pointer=where)
        attributes[name] = values
    return attributes


def _flat(attributes: Attributes, triangles: UInt32) -> tuple[Attributes, UInt32]:
    """Give each triangle its own three vertices and one normal; the file's tangents go (§3.7.2.1)."""
    corners = triangles.ravel()
    faces, _ = unit(face_normals(attributes["POSITION"], triangles))
    unshared = {name: values[corners] for name, values in attributes.items() if name != "TANGENT"}
    unshared["NORMAL"] = np.repeat(faces, 3, axis=0)
    return unshared, np.arange(len(corners), dtype=np.uint32).reshape(-1, 3)


def _tangents(attributes: Attributes, pointer: str, notes: list[str]) -> Float32 | None:
    if "TANGENT" not in attributes:
        return None
    direction, lost = unit(attributes["TANGENT"][:, :3])
    if lost.any():
        notes.append(f"{pointer} has {int(lost.sum())} tangents of length 0: the pictures derive their own.")
        return None
    handedness = np.where(attributes["TANGENT"][:, 3] < 0.0, -1.0, 1.0)
    return np.column_stack([direction, handedness]).astype(np.float32)


def _uv_sets(attributes: Attributes) -> tuple[Float32, ...]:
    if "TEXCOORD_1" in attributes:
        second = attributes["TEXCOORD_1"]
        return (attributes.get("TEXCOORD_0", np.zeros_like(second)), second)
    return (attributes["TEXCOORD_0"],) if "TEXCOORD_0" in attributes else ()


def _colours(attributes: Attributes) -> Float32 | None:
    if "COLOR_0" not in attributes:
        return None
    colour = attributes["COLOR_0"]
    if colour.shape[1] == 4:
        return colour
    return np.column_stack([colour, np.ones(len(colour), dtype=np.float32)])
