"""What stands behind an option where it is more than one number or word."""

from __future__ import annotations

from typing import Any

import click

__all__ = ["Numbers", "Setting"]


class Numbers(click.ParamType):  # type: ignore[type-arg]  # generic in click's newest stubs only
    """Numbers separated by commas, as many as one of `counts` says; without counts, any number of them."""

    name = "numbers"

    def __init__(self, *counts: int) -> None:
        self._counts = counts

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a tuple of floats."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"'{value}' is not a list of numbers separated by commas", param, ctx)
        if self._counts and len(numbers) not in self._counts:
            wanted = " or ".join(map(str, self._counts))
            self.fail(f"'{value}' is not {wanted} numbers separated by commas", param, ctx)
        return numbers


class Setting(click.ParamType):  # type: ignore[type-arg]  # generic in click's newest stubs only
    """NAME=VALUE."""

    name = "setting"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the name and the value's text."""
        if isinstance(value, tuple):
            return value
        name, sign, text = str(value).partition("=")
        if not (name and sign and text):
            self.fail(f"'{value}' is not NAME=VALUE", param, ctx)
        return name, text
