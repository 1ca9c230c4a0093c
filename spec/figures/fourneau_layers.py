"""Draws Fourneau et al. 2024, Fig. 6 to 12: `python spec/figures/fourneau_layers.py [NUMBER …]`.

In a checkout; minutes for all. Fig. 6, 7 and 9 are drawn here, the others by fourneau_spheres.py. What is
printed and what is chosen stands with each figure.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import fourneau_spheres as spheres
import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.layers_sphere import RingSampler, SpherePixels, modelled, simulated
from gltf_iri.bench.layers_table2 import CONFIGURATIONS, LAYER_A, baked_colours
from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.evaluation.layers import LayerBase, LayerStack
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.rough_bragg import facet_weight, transmission_filter
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.layers_facets import StackFacets
from gltf_iri.rendering.picture import display_pixels, webp_bytes
from gltf_iri.scene.environment import studio

__all__ = ["AREAS", "FIGURES", "FIGURE_7", "main", "white_sky"]

Float64 = NDArray[np.float64]
HERE: Final = Path(__file__).parent

# Fig. 6. Printed: the angles of light, and α 0.4 for the rougher; chosen: α 0.1.
ALPHAS_6: Final = (0.1, 0.4)
ANGLES_6: Final = {"π/32": np.pi / 32.0, "π/4": np.pi / 4.0, "7π/16": 7.0 * np.pi / 16.0}

# Fig. 7. Printed: A, B, N 10, ρ_d 0.5, and A' of n₁ 1.35; chosen: which stands on which, the studio.
_COATED = replace(LAYER_A, n1=np.asarray(1.35))
FIGURE_7: Final[Mapping[str, LayerStack]] = {
    **CONFIGURATIONS,
    "A' on ρ 0.5": LayerStack.of((_COATED,), 1.35, LayerBase.of(0.5)),
}

# Fig. 9, Table 3. Printed: n₁, n₂, Λ in nm, δ, N; α 0.05, black base, host air. δ is read as d₁/Λ.
AREAS: Final = {
    "green/blue (a)": (1.59, 1.67, 160.0, 0.51, 8),
    "red (b)": (1.60, 1.68, 190.0, 0.51, 8),
    "purple (c)": (1.60, 1.68, 205.0, 0.51, 6),
}
ALPHA_9: Final = 0.05
CIRCLES_DEG: Final = (5.0, 30.0, 60.0, 90.0)
_GAIN_9: Final = 4.0  # mirrors of so little contrast are dim


def figure_6(size: int) -> Any:
    """The transmission filter over θ_d."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 2.6), dpi=80, layout="constrained")
    theta_d = np.linspace(0.0, 0.5 * np.pi, max(size, 16) * 16)
    for axes, alpha in zip(figure.subplots(1, 2), ALPHAS_6, strict=True):
        for label, angle in ANGLES_6.items():
            line = axes.plot(
                np.degrees(theta_d), transmission_filter(np.cos(angle), theta_d, alpha), label=f"θi = {label}"
            )
            axes.axvline(90.0 - np.degrees(angle), color=line[0].get_color(), lw=0.6, ls=":")
        axes.set_title(f"α = {alpha:g}; dotted: π/2 − θi", fontsize=9)
        axes.set_xlabel("θd (°)", fontsize=8)
        axes.tick_params(labelsize=7)
        axes.legend(fontsize=7, loc="upper center" if alpha < 0.2 else "upper right")
    return figure


def figure_7(size: int) -> Any:
    """All reflections simulated, the single-reflection model, and five times their difference.

    The difference, which noise would hide, is shown blurred.
    """
    samples = 5 * size
    environment, rule = EnvironmentMap(studio()), colour_rule(128 if size > 32 else 32, "D65")
    rows: dict[str, list[NDArray[np.uint8]]] = {
        "all reflections": [],
        "single-reflection\nmodel": [],
        "5 × difference": [],
    }
    for stack in FIGURE_7.values():
        sphere, facets = SpherePixels(size), StackFacets(stack, rule.wavelength_nm)
        colours, _ = baked_colours(stack, 16, 256 if size > 32 else 32)
        first, second = np.random.default_rng(1), np.random.default_rng(2)
        reference = simulated(sphere, facets, rule, environment, samples, first)
        model = modelled(sphere, stack, colours, environment, samples, RingSampler(facets), second)
        shown = (reference, model, 5.0 * np.abs(_blurred(reference - model)))
        for row, picture in zip(rows.values(), shown, strict=True):
            row.append(display_pixels(picture.astype(np.float32), -0.5, "none"))
    return spheres.sheet(rows, [name.replace(" on ", "\non ") for name in FIGURE_7])


def _blurred(picture: Float64, width: int = 5) -> Float64:
    """Return `picture` (n, n, 3), 0 beyond its edges, three times averaged over width × width pixels."""
    for axis in (0, 1) * 3:
        pad = [(width // 2, width // 2) if k == axis else (0, 0) for k in range(3)]
        windows = np.lib.stride_tricks.sliding_window_view(np.pad(picture, pad), width, axis=axis)
        picture = windows.mean(axis=-1)
    return picture


def white_sky(area: str, cosine: Float64, *, turns: int = 96) -> Float64:
    """Return what an area of the cuticle (n, 3) sends of a white sky towards viewers at `cosine` (n,).

    ∫ R(i·h) D G₁ G₁/(4 cosθ_i cosθ_o) cosθ_i dω_i over facets h, dω_i = 4 (i·h) dω_h: tan²θ_h = α²u/(1 − u).
    """
    n1, n2, period_nm, share, cells = AREAS[area]
    at = np.linspace(0.0, 1.0, 257)
    mirror = Mirror.of(at, n1, n2, share * period_nm, (1.0 - share) * period_nm, cells, 1.0)
    colour = evaluate("yeh-spectral", mirror).rgb
    u, turn = np.meshgrid((np.arange(turns) + 0.5) / turns, 2.0 * np.pi * (np.arange(turns) + 0.5) / turns)
    sine_squared = ALPHA_9**2 * u / (1.0 - u * (1.0 - ALPHA_9**2))
    cos_n = np.sqrt(1.0 - sine_squared)
    sent = np.zeros((len(cosine), 3))
    for row, cos_o in enumerate(cosine):
        cos_h = cos_o * cos_n + np.sqrt((1.0 - cos_o**2) * sine_squared) * np.cos(turn)
        cos_i = 2.0 * cos_h * cos_n - cos_o
        seen = (cos_h > 0.0) & (cos_i > 0.0)
        h, i, s2 = cos_h[seen], cos_i[seen], sine_squared[seen]
        # Facets drawn by D cosθ_h; what is left of the integrand over that density.
        density = ALPHA_9**2 * cos_n[seen] / (np.pi * (s2 + ALPHA_9**2 * (1.0 - s2)) ** 2)
        weight = facet_weight(s2, i, cos_o, ALPHA_9) * i * 4.0 * h / density / turns**2
        rgb = np.stack([np.interp(h, at, channel) for channel in colour.T], axis=-1)
        sent[row] = weight @ rgb
    return sent


def figure_9(size: int) -> Any:
    """Each direction of the hemisphere under a white sky, as far from the middle as it leans."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 2.6), dpi=80, layout="constrained", facecolor="black")
    side = 4 * size
    centres = (np.arange(side) + 0.5) * (2.0 / side) - 1.0
    radius = np.hypot(*np.meshgrid(centres, centres))
    angles = np.linspace(0.0, 0.5 * np.pi, 91)
    for axes, area in zip(figure.subplots(1, 3), AREAS, strict=True):
        profile = white_sky(area, np.maximum(np.cos(angles), 1e-3), turns=min(96, side))
        picture = np.stack([np.interp(radius * 90.0, np.degrees(angles), c) for c in profile.T], axis=-1)
        picture = srgb_encode(np.clip(_GAIN_9 * picture, 0.0, 1.0))
        axes.imshow(np.where(radius[..., None] <= 1.0, picture, 0.0), extent=(-90, 90, -90, 90))
        for circle in CIRCLES_DEG:
            turn = np.linspace(0.0, 2.0 * np.pi, 181)
            axes.plot(circle * np.cos(turn), circle * np.sin(turn), "r", lw=0.7)
        axes.set_axis_off()
        axes.set_title(area, fontsize=9, color="0.85")
    return figure


FIGURES: Final[Mapping[int, Callable[[int], Any]]] = {
    6: figure_6,
    7: figure_7,
    8: spheres.figure_8,
    9: figure_9,
    10: spheres.figure_10,
    11: spheres.figure_11,
    12: spheres.figure_12,
}
LINES: Final = (6,)  # PNG; pictures are WebP


def main(folder: Path = HERE, numbers: tuple[int, ...] = tuple(FIGURES), size: int = 72) -> None:
    """Draw the figures into `folder`; size : pixels of a sphere."""
    for number in numbers:
        figure = FIGURES[number](size)
        if number in LINES:
            figure.savefig(folder / f"fourneau-{number}.png")
        else:
            (folder / f"fourneau-{number}.webp").write_bytes(webp_bytes(spheres.pixels(figure)))


if __name__ == "__main__":
    main(numbers=tuple(int(each) for each in sys.argv[1:]) or tuple(FIGURES))
