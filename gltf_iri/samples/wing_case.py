"""The back of a beetle: bands of an egg-shaped shell with a groove where the two wing cases meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.shapes import Shape, grid

__all__ = ["Shell"]

Float64 = NDArray[np.float64]

# How deep the groove is, as a share of the height, and how wide, in rad about the shell's axis.
_GROOVE_DEPTH, _GROOVE_WIDTH = 0.16, 0.09


@dataclass(frozen=True, slots=True)
class Shell:
    """An egg about Z, its blunt end at −Z: P(φ, ψ) = (W S(ψ) sin φ, H S(ψ) Y(φ), −L cos ψ), in m.

    S = sin ψ (1 + k cos ψ) tapers it by k, and Y = cos φ less the groove. φ is 0 on top, ψ runs from the
    blunt end (0) to the pointed one (π).
    """

    half_width_m: float
    height_m: float
    half_length_m: float
    taper: float
    is_grooved: bool = True

    def band(
        self, first: Callable[[Float64], Float64], last: Callable[[Float64], Float64], columns: int, rows: int
    ) -> Shape:
        """Return the part between the azimuths first(ψ) and last(ψ), rad, first < last.

        u is φ/π and v is ψ/π, so that textures run on over neighbouring bands.
        """
        psi = np.linspace(0.0, np.pi, rows + 1)[:, None]
        share = np.linspace(0.0, 1.0, columns + 1)[None, :]
        phi = first(psi) + (last(psi) - first(psi)) * share
        psi = np.broadcast_to(psi, phi.shape)
        height, height_slope = self._profile(phi)
        sine, cosine = np.sin(psi), np.cos(psi)
        girth = sine * (1.0 + self.taper * cosine)
        girth_slope = cosine + self.taper * (cosine**2 - sine**2)
        w, h, length = self.half_width_m, self.height_m, self.half_length_m
        positions = np.stack([w * girth * np.sin(phi), h * girth * height, -length * cosine], axis=-1)
        # ∂P/∂φ less its factor S, which vanishes at the ends and leaves the direction.
        around = np.stack([w * np.cos(phi), h * height_slope, np.zeros_like(phi)], axis=-1)
        along = np.stack(
            [w * girth_slope * np.sin(phi), h * girth_slope * height, length * sine],
            axis=-1,
        )
        return grid(positions, np.cross(along, around), around, np.stack([phi, psi], axis=-1) / np.pi)

    def _profile(self, phi: Float64) -> tuple[Float64, Float64]:
        """Return Y(φ) and its slope."""
        if not self.is_grooved:
            return np.cos(phi), -np.sin(phi)
        groove = _GROOVE_DEPTH * np.exp(-((phi / _GROOVE_WIDTH) ** 2))
        return np.cos(phi) - groove, -np.sin(phi) + groove * 2.0 * phi / _GROOVE_WIDTH**2
