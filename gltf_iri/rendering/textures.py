"""glTF textures as OpenGL textures: each image once for every colour space and sampler it is read with."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.moments import moment_levels
from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.material.interface import TextureBinding

if TYPE_CHECKING:
    import moderngl

    from gltf_iri.asset.document import Document
    from gltf_iri.asset.texture import Texture

__all__ = ["TextureStore"]

_RGBA8: Final = 0x8058
_SRGB8_ALPHA8: Final = 0x8C43
_TEXTURE_2D: Final = 0x0DE1
_TEXTURE_WRAP_S: Final = 0x2802
_TEXTURE_WRAP_T: Final = 0x2803
_LINEAR_MIPMAP_LINEAR: Final = 0x2703
_WITHOUT_MIPMAPS: Final = frozenset({0x2600, 0x2601})  # NEAREST, LINEAR


class TextureStore:
    """Uploads the textures of one document on demand; what no shader samples is never uploaded.

    float_textures : 32-bit linear texels decoded in float64, instead of the file's own 8 bits. Filtering then
        interpolates exact values, which is what float64 Python can be held against.
    base_level_only : neither mipmaps nor the minification filter, but the texels themselves through the
        magnification filter at every distance, which is what the CPU reference samples.
    """

    def __init__(
        self,
        context: moderngl.Context,
        document: Document,
        *,
        float_textures: bool = False,
        base_level_only: bool = False,
    ) -> None:
        self._context = context
        self._document = document
        self._float_textures = float_textures
        self._base_level_only = base_level_only
        self._textures: dict[tuple[Texture, str, str], moderngl.Texture] = {}

    def get(self, binding: TextureBinding) -> moderngl.Texture:
        """Return the texture of `binding`; MissingCapabilityError where OpenGL takes none so large."""
        sampler = self._document.texture(binding.texture)
        key = (sampler, binding.colour_space, binding.moments_of)
        if key not in self._textures:
            pixels = self._pixels(sampler)
            if binding.moments_of:
                texture = self._moments(pixels[..., "rgba".index(binding.moments_of)], sampler)
            else:
                texture = self._texels(pixels, sampler, is_srgb=binding.colour_space == "srgb")
            _set_wrapping(texture, sampler)
            self._textures[key] = texture
        return self._textures[key]

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for texture in self._textures.values():
            texture.release()
        self._textures.clear()

    def _pixels(self, sampler: Texture) -> NDArray[np.uint8]:
        pixels = self._document.image(sampler.image).pixels
        height, width = pixels.shape[:2]
        limit = self._context.info["GL_MAX_TEXTURE_SIZE"]
        if max(width, height) > limit:
            raise MissingCapabilityError(
                f"/images/{sampler.image} is {width} × {height}; this OpenGL takes textures up to {limit}."
            )
        return pixels

    def _texels(self, pixels: NDArray[np.uint8], sampler: Texture, *, is_srgb: bool) -> moderngl.Texture:
        size = (pixels.shape[1], pixels.shape[0])
        if self._float_textures:
            texture = self._context.texture(size, 4, _linear(pixels, is_srgb).tobytes(), dtype="f4")
        else:
            stored = _SRGB8_ALPHA8 if is_srgb else _RGBA8
            texture = self._context.texture(size, 4, pixels.tobytes(), internal_format=stored)
        min_filter = sampler.mag_filter if self._base_level_only else sampler.min_filter
        if min_filter not in _WITHOUT_MIPMAPS:
            texture.build_mipmaps()
        texture.filter = (min_filter, sampler.mag_filter)
        return texture

    def _moments(self, channel: NDArray[np.uint8], sampler: Texture) -> moderngl.Texture:
        """Return the moments of a channel (height, width), filtered over the pixel whatever the sampler says.

        A sampler without mipmaps shows one texel of all that a pixel spans. Of a thickness this is a colour
        that flickers, which is no look of the surface.
        """
        size = (channel.shape[1], channel.shape[0])
        levels = moment_levels(channel)
        texture = self._context.texture(size, 2, next(levels).tobytes(), dtype="f4")
        if self._base_level_only:
            texture.filter = (sampler.mag_filter, sampler.mag_filter)
            return texture
        texture.build_mipmaps()  # makes room for the levels, which then are written
        for number, level in enumerate(levels, start=1):
            texture.write(level.tobytes(), level=number)
        texture.filter = (_LINEAR_MIPMAP_LINEAR, sampler.mag_filter)
        return texture


def _linear(pixels: NDArray[np.uint8], is_srgb: bool) -> NDArray[np.float32]:
    """Return linear float32 texels; alpha is linear in every colour space."""
    levels = np.arange(256) / 255.0
    values = levels.astype(np.float32)[pixels]
    if is_srgb:
        values[..., :3] = srgb_decode(levels).astype(np.float32)[pixels[..., :3]]
    return values


def _set_wrapping(texture: moderngl.Texture, sampler: Texture) -> None:
    """Set wrapS and wrapT through OpenGL itself: moderngl knows repeating and clamping, but no mirroring."""
    set_parameter = _entry_point("glTexParameteri")
    texture.use(0)
    set_parameter(_TEXTURE_2D, _TEXTURE_WRAP_S, sampler.wrap_s)
    set_parameter(_TEXTURE_2D, _TEXTURE_WRAP_T, sampler.wrap_t)


def _entry_point(name: str) -> ctypes._NamedFuncPointer | ctypes._FuncPointer:
    """Return the OpenGL function glX(GLenum, GLenum, GLint) called `name`."""
    egl = ctypes.CDLL("libEGL.so.1")
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    address = egl.eglGetProcAddress(name.encode())
    if not address:
        raise MissingCapabilityError(f"This OpenGL has no {name}.")
    return ctypes.CFUNCTYPE(None, ctypes.c_uint, ctypes.c_uint, ctypes.c_int)(address)
