"""Tables that the GLSL twins sample: what fills each, and how it becomes a texture.

A method names its tables in `Method.glsl_tables`; the sampler in its shader has the table's name. Shaders
read single texels (texelFetch) and interpolate by themselves: graphics cards filter with weights of eight
bits, which would leave three digits of a colour.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import HALF_BANDWIDTH_PER_NM, colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.planning.method import ParameterValue

if TYPE_CHECKING:
    import moderngl

__all__ = ["OPTICS_TABLES", "SPECTRAL_DEGREE", "SPECTRAL_OPD_MAX_NM", "OpticsTableStore", "optics_table"]
__all__ += ["table_texture"]

Float32 = NDArray[np.float32]

# fill(white, **parameters of the method) → (rows, columns, channels), at most four channels
TableFill = Callable[..., Float32]

_CHANNELS: Final = 4

SPECTRAL_DEGREE: Final = 512

# Fringes of a longer path difference (some 100 µm) are not resolved by so many wavelengths.
SPECTRAL_OPD_MAX_NM: Final = SPECTRAL_DEGREE / (2.0 * np.pi * HALF_BANDWIDTH_PER_NM)


def _spectral_rule(white: White, **parameters: ParameterValue) -> Float32:
    """Return (2, SPECTRAL_DEGREE + 1, 3): 1/λ in 1/nm as a part of twelve bits and the rest; the weights."""
    rule = colour_rule(SPECTRAL_DEGREE, white)
    wavenumber = 1.0 / rule.wavelength_nm
    leading = (wavenumber.astype(np.float32).view(np.uint32) & np.uint32(0xFFFFF000)).view(np.float32)
    parts = np.column_stack([leading, wavenumber - leading, np.zeros_like(wavenumber)])
    return np.stack([parts, rule.weights]).astype(np.float32)


OPTICS_TABLES: Final[Mapping[str, TableFill]] = MappingProxyType({"spectral_rule": _spectral_rule})


def optics_table(name: str, white: str, parameters: Mapping[str, ParameterValue]) -> Float32:
    """Return the table called `name`, (rows, columns, channels); UsageError where there is none."""
    if name not in OPTICS_TABLES:
        raise UsageError(f"There is no table '{name}'; choose one of: {', '.join(OPTICS_TABLES)}.")
    return OPTICS_TABLES[name](white, **parameters)


def table_texture(context: moderngl.Context, table: Float32) -> moderngl.Texture:
    """Return `table` (rows, columns, 1–4 channels) as an RGBA32F texture, the caller's to release.

    Missing channels are 0; nothing filters or repeats. Raises MissingCapabilityError where OpenGL takes none
    so large.
    """
    rows, columns, channels = table.shape
    limit = context.info["GL_MAX_TEXTURE_SIZE"]
    if max(rows, columns) > limit:
        raise MissingCapabilityError(
            f"A table of {columns} × {rows} is wanted; this OpenGL takes textures up to {limit}."
        )
    texels = np.zeros((rows, columns, _CHANNELS), dtype=np.float32)
    texels[..., :channels] = table
    texture = context.texture((columns, rows), _CHANNELS, texels.tobytes(), dtype="f4")
    texture.filter = (context.NEAREST, context.NEAREST)
    texture.repeat_x = texture.repeat_y = False
    return texture


class OpticsTableStore:
    """The tables of one context, made when first needed and kept."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._textures: dict[tuple[str, str, tuple[tuple[str, ParameterValue], ...]], moderngl.Texture] = {}

    def textures(
        self, names: tuple[str, ...], white: str, parameters: Mapping[str, ParameterValue]
    ) -> dict[str, moderngl.Texture]:
        """Return the textures of the tables called `names`; they stay the store's."""
        made = {}
        for name in names:
            key = (name, white, tuple(sorted(parameters.items())))
            if key not in self._textures:
                self._textures[key] = table_texture(self._context, optics_table(name, white, parameters))
            made[name] = self._textures[key]
        return made

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for texture in self._textures.values():
            texture.release()
        self._textures.clear()
