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
from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.evaluation.bloch import bloch_table
from gltf_iri.evaluation.landmarks import cumulative_table
from gltf_iri.planning.method import ParameterValue

if TYPE_CHECKING:
    import moderngl

__all__ = ["OPTICS_TABLES", "SENSITIVITY_FINE_END_NM", "SENSITIVITY_FINE_PER_NM", "SENSITIVITY_LAST"]
__all__ += [
    "SENSITIVITY_ROW",
    "SENSITIVITY_ROWS",
    "SENSITIVITY_ROW_BITS",
    "SPECTRAL_DEGREE",
    "SPECTRAL_OPD_MAX_NM",
    "SPECTRAL_SMOOTH_DEGREE",
]
__all__ += ["OpticsTableStore", "optics_table", "table_texture"]

Float32 = NDArray[np.float32]

# fill(white, **parameters of the method) → (rows, columns, channels), at most four channels
TableFill = Callable[..., Float32]

_CHANNELS: Final = 4

SPECTRAL_DEGREE: Final = 512

# Spectra without fringes, of films that are very thin or frustrated.
SPECTRAL_SMOOTH_DEGREE: Final = 32

# Ŝ between texels is read linearly, which errs by h²/8 · |Ŝ″|: 2e-6 at a quarter of a nanometre, and beyond
# the fine part, where |Ŝ| has fallen below 0.05, no more at a whole one.
SENSITIVITY_FINE_PER_NM: Final = 4
SENSITIVITY_FINE_END_NM: Final = 4096
SENSITIVITY_ROW_BITS: Final = 10
SENSITIVITY_ROW: Final = 1 << SENSITIVITY_ROW_BITS
SENSITIVITY_LAST: Final = SENSITIVITY_FINE_END_NM * (SENSITIVITY_FINE_PER_NM - 1) + int(END_NM)
SENSITIVITY_ROWS: Final = SENSITIVITY_LAST // SENSITIVITY_ROW + 1

# Fringes of a longer path difference (some 100 µm) are not resolved by so many wavelengths.
SPECTRAL_OPD_MAX_NM: Final = SPECTRAL_DEGREE / (2.0 * np.pi * HALF_BANDWIDTH_PER_NM)


def _spectral_rule(white: White, **parameters: ParameterValue) -> Float32:
    """Return (3, SPECTRAL_DEGREE + 1, 4).

    The first row holds 1/λ in 1/nm as a part of twelve bits and the rest, the second the weights, the third
    weights and 1/λ of the rule of SPECTRAL_SMOOTH_DEGREE.
    """
    rows = np.zeros((3, SPECTRAL_DEGREE + 1, 4), dtype=np.float32)
    rule, smooth = colour_rule(SPECTRAL_DEGREE, white), colour_rule(SPECTRAL_SMOOTH_DEGREE, white)
    wavenumber = 1.0 / rule.wavelength_nm
    leading = (wavenumber.astype(np.float32).view(np.uint32) & np.uint32(0xFFFFF000)).view(np.float32)
    rows[0, :, 0], rows[0, :, 1] = leading, wavenumber - leading
    rows[1, :, :3] = rule.weights
    rows[2, : SPECTRAL_SMOOTH_DEGREE + 1, :3] = smooth.weights
    rows[2, : SPECTRAL_SMOOTH_DEGREE + 1, 3] = 1.0 / smooth.wavelength_nm
    return rows


def _film_sensitivity(white: White, tolerance: float = 1.0, **parameters: ParameterValue) -> Float32:
    """Return (2 · SENSITIVITY_ROWS, SENSITIVITY_ROW + 1, 4): Re Ŝ, and in the rows after it Im Ŝ.

    From texel to texel the path difference grows by 1/SENSITIVITY_FINE_PER_NM, and from
    SENSITIVITY_FINE_END_NM on by 1 nm; a row's last texel is the next one's first. The fourth channel is the
    envelope over half of `tolerance`.
    """
    fine_nm = np.arange(SENSITIVITY_FINE_END_NM * SENSITIVITY_FINE_PER_NM) / SENSITIVITY_FINE_PER_NM
    opd_nm = np.concatenate([fine_nm, np.arange(SENSITIVITY_FINE_END_NM, END_NM)])
    table = sensitivity_table(white)
    texels = np.zeros((2, SENSITIVITY_ROWS * SENSITIVITY_ROW + 1, 4))
    values = table.at(opd_nm)
    texels[0, : len(opd_nm), :3], texels[1, : len(opd_nm), :3] = values.real, values.imag
    texels[0, : len(opd_nm), 3] = table.bound(opd_nm) * (2.0 / tolerance)
    starts = SENSITIVITY_ROW * np.arange(SENSITIVITY_ROWS)[:, None]
    rows = texels[:, starts + np.arange(SENSITIVITY_ROW + 1)]
    return rows.reshape(-1, SENSITIVITY_ROW + 1, 4).astype(np.float32)


OPTICS_TABLES: Final[Mapping[str, TableFill]] = MappingProxyType(
    {
        "spectral_rule": _spectral_rule,
        "film_sensitivity": _film_sensitivity,
        "cumulative_colour": cumulative_table,
        "bloch_weights": bloch_table,
    }
)


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
