"""Options of the verbs that draw."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal

import click

if TYPE_CHECKING:
    from gltf_iri.scene.model import Environment, Scene

__all__ = ["EMPTY_PICTURE", "SIZE", "choose_exposure", "exposure_option", "reference_counts"]
__all__ += ["reference_options"]

EMPTY_PICTURE = "Nothing of the model is in the picture: it lies out of the camera's sight or has no extent."

_EXPOSURE_MAX_EV = 64.0  # the bound of gltf_iri.scene.exposure, which is not imported before it is needed


class _Size(click.ParamType):  # type: ignore[type-arg,unused-ignore]  # generic only in some versions of click
    """Width and height in pixels, such as 640x480."""

    name = "WxH"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, int]:
        if isinstance(value, tuple):
            return value
        width, _, height = str(value).lower().partition("x")
        if not (width.isascii() and width.isdecimal() and height.isascii() and height.isdecimal()):
            self.fail(f"'{value}' is not a size such as 640x480.", param, ctx)
        return int(width), int(height)


SIZE = _Size()


class _Exposure(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A number of stops, or auto."""

    name = "EV|auto"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | Literal["auto"]:
        if value == "auto":
            return "auto"
        try:
            stops = float(str(value))
        except ValueError:
            self.fail(f"'{value}' is neither a number nor auto.", param, ctx)
        if not abs(stops) <= _EXPOSURE_MAX_EV:  # NaN, which is smaller than nothing, included
            self.fail(f"{value} is not between {-_EXPOSURE_MAX_EV:g} and {_EXPOSURE_MAX_EV:g}.", param, ctx)
        return stops


def exposure_option(default: str) -> Callable[[Any], Any]:
    """Return the option `--exposure`, None where it is left out; `default` says what happens then."""
    return click.option(
        "--exposure",
        type=_Exposure(),
        help=f"Brighter by 2^EV; auto: as an incident light meter reads.  [default: {default}]",
    )


def choose_exposure(
    asked: float | Literal["auto"] | None,
    scene: Scene,
    environment: Environment | None,
    *,
    default: str = "auto",
) -> float:
    """Return the exposure in EV: as asked for, or `default`, which is "auto" or a number as text."""
    from gltf_iri.scene.exposure import automatic_exposure

    wanted = default if asked is None else asked
    return automatic_exposure(scene, environment) if wanted == "auto" else float(wanted)


def reference_options(what: str) -> Callable[[Any], Any]:
    """Return the options `--reference`, explained by `what`, `--samples` and `--paths`, None by default."""
    options = (
        click.option("--reference", is_flag=True, help=what),
        click.option(
            "--samples",
            type=click.IntRange(1),
            metavar="N",
            help="With --reference: samples of the image light for each pixel.  [default: 256]",
        ),
        click.option(
            "--paths",
            type=click.IntRange(1),
            metavar="N",
            help="With --reference: paths through glass for each pixel.  [default: 64]",
        ),
    )

    def add(command: Any) -> Any:
        for option in reversed(options):
            command = option(command)
        return command

    return add


def reference_counts(reference: bool, samples: int | None, paths: int | None) -> dict[str, Any]:
    """Return what was asked for as arguments of the reference; UsageError where there is no reference."""
    from gltf_iri.errors import UsageError

    asked = {"image_samples": samples, "paths": paths}
    counts = {name: count for name, count in asked.items() if count is not None}
    if counts and not reference:
        raise UsageError("--samples and --paths are the reference's: add --reference.")
    return counts
