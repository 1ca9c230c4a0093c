"""Pictures and maps of their differences, as PNG bytes, transparent where nothing was drawn."""

from __future__ import annotations

import io
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.picture import display_pixels
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

__all__ = ["TONEMAP", "delta_e_map", "deviation_map", "picture"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Base colours keep their hue and lightness, so that what differs before it differs after it.
TONEMAP: Final = "neutral"

# Readable on white and on near-black: the maps are transparent around their pixels.
_INK: Final = "#7d8590"
_BAR_IN: Final = 0.9  # height below the map that its colour bar takes
_GROUND: Final = (0.5, 0.5, 0.5, 0.3)

# A few silhouette pixels must not darken the rest of the map.
_SHOWN_PERCENT: Final = 99.5

# float32 cannot agree better than this; the colour scale starts here.
_DEVIATION_FLOOR: Final = 1e-8


def picture(linear: Float64, drawn: Mask, exposure: float) -> bytes:
    """Return linear Rec.709 (height, width, 3) for a display: × 2^exposure, TONEMAP, sRGB."""
    import PIL.Image

    shown = np.where(drawn[..., None], np.nan_to_num(linear), 0.0).astype(np.float32)
    alpha = np.where(drawn, 255, 0).astype(np.uint8)[..., None]
    stream = io.BytesIO()
    rgba = np.concatenate([display_pixels(shown, exposure, TONEMAP), alpha], axis=-1)
    PIL.Image.fromarray(rgba).save(stream, format="PNG")
    return stream.getvalue()


def deviation_map(deviation: Float64, drawn: Mask) -> bytes:
    """Draw |GLSL − Python| / max(1, |Python|) on a logarithmic scale up to the tolerance, or the maximum."""
    from matplotlib.colors import LogNorm

    top = max(GLSL_PIXEL_RELATIVE, float(np.max(deviation, initial=0.0)))
    values = np.maximum(deviation, _DEVIATION_FLOOR)
    return _map(
        values, drawn, LogNorm(_DEVIATION_FLOOR, top), "|GLSL − Python| / max(1, |Python|)", "viridis"
    )


def delta_e_map(delta_e: Float64, drawn: Mask) -> bytes:
    """Draw ΔE2000 on a linear scale that few pixels exceed and that reaches 1, what an eye just sees."""
    from matplotlib.colors import Normalize

    shown = delta_e[drawn] if drawn.any() else np.zeros(1)
    top = max(1.0, float(np.percentile(shown, _SHOWN_PERCENT)))
    label = f"ΔE2000, at most {shown.max():.3g}"
    return _map(delta_e, drawn, Normalize(0.0, top), label, "inferno")


def _map(values: Float64, drawn: Mask, norm: Any, label: str, colours: str) -> bytes:
    from matplotlib import colormaps
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    height, width = values.shape
    picture_in = 5.0
    figure = Figure(figsize=(picture_in, picture_in * height / width + _BAR_IN), dpi=128)
    FigureCanvasAgg(figure)
    figure.patch.set_alpha(0.0)
    share = _BAR_IN / (picture_in * height / width + _BAR_IN)
    axes = figure.add_axes((0.0, share, 1.0, 1.0 - share))
    axes.set_axis_off()
    image = axes.imshow(
        np.ma.masked_array(values, ~drawn),
        norm=norm,
        cmap=colormaps[colours].with_extremes(bad=_GROUND),
        interpolation="nearest",
        aspect="auto",
    )
    bar = figure.colorbar(
        image, cax=figure.add_axes((0.06, share * 0.76, 0.88, share * 0.12)), orientation="horizontal"
    )
    bar.outline.set_visible(False)
    bar.ax.tick_params(colors=_INK, labelsize=12)
    bar.set_label(label, color=_INK, fontsize=13)
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return stream.getvalue()
