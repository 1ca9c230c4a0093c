"""Tables that the GLSL twins sample: what fills each, and how it becomes a texture.

A method names its tables in `Method.glsl_tables`; the sampler in its shader has the table's name. Shaders
read single texels (texelFetch) and interpolate by themselves: graphics cards filter with weights of eight
bits, which would leave three digits of a colour.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.bands import bands_of
from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, colour_rule
from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.evaluation.bloch import bloch_table
from gltf_iri.evaluation.landmarks import cumulative_table
from gltf_iri.evaluation.layers_bands import LAYER_BANDS
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.line_words import line_words
from gltf_iri.rendering.spread_table import film_sensitivity_spread

if TYPE_CHECKING:
    import moderngl

__all__ = ["OPTICS_TABLES", "SENSITIVITY_FINE_END_NM", "SENSITIVITY_FINE_PER_NM", "SENSITIVITY_LAST"]
__all__ += [
    "SENSITIVITY_MAX",
    "SENSITIVITY_ROW",
    "SENSITIVITY_ROWS",
    "SENSITIVITY_ROW_BITS",
    "SENSITIVITY_SLOPE_BITS",
    "SENSITIVITY_SLOPE_MAX",
    "SPECTRAL_COARSE_DEGREE",
    "SPECTRAL_SMOOTH_DEGREE",
]
__all__ += ["OpticsTableStore", "Table", "optics_table", "table_texture"]

Float32 = NDArray[np.float32]
UInt32 = NDArray[np.uint32]
Table = Float32 | UInt32  # uint32 fills a usampler2D

# fill(white, **parameters of the method) → (rows, columns, channels), at most four channels
TableFill = Callable[..., Table]

_CHANNELS: Final = 4

# Spectra without fringes, of films that are very thin or frustrated.
SPECTRAL_SMOOTH_DEGREE: Final = 32

# Of spectra averaged over the facets of a rough layer; every fourth wavelength of the whole rule.
SPECTRAL_COARSE_DEGREE: Final = SPECTRAL_DEGREE // 4

# Each texel holds lines, which err by h²/16 · |Ŝ″|: 1e-6 at a quarter of a nanometre, and beyond the fine
# part, where |Ŝ| has fallen below 0.05, no more at a whole one. The fine part ends half way between texels.
SENSITIVITY_FINE_PER_NM: Final = 4
SENSITIVITY_FINE_END_NM: Final = 4096 + 0.5 / SENSITIVITY_FINE_PER_NM

# A line in 32 bits: its value, and in the last ones its slope from texel to texel; rounding costs 2e-6.
# The limits are what |Re Ŝ|, |Im Ŝ| and their slopes stay below, under either white.
SENSITIVITY_MAX: Final = 1.6
SENSITIVITY_SLOPE_MAX: Final = 0.0045
SENSITIVITY_SLOPE_BITS: Final = 11

SENSITIVITY_ROW_BITS: Final = 10
SENSITIVITY_ROW: Final = 1 << SENSITIVITY_ROW_BITS
SENSITIVITY_LAST: Final = math.ceil(SENSITIVITY_FINE_END_NM * (SENSITIVITY_FINE_PER_NM - 1) + END_NM)
SENSITIVITY_ROWS: Final = SENSITIVITY_LAST // SENSITIVITY_ROW + 1


def _spectral_rule(white: White, **parameters: ParameterValue) -> Float32:
    """Return (4, SPECTRAL_DEGREE + 1, 4).

    The first row holds 1/λ in 1/nm as a part of twelve bits and the rest, the second the weights, the third
    weights and 1/λ of the rule of SPECTRAL_SMOOTH_DEGREE, the last the weights of that of
    SPECTRAL_COARSE_DEGREE, whose wavelengths are each fourth of the first row.
    """
    rows = np.zeros((4, SPECTRAL_DEGREE + 1, 4), dtype=np.float32)
    rule, smooth = colour_rule(SPECTRAL_DEGREE, white), colour_rule(SPECTRAL_SMOOTH_DEGREE, white)
    wavenumber = 1.0 / rule.wavelength_nm
    leading = (wavenumber.astype(np.float32).view(np.uint32) & np.uint32(0xFFFFF000)).view(np.float32)
    rows[0, :, 0], rows[0, :, 1] = leading, wavenumber - leading
    rows[1, :, :3] = rule.weights
    rows[2, : SPECTRAL_SMOOTH_DEGREE + 1, :3] = smooth.weights
    rows[2, : SPECTRAL_SMOOTH_DEGREE + 1, 3] = 1.0 / smooth.wavelength_nm
    rows[3, : SPECTRAL_COARSE_DEGREE + 1, :3] = colour_rule(SPECTRAL_COARSE_DEGREE, white).weights
    return rows


def _layer_bands(white: White, bands: int = LAYER_BANDS, **parameters: ParameterValue) -> Float32:
    """Return (rows, SPECTRAL_COARSE_DEGREE + 4, 4): four bands a row, the last filled up with 0.

    For each wavelength of the coarse rule what it adds to the means, then the weights in red, green, blue.
    """
    rule, held = colour_rule(SPECTRAL_COARSE_DEGREE, white), bands_of(bands, white)
    columns = np.concatenate([held.shares(rule), held.weights.T])
    padded = np.zeros((len(columns), -(-bands // _CHANNELS) * _CHANNELS), dtype=np.float32)
    padded[:, :bands] = columns
    return np.ascontiguousarray(padded.reshape(len(columns), -1, _CHANNELS).swapaxes(0, 1))


def _film_sensitivity(white: White, tolerance: float = 1.0, **parameters: ParameterValue) -> UInt32:
    """Return (2 · SENSITIVITY_ROWS, SENSITIVITY_ROW, 4): Re Ŝ, and in the rows after it Im Ŝ.

    From texel to texel the path difference grows by 1/SENSITIVITY_FINE_PER_NM, and from
    SENSITIVITY_FINE_END_NM on by 1 nm. Three channels are lines (`_words`); the fourth is the float32 of the
    envelope over half of `tolerance`.
    """
    table = sensitivity_table(white)
    # Before, at and after each texel: where its line begins, and ends.
    place = np.arange(SENSITIVITY_LAST)[:, None] + np.array([-0.5, 0.0, 0.5])
    opd_nm = np.maximum(
        place / SENSITIVITY_FINE_PER_NM, place - (SENSITIVITY_FINE_PER_NM - 1) * SENSITIVITY_FINE_END_NM
    )
    values = table.at(opd_nm)
    texels = np.zeros((2, SENSITIVITY_ROWS * SENSITIVITY_ROW, 4), dtype=np.uint32)
    texels[0, :SENSITIVITY_LAST, :3], texels[1, :SENSITIVITY_LAST, :3] = (
        _words(values.real),
        _words(values.imag),
    )
    bound = table.bound(opd_nm[:, 1]) * (2.0 / tolerance)
    texels[0, :SENSITIVITY_LAST, 3] = bound.astype(np.float32).view(np.uint32)
    return texels.reshape(-1, SENSITIVITY_ROW, 4)


def _words(values: NDArray[np.float64]) -> UInt32:
    """Return (n, 3): the lines through `values` (n, 3 places, 3 channels)."""
    return line_words(
        *np.moveaxis(values, 1, 0),
        value_max=SENSITIVITY_MAX,
        slope_max=SENSITIVITY_SLOPE_MAX,
        slope_bits=SENSITIVITY_SLOPE_BITS,
    )


OPTICS_TABLES: Final[Mapping[str, TableFill]] = MappingProxyType(
    {
        "spectral_rule": _spectral_rule,
        "film_sensitivity": _film_sensitivity,
        "film_sensitivity_spread": film_sensitivity_spread,
        "cumulative_colour": cumulative_table,
        "bloch_weights": bloch_table,
        "layer_bands": _layer_bands,
    }
)


def optics_table(name: str, white: str, parameters: Mapping[str, ParameterValue]) -> Table:
    """Return the table called `name`, (rows, columns, channels); UsageError where there is none."""
    if name not in OPTICS_TABLES:
        raise UsageError(f"There is no table '{name}'; choose one of: {', '.join(OPTICS_TABLES)}.")
    return OPTICS_TABLES[name](white, **parameters)


def table_texture(context: moderngl.Context, table: Table) -> moderngl.Texture:
    """Return `table` (rows, columns, 1–4 channels) as a texture, the caller's to release.

    It is RGBA32F or, of uint32, RGBA32UI; missing channels are 0; nothing filters or repeats. Raises
    MissingCapabilityError where OpenGL takes none so large.
    """
    rows, columns, channels = table.shape
    limit = context.info["GL_MAX_TEXTURE_SIZE"]
    if max(rows, columns) > limit:
        raise MissingCapabilityError(
            f"A table of {columns} × {rows} is wanted; this OpenGL takes textures up to {limit}."
        )
    texels = np.zeros((rows, columns, _CHANNELS), dtype=table.dtype)
    texels[..., :channels] = table
    kind = "u4" if table.dtype == np.uint32 else "f4"
    texture = context.texture((columns, rows), _CHANNELS, texels.tobytes(), dtype=kind)
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
