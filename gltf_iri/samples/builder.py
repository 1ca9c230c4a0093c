"""Puts shapes, textures, materials, cameras and lights into a glTF file.

The object model is pygltflib's; it is imported when the first builder is made, because it is slow to load.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.samples.accessors import Accessors
from gltf_iri.samples.rounding import rounded_list
from gltf_iri.samples.shapes import Shape

__all__ = ["GLTFBuilder", "facing"]

_NEAREST, _LINEAR, _LINEAR_MIPMAP_LINEAR = 9728, 9729, 9987
_REPEAT, _CLAMP = 10497, 33071


def facing(eye: ArrayLike, target: ArrayLike) -> list[float]:
    """Return the unit quaternion (x, y, z, w) that turns −Z towards `target` and keeps +Y up.

    Cameras and lights look along −Z (glTF 2.0 §3.10, KHR_lights_punctual).
    """
    towards = np.asarray(target, dtype=np.float64) - np.asarray(eye, dtype=np.float64)
    x, y, z = towards / np.linalg.norm(towards)
    yaw, pitch = np.arctan2(-x, -z), np.arcsin(y)
    half = np.cos(yaw / 2), np.sin(yaw / 2), np.cos(pitch / 2), np.sin(pitch / 2)
    quaternion = (half[0] * half[3], half[1] * half[2], -half[1] * half[3], half[0] * half[2])
    return rounded_list(quaternion)


class GLTFBuilder:
    """One asset in the making; `to_glb` and `to_gltf` finish it."""

    def __init__(self, name: str) -> None:
        import pygltflib

        self._model = pygltflib
        self._name = name
        self._images: list[tuple[str, bytes]] = []
        self._lights: list[dict[str, Any]] = []
        self._variants: list[str] = []
        self._gltf = pygltflib.GLTF2(
            asset=pygltflib.Asset(
                generator="gltf-iri samples", copyright="gltf-iri contributors, Apache-2.0"
            ),
            scene=0,
            scenes=[pygltflib.Scene(name=name, nodes=[])],
        )
        self._stored = Accessors(self._gltf)

    def texture(self, name: str, png: bytes, *, nearest: bool = False, repeat: bool = False) -> int:
        """Add an image with its own sampler and return the texture's index.

        `nearest` keeps texels apart, for textures that hold exact values side by side.
        """
        wrap = _REPEAT if repeat else _CLAMP
        filters = (_NEAREST, _NEAREST) if nearest else (_LINEAR, _LINEAR_MIPMAP_LINEAR)
        sampler = self._model.Sampler(magFilter=filters[0], minFilter=filters[1], wrapS=wrap, wrapT=wrap)
        self._gltf.samplers.append(sampler)
        self._images.append((name, png))
        index = len(self._images) - 1
        self._gltf.textures.append(self._model.Texture(name=name, sampler=index, source=index))
        return index

    def material(
        self,
        name: str,
        *,
        base_color: ArrayLike,
        metallic: float,
        roughness: float,
        extensions: Mapping[str, Mapping[str, Any]],
        base_color_texture: int | None = None,
        normal_texture: int | None = None,
        normal_repeats: float = 1.0,
        double_sided: bool = False,
    ) -> int:
        """Add a material and return its index; `base_color` is linear Rec.709, (3,).

        The normal texture is laid `normal_repeats` times along u and along v.
        """
        metallic_roughness = self._model.PbrMetallicRoughness(
            baseColorFactor=[*rounded_list(base_color), 1.0],
            metallicFactor=metallic,
            roughnessFactor=roughness,
        )
        if base_color_texture is not None:
            metallic_roughness.baseColorTexture = self._model.TextureInfo(index=base_color_texture)
        material = self._model.Material(
            name=name,
            pbrMetallicRoughness=metallic_roughness,
            extensions={key: dict(value) for key, value in extensions.items()},
            doubleSided=double_sided,
        )
        if normal_texture is not None:
            transform = {"KHR_texture_transform": {"scale": [normal_repeats, normal_repeats]}}
            material.normalTexture = self._model.NormalMaterialTexture(
                index=normal_texture, extensions=transform
            )
            self._use("KHR_texture_transform")
        self._gltf.materials.append(material)
        infos = [info for e in extensions.values() for info in e.values() if isinstance(info, Mapping)]
        self._use(*extensions, *(name for info in infos for name in info.get("extensions", ())))
        return len(self._gltf.materials) - 1

    def mesh(
        self,
        name: str,
        shape: Shape,
        material: int,
        rotation: ArrayLike = (0.0, 0.0, 0.0, 1.0),
        translation_m: ArrayLike = (0.0, 0.0, 0.0),
        second_uvs: NDArray[np.float64] | None = None,
        variants: Mapping[str, int] | None = None,
    ) -> None:
        """Add a mesh and the node that holds it; the same `shape` again costs no further vertices.

        rotation : unit quaternion (x, y, z, w); then the node is moved by translation_m, (3,).
        second_uvs : (n, 2), TEXCOORD_1 where a material reads it. variants : their names and materials.
        """
        attributes, indices = self._shape(shape, second_uvs, {material, *(variants or {}).values()})
        primitive = self._model.Primitive(
            attributes=self._model.Attributes(**attributes), indices=indices, material=material
        )
        if variants:
            mappings = [{"material": m, "variants": [self._variant(v)]} for v, m in variants.items()]
            primitive.extensions = {"KHR_materials_variants": {"mappings": mappings}}
        self._gltf.meshes.append(self._model.Mesh(name=name, primitives=[primitive]))
        node = self._model.Node(name=name, mesh=len(self._gltf.meshes) - 1, rotation=rounded_list(rotation))
        if np.any(translation_m):
            node.translation = rounded_list(translation_m)
        self._place(node)

    def _shape(
        self, shape: Shape, second_uvs: NDArray[np.float64] | None, materials: set[int]
    ) -> tuple[dict[str, int], int]:
        """Return the accessors of the attributes and of the triangles of `shape`, each added once."""
        stored = self._stored
        attributes = {
            "POSITION": stored.attribute(shape.positions, "VEC3", bounded=True),
            "NORMAL": stored.attribute(shape.normals, "VEC3"),
        }
        made = [self._gltf.materials[material] for material in materials]
        read = {texcoord for each in made for texcoord in _texcoords_of(each)}
        if read:
            attributes["TEXCOORD_0"] = stored.attribute(shape.uvs, "VEC2")
        if second_uvs is not None and 1 in read:
            attributes["TEXCOORD_1"] = stored.attribute(second_uvs, "VEC2")
        if any(each.normalTexture is not None for each in made):
            attributes["TANGENT"] = stored.attribute(shape.tangents, "VEC4")
        return attributes, stored.indices(shape.triangles)

    def pointer_animation(self, name: str, times_s: ArrayLike, tracks: Mapping[str, ArrayLike]) -> None:
        """Add an animation of properties (KHR_animation_pointer), linear between `times_s` (k,).

        tracks : JSON pointers and their values at those times, (k,) or (k, 2).
        """
        instants = np.asarray(times_s, dtype=np.float64)[:, None]
        times = self._stored.floats(instants, "SCALAR", bounded=True)
        animation = self._model.Animation(name=name)
        for pointer, values in tracks.items():
            rows = np.asarray(values, dtype=np.float64)
            output = self._stored.floats(rows, "SCALAR" if rows.ndim == 1 else f"VEC{rows.shape[1]}")
            target = self._model.AnimationChannelTarget(
                path="pointer", extensions={"KHR_animation_pointer": {"pointer": pointer}}
            )
            channel = self._model.AnimationChannel(sampler=len(animation.samplers), target=target)
            animation.samplers.append(self._model.AnimationSampler(input=times, output=output))
            animation.channels.append(channel)
        self._gltf.animations.append(animation)
        self._use("KHR_animation_pointer")

    def perspective_camera(self, eye: ArrayLike, target: ArrayLike, yfov_rad: float) -> None:
        """Add a camera at `eye` (m) that looks at `target`."""
        distance = float(np.linalg.norm(np.subtract(target, eye)))
        lens = self._model.Perspective(
            yfov=round(yfov_rad, 6), znear=round(distance / 20, 6), zfar=round(distance * 20, 6)
        )
        self._camera(self._model.Camera(name="camera", type="perspective", perspective=lens), eye, target)

    def orthographic_camera(self, eye: ArrayLike, target: ArrayLike, xmag_m: float, ymag_m: float) -> None:
        """Add a camera with parallel rays: every part of a flat sample is seen under one angle."""
        distance = float(np.linalg.norm(np.subtract(target, eye)))
        lens = self._model.Orthographic(xmag=xmag_m, ymag=ymag_m, znear=0.0, zfar=round(distance * 4, 6))
        self._camera(self._model.Camera(name="camera", type="orthographic", orthographic=lens), eye, target)

    def directional_light(self, towards: ArrayLike, lux: float) -> None:
        """Add a white light that travels in the direction `towards`."""
        self._lights.append({"name": "sun", "type": "directional", "intensity": lux})
        extension = {"KHR_lights_punctual": {"light": len(self._lights) - 1}}
        self._place(self._model.Node(name="sun", rotation=facing((0, 0, 0), towards), extensions=extension))
        self._use("KHR_lights_punctual")

    def to_glb(self) -> dict[str, bytes]:
        """Return the asset as one binary file."""
        for name, png in self._images:
            view = self._stored.view(png)
            self._gltf.images.append(self._model.Image(name=name, mimeType="image/png", bufferView=view))
        self._finish(uri=None)
        self._gltf.set_binary_blob(bytes(self._stored.binary))
        return {f"{self._name}.glb": b"".join(self._gltf.save_to_bytes())}

    def to_gltf(self) -> dict[str, bytes]:
        """Return the asset as JSON with a .bin and PNG files beside it."""
        pictures = {f"{name}.png": png for name, png in self._images}
        for name, _ in self._images:
            self._gltf.images.append(self._model.Image(name=name, uri=f"{name}.png"))
        self._finish(uri=f"{self._name}.bin")
        text = self._gltf.gltf_to_json(indent=2) + "\n"
        return {
            f"{self._name}.gltf": text.encode(),
            f"{self._name}.bin": bytes(self._stored.binary),
            **pictures,
        }

    def _finish(self, uri: str | None) -> None:
        self._gltf.buffers.append(self._model.Buffer(byteLength=len(self._stored.binary), uri=uri))
        if self._lights:
            self._gltf.extensions["KHR_lights_punctual"] = {"lights": self._lights}
        if self._variants:
            names = [{"name": name} for name in self._variants]
            self._gltf.extensions["KHR_materials_variants"] = {"variants": names}

    def _use(self, *extensions: str) -> None:
        self._gltf.extensionsUsed = sorted({*self._gltf.extensionsUsed, *extensions})

    def _variant(self, name: str) -> int:
        if name not in self._variants:
            self._variants.append(name)
            self._use("KHR_materials_variants")
        return self._variants.index(name)

    def _place(self, node: Any) -> None:
        self._gltf.nodes.append(node)
        self._gltf.scenes[0].nodes.append(len(self._gltf.nodes) - 1)

    def _camera(self, camera: Any, eye: ArrayLike, target: ArrayLike) -> None:
        self._gltf.cameras.append(camera)
        index = len(self._gltf.cameras) - 1
        self._place(
            self._model.Node(
                name="camera", camera=index, translation=rounded_list(eye), rotation=facing(eye, target)
            )
        )


def _texcoords_of(material: Any) -> set[int]:
    """Return the texture coordinates that `material` reads, with KHR_texture_transform and without."""
    infos = [
        dict(info) for e in material.extensions.values() for info in e.values() if isinstance(info, dict)
    ]
    read = {int(info.get("texCoord", 0)) for info in infos}
    transforms = [info.get("extensions", {}).get("KHR_texture_transform", {}) for info in infos]
    read |= {int(transform["texCoord"]) for transform in transforms if "texCoord" in transform}
    of_core = (material.pbrMetallicRoughness.baseColorTexture, material.normalTexture)
    return read | {0 for info in of_core if info is not None}
