"""CIEDE2000 between linear Rec.709 colours: CIELAB under D65, and the distance in it (CIE 142-2001).

Written here, and held to colour-science by the tests: that package takes a second to import, which every
command that tells one ΔE would take.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import rec709_to_xyz

__all__ = ["ciede2000", "cielab", "delta_e_2000"]

Float64 = NDArray[np.float64]

# CIE 15: below this share of the white the cube root goes over into its tangent.
_LINEAR_BELOW: Final = (6.0 / 29.0) ** 3
_CHROMA_BEND: Final = 25.0**7


def delta_e_2000(rgb_a: ArrayLike, rgb_b: ArrayLike) -> Float64:
    """Return CIEDE2000 (...) between linear Rec.709 colours (..., 3), CIELAB/D65; (1, 1, 1) is L* = 100.

    Negative channels, which no display shows, are cut to 0 on both sides; values above 1 are kept.
    """
    white = rec709_to_xyz(np.ones(3))
    lab_a, lab_b = (
        cielab(rec709_to_xyz(np.maximum(np.asarray(rgb, dtype=np.float64), 0.0)) / white)
        for rgb in (rgb_a, rgb_b)
    )
    return ciede2000(lab_a, lab_b)


def cielab(xyz_of_white: Float64) -> Float64:
    """Return L*, a*, b* (..., 3) of XYZ (..., 3), each a share of the white's.

    L* = 116 f(Y) − 16, a* = 500 (f(X) − f(Y)), b* = 200 (f(Y) − f(Z)); f is the cube root, from (6/29)³ down
    its tangent (CIE 15:2004, 8.2.1).
    """
    f = np.where(
        xyz_of_white > _LINEAR_BELOW,
        np.cbrt(xyz_of_white),
        xyz_of_white / (3.0 * (6.0 / 29.0) ** 2) + 4.0 / 29.0,
    )
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack((116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)), axis=-1)


def ciede2000(lab_1: Float64, lab_2: Float64) -> Float64:
    """Return CIEDE2000 (...) between two arrays of L*, a*, b* (..., 3), k_L = k_C = k_H = 1.

    Sharma, Wu and Dalal 2005, Eq. 2–22; hues in radians.
    """
    l_1, a_1, b_1 = np.moveaxis(np.asarray(lab_1, dtype=np.float64), -1, 0)
    l_2, a_2, b_2 = np.moveaxis(np.asarray(lab_2, dtype=np.float64), -1, 0)
    # a′ stretches a where there is little chroma.
    stretch = 1.5 - 0.5 * _bend(0.5 * (np.hypot(a_1, b_1) + np.hypot(a_2, b_2)))
    a_1, a_2 = stretch * a_1, stretch * a_2
    c_1, c_2 = np.hypot(a_1, b_1), np.hypot(a_2, b_2)
    h_1, h_2 = np.arctan2(b_1, a_1) % (2.0 * np.pi), np.arctan2(b_2, a_2) % (2.0 * np.pi)
    is_grey = c_1 * c_2 == 0.0

    # The shorter way round; a grey has no hue to differ in.
    turn = h_2 - h_1
    turn = turn - 2.0 * np.pi * ((turn > np.pi) * 1.0 - (turn < -np.pi) * 1.0)
    d_l, d_c = l_2 - l_1, c_2 - c_1
    d_h = 2.0 * np.sqrt(c_1 * c_2) * np.sin(0.5 * turn)

    l_mean, c_mean = 0.5 * (l_1 + l_2), 0.5 * (c_1 + c_2)
    together = h_1 + h_2
    is_wrapped = np.abs(h_1 - h_2) > np.pi
    half_turn = np.where(together < 2.0 * np.pi, np.pi, -np.pi)
    h_mean = np.where(is_grey, together, 0.5 * together + np.where(is_wrapped, half_turn, 0.0))

    t = (
        1.0
        - 0.17 * np.cos(h_mean - np.radians(30.0))
        + 0.24 * np.cos(2.0 * h_mean)
        + 0.32 * np.cos(3.0 * h_mean + np.radians(6.0))
        - 0.20 * np.cos(4.0 * h_mean - np.radians(63.0))
    )
    from_middle = (l_mean - 50.0) ** 2
    s_l = 1.0 + 0.015 * from_middle / np.sqrt(20.0 + from_middle)
    s_c = 1.0 + 0.045 * c_mean
    s_h = 1.0 + 0.015 * c_mean * t
    # In the blues, chroma and hue turn into each other.
    blue_turn = np.radians(30.0) * np.exp(-(((np.degrees(h_mean) - 275.0) / 25.0) ** 2))
    r_t = -2.0 * _bend(c_mean) * np.sin(2.0 * blue_turn)

    in_l, in_c, in_h = d_l / s_l, d_c / s_c, d_h / s_h
    squared = in_l**2 + in_c**2 + in_h**2 + r_t * in_c * in_h
    # Rounding may leave the quadratic form a hair below 0 where the colours are the same.
    return np.asarray(np.sqrt(np.maximum(squared, 0.0)), dtype=np.float64)


def _bend(chroma: Float64) -> Float64:
    """Return √(C⁷/(C⁷ + 25⁷)): near 0 for greys, near 1 for strong colours."""
    seventh = chroma**7
    return np.asarray(np.sqrt(seventh / (seventh + _CHROMA_BEND)), dtype=np.float64)
