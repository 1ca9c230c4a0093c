"""Options of the verbs that draw."""

from __future__ import annotations

import click

__all__ = ["EMPTY_PICTURE", "SIZE", "exposure_option"]

EMPTY_PICTURE = "Nothing of the model is in the picture: it lies out of the camera's sight or has no extent."

_EXPOSURE_MAX = 64.0  # 2^64 and 2^-64 are far beyond any light and well inside float32


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


def _checked_exposure(context: click.Context, option: click.Parameter, value: float) -> float:
    if not abs(value) <= _EXPOSURE_MAX:  # NaN, which is smaller than nothing, included
        raise click.BadParameter(f"{value} is not between {-_EXPOSURE_MAX:g} and {_EXPOSURE_MAX:g}.")
    return value


exposure_option = click.option(
    "--exposure",
    type=float,
    callback=_checked_exposure,
    default=0.0,
    show_default=True,
    metavar="EV",
    help="Brighter by 2^EV.",
)
