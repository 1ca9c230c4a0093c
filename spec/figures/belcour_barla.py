"""Draws belcour-barla-*.png, Belcour & Barla 2017, Fig. 2, 7, 9, 10, 11.

`python spec/figures/belcour_barla.py` in a checkout. Printed there: Fig. 7 η₂ 1.5, d 525 nm, η₃ 1.09,
the bands' peaks 600, 560, 450 nm; Fig. 9 η₃ 1.1, κ₃ 0 and 1.5; Fig. 10 D_inc 1600 nm, η₃ 1.1, κ₃ 1.5;
Fig. 11 D_inc to 6400 nm on the same base; the samples of Fig. 2. Chosen here: the film of Fig. 2, the
D_inc of Fig. 9 and the η₂ of Fig. 10 and 11. Pictures are reflectances under D65, cut to what a screen
shows; Fig. 7 is under E.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.fourier_variants import exact_interfaces
from gltf_iri.colour.observer import colour_matching
from gltf_iri.colour.spaces import XYZ_TO_REC709, rec709_to_xyz, xyz_to_rec709
from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum

__all__ = ["main"]

Float64 = NDArray[np.float64]

METAL: Final = base_from_ior(1.1 + 1.5j)
THICK: Final = (1.6, 1200.0)  # Fig. 2: index and thickness in nm
PEAKS_NM: Final = np.array([600.0, 560.0, 450.0])
ANGLES: Final = np.linspace(0.0, np.pi / 2.0, 181)


def shown(rgb: Float64) -> Float64:
    """Return linear Rec.709 as a screen shows it."""
    return srgb_encode(np.clip(rgb, 0.0, 1.0))


def sphere(size: int) -> tuple[Float64, NDArray[np.bool_]]:
    """Return cos θ of a sphere seen from afar, (size, size), and where it is."""
    x, y = np.meshgrid(*[(np.arange(size) + 0.5) / size * 2.0 - 1.0] * 2)
    squared = x * x + y * y
    return np.sqrt(np.maximum(1.0 - squared, 0.0)), squared < 1.0


def xyz_under_e(rgb: Float64) -> Float64:
    """Return X, Y, Z (..., 3), 1 for R ≡ 1, of linear Rec.709 whose channels were each scaled to that."""
    return rec709_to_xyz(rgb * XYZ_TO_REC709.sum(axis=1))


def band_samples(count: int) -> tuple[Float64, Float64]:
    """Return wavelengths (3, count) in nm and weights (3, count) that sample each of x̄, ȳ, z̄."""
    if count == 1:
        return PEAKS_NM[:, None], np.ones((3, 1))
    grid = 380.0 + 370.0 * (np.arange(count) + 0.5) / count
    weights = colour_matching(grid).T
    return np.tile(grid, (3, 1)), weights / weights.sum(axis=1, keepdims=True)


def sampled_xyz(film: Film, count: int) -> Float64:
    """Return X, Y, Z (..., 3) from `count` samples a band."""
    wavelength_nm, weights = band_samples(count)
    return np.stack(
        [film_spectrum(film, wavelength_nm[j])[..., 0, :] @ weights[j] for j in range(3)], axis=-1
    )


def figure_2(pyplot: Any) -> Any:
    """Spectral aliasing: a thick film with 1, 8 and 128 samples a band, and the spectrum of one point."""
    figure, axes = pyplot.subplots(2, 3, figsize=(7.0, 4.4), constrained_layout=True)
    cosine, seen = sphere(140)
    film_ior, nm = THICK
    wavelength_nm = np.linspace(380.0, 750.0, 741)
    point = Film.of(0.8, nm, film_ior, METAL)
    curves = film_spectrum(point, wavelength_nm)[0] * colour_matching(wavelength_nm).T
    for (picture, plot), count in zip(axes.T, (1, 8, 128), strict=True):
        xyz = sampled_xyz(Film.of(cosine[seen], nm, film_ior, METAL), count)
        image = np.ones((*cosine.shape, 3))
        image[seen] = shown(xyz_to_rec709(xyz) / XYZ_TO_REC709.sum(axis=1))
        picture.imshow(image)
        picture.set_title(f"{count} a band", fontsize=9)
        picture.axis("off")
        at_nm, _ = band_samples(count)
        for j, colour in enumerate(("tab:red", "tab:green", "tab:blue")):
            plot.plot(wavelength_nm, curves[j], color=colour, lw=0.8)
            if count <= 8:
                plot.plot(at_nm[j], np.interp(at_nm[j], wavelength_nm, curves[j]), "k.", ms=5)
        plot.set_xlabel("λ (nm)", fontsize=8)
    return figure


def figure_7(pyplot: Any) -> Any:
    """One film by four methods, in xy and band by band, θ₁ from 0 to 90°."""
    film = Film.of(np.cos(ANGLES), 525.0, 1.5, base_from_ior(1.09))
    truth = xyz_under_e(evaluate("spectral", film, white="E").rgb)
    contenders = {
        "(a) one sample a band": {"naive": sampled_xyz(film, 1)},
        "(b) Smits & Meyer": {"smits-meyer": xyz_under_e(evaluate("smits-meyer", film, white="E").rgb)},
        "(c) Eq. 10": {f"m ≤ {m}": xyz_under_e(exact_interfaces(film, "E", m)) for m in (1, 3)},
    }
    figure, axes = pyplot.subplots(2, 3, figsize=(9.0, 5.6), constrained_layout=True)
    for axis, (title, curves) in zip(axes[0], contenders.items(), strict=True):
        for (name, xyz), style in zip([("truth", truth), *curves.items()], ("r-", "b--", "k:"), strict=False):
            xy = xyz[..., :2] / xyz.sum(axis=-1, keepdims=True)
            axis.plot(*xy.T, style, lw=1.0, label=name)
        axis.set_title(title, fontsize=9)
        axis.set_xlabel("x")
        axis.legend(fontsize=7)
    axes[0][0].set_ylabel("y")
    for j, band in enumerate("XYZ"):
        for name, xyz, style in (
            ("truth", truth, "r-"),
            ("m ≤ 1", contenders["(c) Eq. 10"]["m ≤ 1"], "b--"),
            ("m ≤ 3", contenders["(c) Eq. 10"]["m ≤ 3"], "k:"),
        ):
            axes[1][j].plot(np.degrees(ANGLES), xyz[:, j], style, lw=1.0, label=name)
        axes[1][j].set_title(f"(d) band {band}", fontsize=9)
        axes[1][j].set_xlabel("θ₁ (°)")
    axes[1][0].legend(fontsize=7)
    return figure


def figure_9(pyplot: Any) -> Any:
    """Slices over θ₁ and η₂, for growing D_inc."""
    paths_nm = (400.0, 800.0, 1600.0, 3200.0, 6400.0)
    film_ior = np.linspace(2.0, 1.0, 100)[:, None]
    cosine = np.cos(np.linspace(0.0, np.pi / 2.0, 100))
    figure, axes = pyplot.subplots(2, len(paths_nm), figsize=(9.0, 3.8), constrained_layout=True)
    for row, base in zip(axes, (base_from_ior(1.1), METAL), strict=True):
        for axis, path_nm in zip(row, paths_nm, strict=True):
            film = Film.of(cosine, path_nm / (2.0 * film_ior), film_ior, base)
            axis.imshow(shown(evaluate("fourier", film).rgb), extent=(0, 90, 1, 2), aspect="auto")
            axis.set_title(f"κ₃ {base.index.imag.max():g}, D_inc {path_nm:.0f} nm", fontsize=7)
            axis.tick_params(labelsize=6)
    axes[1][0].set_xlabel("θ₁ (°)", fontsize=8)
    axes[1][0].set_ylabel("η₂", fontsize=8)
    return figure


def figure_10(pyplot: Any) -> Any:
    """Spheres under a white sky: fewer fringes the denser the film."""
    figure, axes = pyplot.subplots(1, 3, figsize=(6.0, 2.3), constrained_layout=True)
    cosine, seen = sphere(180)
    for axis, film_ior in zip(axes, (1.2, 1.5, 2.0), strict=True):
        film = Film.of(cosine[seen], 1600.0 / (2.0 * film_ior), film_ior, METAL)
        image = np.ones((*cosine.shape, 3))
        image[seen] = shown(evaluate("fourier", film).rgb)
        axis.imshow(image)
        axis.set_title(f"η₂ {film_ior:g}", fontsize=9)
        axis.axis("off")
    return figure


def figure_11(pyplot: Any) -> Any:
    """Normal incidence, D_inc from 0 to 6400 nm: the film's index rules saturation."""
    figure, axes = pyplot.subplots(3, 1, figsize=(7.0, 2.6), sharex=True, constrained_layout=True)
    path_nm = np.linspace(0.0, 6400.0, 640)
    for axis, film_ior in zip(axes, (1.2, 1.5, 2.0), strict=True):
        film = Film.of(1.0, path_nm / (2.0 * film_ior), film_ior, METAL)
        axis.imshow(shown(evaluate("fourier", film).rgb)[None], extent=(0, 6400, 0, 1), aspect="auto")
        axis.set_yticks([])
        axis.set_ylabel(f"η₂ {film_ior:g}", fontsize=8)
    axes[-1].set_xlabel("D_inc (nm)", fontsize=8)
    return figure


def main() -> None:
    """Draw each figure into a file of its own, beside this one."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    for number, draw in {2: figure_2, 7: figure_7, 9: figure_9, 10: figure_10, 11: figure_11}.items():
        draw(pyplot).savefig(Path(__file__).with_name(f"belcour-barla-{number}.png"), dpi=80)


if __name__ == "__main__":
    main()
