"""How long each part of a frame takes."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    import moderngl

__all__ = ["DRAWING", "PassTimes"]

# What drawing alone consists of, without uploading, compiling and reading back.
DRAWING: Final = ("opaque", "captures", "see-through", "background", "shading inputs")


class PassTimes:
    """Milliseconds of each part, in the order in which the parts first began."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self.milliseconds: dict[str, float] = {}

    @contextmanager
    def measure(self, name: str) -> Iterator[None]:
        """Add the time of the block to `name`, everything that OpenGL was asked for included."""
        self._context.finish()
        started = time.perf_counter()
        yield
        self._context.finish()
        spent = (time.perf_counter() - started) * 1000.0
        self.milliseconds[name] = self.milliseconds.get(name, 0.0) + spent

    @property
    def drawing(self) -> float:
        """The milliseconds of `DRAWING`."""
        return sum(self.milliseconds.get(name, 0.0) for name in DRAWING)
