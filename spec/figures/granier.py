"""Draws granier.webp, Granier & Heidrich 2003, Fig. 3–6: `python spec/figures/granier.py` in a checkout.

Printed there: for Fig. 4 lobes 90 and 170, indices 1.4, 1.45, 1.6 and 66–76 nm, specular to diffuse 1 : 0.7;
for Fig. 6 indices 1.5, 1.6, 1.8, a deviation of 14°, lobes 130, specular to diffuse 1 : 0.5. All else is
chosen here: spheres, one lamp, the noise, and the numbers below that no figure prints. The GLSL twin colours.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.rendering.context import create_context
from gltf_iri.rendering.picture import webp_bytes
from gltf_iri.rendering.probe import Probe

__all__ = ["main"]

Float64 = NDArray[np.float64]

SIZE = 160  # pixels of one sphere
OVERSAMPLED = 2
FILE = "optics/granier_heidrich.glsl"
VIEW = np.array([0.0, 0.0, 1.0])
LAMP = np.array([-0.35, 0.45, 0.82]) / np.linalg.norm([-0.35, 0.45, 0.82])
BACKDROP = 0.05  # linear


@dataclass(frozen=True)
class Ball:
    """One sphere of the figure; thickness runs over its range as the noise does."""

    figure: str
    layer_ior: tuple[float, float, float]
    thickness_nm: tuple[float, float]
    specular: float = 0.0
    diffuse: float = 0.0
    exponents: tuple[float, float] = (90.0, 170.0)
    deviation_deg: float = 0.0
    slope: float = 0.0  # how far the inner boundary leans as the thickness runs over its range
    octaves: int = 5


METAL, WIDE = (1.4, 1.45, 1.6), (1.5, 1.6, 1.8)
ROWS = (
    (
        Ball("3", METAL, (60.0, 90.0), diffuse=0.5),
        Ball("3", METAL, (100.0, 900.0), diffuse=0.5),
        Ball("3", METAL, (60.0, 75.0), diffuse=0.5, octaves=2),
    ),
    (
        Ball("4", METAL, (66.0, 76.0), specular=1.0, diffuse=0.7),
        Ball("4", METAL, (66.0, 76.0), specular=1.0, diffuse=0.7, deviation_deg=14.0),
        Ball("5", METAL, (150.0, 550.0), specular=0.9, exponents=(12.0, 12.0), slope=0.06, octaves=3),
    ),
    (
        Ball("6", WIDE, (66.0, 76.0), 1.0, 0.5, (130.0, 130.0), deviation_deg=14.0),
        Ball("6", WIDE, (120.0, 160.0), 1.0, 0.5, (130.0, 130.0), deviation_deg=14.0),
        Ball("6", WIDE, (200.0, 600.0), 1.0, 0.5, (130.0, 130.0), deviation_deg=14.0),
    ),
)


def noise(points: Float64, octaves: int) -> Float64:
    """Return a sum of sines of random directions at (p, 3), each octave twice as fine, in [0, 1]: (p,)."""
    g = np.random.default_rng(2003)
    total = np.zeros(len(points))
    for octave in range(octaves):
        waves = g.normal(size=(6, 3)) * 3.0 * 2.0**octave
        total += np.sin(points @ waves.T + g.uniform(0, 2 * np.pi, 6)).sum(axis=1) / 6.0 * 0.6**octave
    return np.clip(0.5 + 0.75 * total, 0.0, 1.0)


def draw(probe: Probe, ball: Ball) -> Float64:
    """Return the linear picture of one sphere, (SIZE, SIZE, 3)."""
    side = SIZE * OVERSAMPLED
    x, y = np.meshgrid(*[(np.arange(side) + 0.5) / side * 2.2 - 1.1] * 2)
    x, y = x.ravel(), -y.ravel()
    seen = x * x + y * y < 1.0
    normal = np.column_stack([x[seen], y[seen], np.sqrt(1.0 - x[seen] ** 2 - y[seen] ** 2)])
    tangent = np.cross([0.0, 1.0, 0.0], normal)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    bitangent = np.cross(normal, tangent)

    height = noise(normal, ball.octaves)
    step = 1e-3
    slope_x, slope_y = (
        ball.slope * (noise(normal + step * along, ball.octaves) - height) / step
        for along in (tangent, bitangent)
    )
    lean = np.tan(np.radians(ball.deviation_deg))
    inner = probe.call("inner_normal", FILE, [normal, tangent, bitangent, slope_x + lean, slope_y])
    low_nm, high_nm = ball.thickness_nm
    thickness_nm = low_nm + (high_nm - low_nm) * height

    layer_ior = np.broadcast_to(ball.layer_ior, normal.shape)
    lit = np.maximum(normal @ LAMP, 0.0)[:, None]
    light, view = (np.broadcast_to(a, normal.shape) for a in (LAMP, VIEW))
    specular = probe.call(
        "layered_reflection",
        FILE,
        [light, view, normal, inner, 1.0, layer_ior, thickness_nm, *ball.exponents],
        argument_types=["vec3"] * 4 + ["float", "vec3"] + ["float"] * 3,
    )
    diffuse = probe.call(
        "layered_diffuse", FILE, [1.0, layer_ior, thickness_nm], argument_types=["float", "vec3", "float"]
    )
    picture = np.full((side * side, 3), BACKDROP)
    picture[seen] = ball.specular * specular * lit + ball.diffuse * diffuse * lit / 2.0
    return picture.reshape(SIZE, OVERSAMPLED, SIZE, OVERSAMPLED, 3).mean(axis=(1, 3))


def main() -> None:
    """Draw the rows, Fig. 3 on top, into granier.webp beside this file."""
    context = create_context()
    probe = Probe(context)
    rows = [np.concatenate([draw(probe, ball) for ball in row], axis=1) for row in ROWS]
    pixels = srgb_encode(np.clip(np.concatenate(rows, axis=0), 0.0, 1.0)) * 255.0
    Path(__file__).with_name("granier.webp").write_bytes(webp_bytes(pixels.round().astype(np.uint8)))
    context.release()


if __name__ == "__main__":
    main()
