"""textureInfo and its transform: which texture, which UV set, and where on it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import extension, index, number, reference, vector

__all__ = ["Matrix3", "NormalTextureInfo", "OcclusionTextureInfo", "TextureInfo", "TextureTransform"]

Matrix3 = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]  # rows

_IDENTITY: Matrix3 = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class TextureTransform:
    """KHR_texture_transform: uv′ = translation · rotation · scale · uv."""

    EXTENSION: ClassVar[str] = "KHR_texture_transform"

    offset: tuple[float, float] = vector("offset", (0.0, 0.0), "Shift of the origin, in texture sizes.")
    rotation_rad: float = number("rotation", 0.0, "Counter-clockwise rotation about the origin.", unit="rad")
    scale: tuple[float, float] = vector("scale", (1.0, 1.0), "Scale of the coordinates.")
    tex_coord: int | None = index("texCoord", None, "UV set that replaces the textureInfo's.")

    @property
    def matrix(self) -> Matrix3:
        """Rows of the matrix that maps (u, v, 1) to the coordinates that are sampled.

        glTF's v points down, so a rotation that is counter-clockwise in (u, v) has +sin in its first row. The
        extension's listing has the other sign; its text, its test model and all viewers have this one
        (KhronosGroup/glTF issue 1563).
        """
        c, s = math.cos(self.rotation_rad), math.sin(self.rotation_rad)
        (u, v), (x, y) = self.offset, self.scale
        return ((c * x, s * y, u), (-s * x, c * y, v), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class TextureInfo:
    """A reference to a texture and the UV set it is read with."""

    texture: int = reference("index", "textures", "The texture.")
    tex_coord: int = index("texCoord", 0, "Which TEXCOORD_n attribute is read.")
    transform: TextureTransform | None = extension(TextureTransform, "Offset, rotation and scale.")

    @property
    def uv_set(self) -> int:
        """The UV set in force: the transform's texCoord overrides the textureInfo's."""
        if self.transform is not None and self.transform.tex_coord is not None:
            return self.transform.tex_coord
        return self.tex_coord

    @property
    def uv_matrix(self) -> Matrix3:
        """Rows of the matrix from the vertex's (u, v, 1) to the coordinates that are sampled."""
        return _IDENTITY if self.transform is None else self.transform.matrix


@dataclass(frozen=True, slots=True)
class NormalTextureInfo(TextureInfo):
    """A tangent-space normal map."""

    scale: float = number("scale", 1.0, "Multiplies x and y of each sampled normal.")


@dataclass(frozen=True, slots=True)
class OcclusionTextureInfo(TextureInfo):
    """An ambient occlusion map."""

    strength: float = number("strength", 1.0, "How much of the occlusion applies.", low=0.0, high=1.0)
