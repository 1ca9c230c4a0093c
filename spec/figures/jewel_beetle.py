"""Draws jewel-beetle.png and prints its colours: `python spec/figures/jewel_beetle.py` in a checkout.

The three areas of a jewel beetle's cuticle in Fourneau et al. 2024, Table 3, smooth and under air (Appendix
D), from 0° to 80°. The table's δ is read as d₁/Λ; the other reading, d₂/Λ, is printed beside it.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate

__all__ = ["main"]

Float64 = NDArray[np.float64]

# Area → n₁, n₂, Λ in nm, δ, N.
AREAS: Final = {
    "green/blue (a)": (1.59, 1.67, 160.0, 0.51, 8),
    "red (b)": (1.60, 1.68, 190.0, 0.51, 8),
    "purple (c)": (1.60, 1.68, 205.0, 0.51, 6),
}
PRINTED_DEG: Final = np.arange(0, 81, 10)
HOST_IOR: Final = 1.0


def colours(area: str, angles_deg: Float64, *, delta_is_first: bool, method: str = "yeh-spectral") -> Float64:
    """Return linear Rec.709 (..., 3) under D65 of an area at `angles_deg` (...)."""
    n1, n2, period_nm, delta, cells = AREAS[area]
    first = delta if delta_is_first else 1.0 - delta
    cosine = np.cos(np.radians(angles_deg))
    mirror = Mirror.of(cosine, n1, n2, first * period_nm, (1.0 - first) * period_nm, cells, HOST_IOR)
    return evaluate(method, mirror).rgb


def table() -> str:
    """Return the colours and what the other reading of δ changes, as Markdown."""
    lines = ["| area | θ | R | G | B | ΔE2000 of δ = d₂/Λ |", "|---|---|---|---|---|---|"]
    for area in AREAS:
        read, other = (colours(area, PRINTED_DEG, delta_is_first=first) for first in (True, False))
        changes = delta_e_2000(read, other)
        for angle, rgb, change in zip(PRINTED_DEG, read, changes, strict=True):
            values = " | ".join(f"{v:.4f}" for v in rgb)
            lines.append(f"| {area} | {angle}° | {values} | {change:.2f} |")
    return "\n".join(lines)


def main() -> None:
    """Draw the strips, five times as bright as they are, and print the table."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    angles = np.linspace(0.0, 80.0, 321)
    figure, axes = pyplot.subplots(3, 1, figsize=(6.0, 3.0), sharex=True, constrained_layout=True)
    for axis, area in zip(axes, AREAS, strict=True):
        strip = np.clip(5.0 * colours(area, angles, delta_is_first=True), 0.0, 1.0)
        axis.imshow(srgb_encode(strip)[None], extent=(0, 80, 0, 1), aspect="auto")
        axis.set_yticks([])
        axis.set_title(area, fontsize=8)
    axes[-1].set_xlabel("θ (°)", fontsize=8)
    figure.savefig(Path(__file__).with_name("jewel-beetle.png"), dpi=80)
    sys.stdout.write(table() + "\n")


if __name__ == "__main__":
    main()
