"""The pictures of `bench aliasing` beside each other, with their differences from the reference."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.aliasing import EXPOSURE_EV, WAYS, Aliasing
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.rendering.picture import display_pixels

__all__ = ["aliasing_sheet"]

_SHOWN: Final = 256  # pixels of a picture at most: its middle
_DELTA_E_TOP: Final = 20.0
_INCHES: Final = 2.0
_DPI: Final = 128


def aliasing_sheet(measured: Aliasing) -> NDArray[np.uint8]:
    """Return the sheet, (height, width, 3) of 8-bit sRGB: a size a row, the reference first.

    Of pictures larger than 256 pixels their middle is shown.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    sizes = list(measured.references)
    columns = 1 + 2 * len(WAYS)
    figure = Figure(
        figsize=(columns * _INCHES, len(sizes) * (_INCHES + 0.25) + 0.6), dpi=_DPI, layout="constrained"
    )
    canvas = FigureCanvasAgg(figure)
    places = figure.subplots(len(sizes), columns, squeeze=False)
    for place in places.flat:
        place.set_axis_off()
    for row, size in enumerate(sizes):
        reference = _middle(measured.references[size])
        middle = f", its middle {_SHOWN}" if size > _SHOWN else ""
        _show(places[row, 0], reference, f"{size} × {size}{middle}\nreference")
        for column, way in enumerate(WAYS, start=1):
            picture = _middle(measured.pictures[size][way])
            of_way = next(each for each in measured.rows if each.pixels == size and each.way == way)
            _show(places[row, column], picture, way)
            error = delta_e_2000(2.0**EXPOSURE_EV * picture, 2.0**EXPOSURE_EV * reference)
            place = places[row, column + len(WAYS)]
            drawn = place.imshow(error, cmap="magma", vmin=0.0, vmax=_DELTA_E_TOP, interpolation="nearest")
            place.set_title(f"{way}\nΔE {of_way.delta_e_mean:.1f}, p95 {of_way.delta_e_p95:.1f}", fontsize=8)
    bar = figure.colorbar(drawn, ax=places[:, -1], fraction=0.08, extend="max")
    bar.set_label("ΔE2000")
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def _show(place: object, linear: NDArray[np.float64], title: str) -> None:
    pixels = display_pixels(linear.astype(np.float32), EXPOSURE_EV, "none")
    place.imshow(pixels, interpolation="nearest")  # type: ignore[attr-defined]
    place.set_title(title, fontsize=8)  # type: ignore[attr-defined]


def _middle(picture: NDArray[np.float64]) -> NDArray[np.float64]:
    first = max(len(picture) - _SHOWN, 0) // 2
    return picture[first : first + _SHOWN, first : first + _SHOWN]
