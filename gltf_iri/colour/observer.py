"""The CIE 1931 2° observer and the illuminants, as functions of wavelength.

Colour matching functions are linear between their 1 nm values, D65 between its 5 nm values with the last one
(780 nm) held to 830 nm; `gltf_iri.colour.tables` says where the tables come from.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import Light, White
from gltf_iri.colour.tables import D65_FILE, OBSERVER_FILE

__all__ = ["WAVELENGTH_RANGE_NM", "colour_matching", "illuminant", "observer_table"]

Float64 = NDArray[np.float64]

WAVELENGTH_RANGE_NM: Final = (360.0, 830.0)


@cache
def observer_table() -> Float64:
    """Return (471, 4): wavelength in nm, then x̄, ȳ, z̄; read-only."""
    return _read(OBSERVER_FILE)


def colour_matching(wavelength_nm: ArrayLike) -> Float64:
    """Return x̄, ȳ, z̄ (..., 3) at `wavelength_nm` (...); zero outside 360–830 nm."""
    table = observer_table()
    wavelength = np.asarray(wavelength_nm, dtype=np.float64)
    curves = [np.interp(wavelength, table[:, 0], table[:, i], left=0.0, right=0.0) for i in (1, 2, 3)]
    return np.stack(curves, axis=-1)


def illuminant(wavelength_nm: ArrayLike, white: White) -> Float64:
    """Return the relative power (...) of `white`, E being flat, at `wavelength_nm` (...)."""
    wavelength = np.asarray(wavelength_nm, dtype=np.float64)
    if isinstance(white, Light):
        return np.asarray(white.power(wavelength), dtype=np.float64)
    if white == "E":
        return np.ones_like(wavelength)
    table = _d65_table()
    return np.asarray(np.interp(wavelength, table[:, 0], table[:, 1]))


@cache
def _d65_table() -> Float64:
    return _read(D65_FILE)


def _read(name: str) -> Float64:
    text = (files("gltf_iri.colour") / "data" / name).read_text(encoding="utf-8")
    table = np.loadtxt(text.splitlines(), delimiter=",", skiprows=1, dtype=np.float64)
    table.setflags(write=False)
    return table
