"""Draws fourneau-*.png, Fourneau et al. 2024, Fig. 3, 4, 13: `python spec/figures/fourneau.py` in a checkout.

Printed there: Fig. 3 n₁ 1, n₂ 1.5, d₁ = d₂ = 315 nm, N 10; Fig. 4 the same indices, N 20, Λ 244, 500, 988
nm, wavelengths 559, 556, 442 nm; Fig. 13 n₁ 1. Chosen here: the shares d₁/Λ of Fig. 4, the n₂ of Fig. 13.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.landmark_boxes import lanes_of, spectral_boxes
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum
from gltf_iri.evaluation.yeh_spectral import mirror_spectrum
from gltf_iri.optics.envelope_weight import envelope_weight, mean_envelope_ratio, normal_r_squared
from gltf_iri.optics.landmarks import band, band_gap_function, envelope_transmittance, zero_point

__all__ = ["main"]

Float64 = NDArray[np.float64]

PEAKS_NM: Final = np.array([559.0, 556.0, 442.0])
PERIODS_NM: Final = (244.0, 500.0, 988.0)
SHARES: Final = (0.25, 0.5, 0.75)
ANGLES: Final = np.linspace(0.0, np.pi / 2.0, 181)


def figure_3(pyplot: Any) -> Any:
    """A spectrum with its envelope, its landmarks and its boxes; the dispersion relation below."""
    mirror = Mirror.of(1.0, 1.0, 1.5, 315.0, 315.0, 10)
    lanes = lanes_of(mirror)
    path_nm, lean, r_squared = (float(a[0]) for a in (lanes.path_nm, lanes.lean, lanes.r_squared))
    t = np.linspace(0.5, 4.5, 4001)
    figure, (top, bottom) = pyplot.subplots(2, 1, figsize=(8.0, 4.6), sharex=True, constrained_layout=True)
    top.plot(t, 1.0 - envelope_transmittance(t, lean, r_squared), color="0.6", lw=1.2, label="envelope")
    top.plot(t, mirror_spectrum(mirror, 2.0 * path_nm / t), lw=0.8, label="R, N = 10")
    boxes = spectral_boxes(lanes, 1, "newton-2")
    first = boxes.lane == 0
    order = np.argsort(boxes.low[first])
    low, high, through = (a[first][order] for a in (boxes.low, boxes.high, boxes.transmittance))
    # Between boxes lie the gaps, where all is reflected.
    steps_t = np.stack([low, high, high], axis=-1).ravel()
    steps = np.stack([1.0 - through, 1.0 - through, np.ones(len(low))], axis=-1)
    steps[:-1, 2] = np.where(low[1:] > high[:-1] + 1e-9, 1.0, 1.0 - through[1:])
    top.step(steps_t[:-1], steps.ravel()[:-1], "r--", lw=1.2, where="post", label="boxes, 360–830 nm")
    bottom.plot(t, band_gap_function(t, lean, r_squared) / (1.0 - r_squared), "k", lw=0.8)
    bottom.axhspan(-1.0, 1.0, color="0.93")
    modes = np.arange(0, 5)
    found = band(modes, lean, r_squared, "newton-2")
    marks = {
        "modes": (modes[1:], "rx"),
        "Airy points": (found.airy, "co"),
        "gap edges": (np.concatenate([found.start[1:], found.end]), "g."),
        "zero points": (zero_point(found, lean), "k^"),
    }
    for name, (at, style) in marks.items():
        at = at[(at > t[0]) & (at < t[-1])]
        bottom.plot(at, band_gap_function(at, lean, r_squared) / (1.0 - r_squared), style, ms=5, label=name)
    top.legend(fontsize=7, loc="upper right")
    bottom.legend(fontsize=7, loc="upper right")
    top.set_ylabel("R")
    bottom.set_ylabel("cos KΛ")
    bottom.set_xlabel("ω (q₁d₁ + q₂d₂) / π")
    return figure


def figure_4(pyplot: Any) -> Any:
    """Reflectance over the angle at three wavelengths, and gradients: truth, landmarks, landmarks-sub."""
    figure, axes = pyplot.subplots(
        2 * len(PERIODS_NM),
        1 + len(SHARES),
        figsize=(9.0, 7.0),
        height_ratios=[3, 1] * len(PERIODS_NM),
        constrained_layout=True,
    )
    cosine = np.cos(ANGLES)
    for row, period_nm in enumerate(PERIODS_NM):
        slab = Film.of(cosine, period_nm, 1.5, base_from_ior(1.0))
        columns = [
            (f"slab, {period_nm:g} nm", film_spectrum(slab, PEAKS_NM)[:, 0], [evaluate("spectral", slab)])
        ]
        for share in SHARES:
            mirror = Mirror.of(cosine, 1.0, 1.5, share * period_nm, (1.0 - share) * period_nm, 20)
            strips = [evaluate(m, mirror) for m in ("yeh-spectral", "landmarks", "landmarks-sub")]
            title = f"Λ {period_nm:g} nm, d₁/Λ {share:g}"
            columns.append((title, mirror_spectrum(mirror, PEAKS_NM), strips))
        for column, (title, curves, strips) in enumerate(columns):
            plot, strip = axes[2 * row][column], axes[2 * row + 1][column]
            for curve, colour in zip(curves.T, ("tab:red", "tab:green", "tab:blue"), strict=True):
                plot.plot(np.degrees(ANGLES), curve, color=colour, lw=0.7)
            plot.set_title(title, fontsize=7)
            plot.set_ylim(0.0, 1.0)
            plot.tick_params(labelsize=6)
            image = np.stack([srgb_encode(np.clip(e.rgb, 0.0, 1.0)) for e in strips])
            strip.imshow(image, extent=(0, 90, len(strips), 0), aspect="auto", interpolation="nearest")
            strip.set_xticks([])
            strip.set_yticks(np.arange(len(strips)) + 0.5, ("ref", "app", "sub")[: len(strips)], fontsize=6)
    return figure


def figure_13(pyplot: Any) -> Any:
    """The mean of R over its envelope outside gaps, and the curve that stands for it."""
    figure, axis = pyplot.subplots(figsize=(5.0, 3.0), constrained_layout=True)
    angles = np.linspace(0.0, np.radians(85.0), 18)
    for n2, colour in ((1.3, "tab:blue"), (1.5, "tab:orange"), (2.0, "tab:green")):
        cos_1, cos_2 = np.cos(angles), np.sqrt(1.0 - (np.sin(angles) / n2) ** 2)
        r12_s = ((cos_1 - n2 * cos_2) / (cos_1 + n2 * cos_2)) ** 2
        axis.plot(np.degrees(angles), mean_envelope_ratio(r12_s, 20), ".", color=colour)
        fitted = envelope_weight(normal_r_squared(1.0, n2), cos_1)
        axis.plot(np.degrees(angles), fitted, color=colour, lw=1.0, label=f"n₂ {n2:g}")
    axis.set_xlabel("θ₁ (°)")
    axis.set_ylabel("w (dots, s), w̃ (lines)")
    axis.legend(fontsize=8)
    return figure


def main() -> None:
    """Draw each figure into a file of its own, beside this one."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    for number, draw in {3: figure_3, 4: figure_4, 13: figure_13}.items():
        draw(pyplot).savefig(Path(__file__).with_name(f"fourneau-{number}.png"), dpi=80)


if __name__ == "__main__":
    main()
