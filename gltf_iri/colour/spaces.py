"""Linear Rec.709 and CIE XYZ, and what "white" means here.

The extension's text gives its XYZ → Rec.709 matrix to seven decimals; method `khr` uses it as printed. Truth
uses the same primaries with each row scaled, so that a surface that reflects everything is exactly (1, 1, 1)
under the chosen white (`gltf_iri.colour.integrate`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "WHITES",
    "XYZ_TO_REC709",
    "Light",
    "White",
    "WhiteName",
    "rec709_to_xyz",
    "rgb_matrix",
    "xyz_to_rec709",
]

WhiteName = Literal["D65", "E"]

WHITES: Final[tuple[WhiteName, ...]] = ("D65", "E")

# KHR_materials_iridescence, Analytic Spectral Integration; rows give R, G, B (GLSL writes it by columns).
XYZ_TO_REC709: Final[NDArray[np.float64]] = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)
XYZ_TO_REC709.setflags(write=False)


@dataclass(frozen=True, eq=False)
class Light:
    """A light and the RGB space that it is white in, beside those shipped; its tables are made once.

    name : what reports call it, as they do through ``str``.
    power : (...) nm → (...), relative spectral power; smooth within each whole nanometre from 360 to 830.
    xyz_to_rgb : (3, 3), rows give R, G, B, each scaled so that R ≡ 1 is 1; None for Rec.709.
    """

    name: str
    power: Callable[[NDArray[Any]], NDArray[Any]]
    xyz_to_rgb: ArrayLike | None = None

    def __str__(self) -> str:
        return self.name


White = WhiteName | Light


def rgb_matrix(white: White) -> NDArray[np.float64]:
    """Return the matrix (3, 3) from XYZ to the RGB space of `white`."""
    own = white.xyz_to_rgb if isinstance(white, Light) else None
    return np.asarray(XYZ_TO_REC709 if own is None else own, dtype=np.float64)


def xyz_to_rec709(xyz: ArrayLike) -> NDArray[np.float64]:
    """Map XYZ (..., 3) to linear Rec.709 (..., 3) with the text's own matrix."""
    return np.asarray(xyz, dtype=np.float64) @ XYZ_TO_REC709.T


def rec709_to_xyz(rgb: ArrayLike) -> NDArray[np.float64]:
    """Map linear Rec.709 (..., 3) to XYZ (..., 3): the inverse of `xyz_to_rec709`."""
    return np.asarray(rgb, dtype=np.float64) @ np.linalg.inv(XYZ_TO_REC709).T
