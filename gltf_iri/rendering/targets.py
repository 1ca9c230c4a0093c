"""What is drawn into: a multisampled picture, or the targets that keep a pixel's shading inputs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.rendering.frame import BRAGG_INPUT_TARGETS, INPUT_TARGETS, LAYER_INPUT_TARGETS, ShadingInputs
from gltf_iri.rendering.fullscreen import release_framebuffer

if TYPE_CHECKING:
    import moderngl

__all__ = ["MAX_PIXELS", "Targets", "check_size", "out_of_room", "shading_inputs"]

Float32 = NDArray[np.float32]
_T = TypeVar("_T")

# 8K: with 4 samples a pixel and its depth, some 3 GB.
MAX_PIXELS: Final = 7680 * 4320


def check_size(context: moderngl.Context, size: tuple[int, int], samples: int) -> None:
    """Raise UsageError for a size that cannot be drawn, MissingCapabilityError for too many samples."""
    if samples < 0 or samples.bit_count() > 1:
        raise UsageError(f"{samples} samples a pixel are not to be had: ask for 1, 2, 4 or 8.")
    limit = min(context.info["GL_MAX_RENDERBUFFER_SIZE"], *context.info["GL_MAX_VIEWPORT_DIMS"])
    width, height = size
    if not (1 <= width <= limit and 1 <= height <= limit and width * height <= MAX_PIXELS):
        raise UsageError(
            f"The size {width} × {height} is out of range: this OpenGL draws 1 to {limit} pixels a side, "
            f"and this program {MAX_PIXELS} in all."
        )
    if samples > context.max_samples:
        raise MissingCapabilityError(
            f"This OpenGL takes up to {context.max_samples} samples a pixel, fewer than {samples}."
        )


class _Held:
    """What was made so far."""

    def __init__(self) -> None:
        self.made: list[Any] = []

    def __call__(self, thing: _T) -> _T:
        self.made.append(thing)
        return thing


@contextmanager
def out_of_room(size: tuple[int, int]) -> Iterator[_Held]:
    """Turn what a driver without memory says into a MissingCapabilityError.

    What the block passed through the function it is given is then released, so that a smaller size has room.
    """
    import moderngl

    held = _Held()
    try:
        yield held
    except moderngl.Error as error:
        for thing in held.made:
            thing.release()
        raise MissingCapabilityError(
            f"This OpenGL has no room for {size[0]} × {size[1]} pixels; choose a smaller size."
        ) from error


class Targets:
    """Framebuffers of float32 RGBA colour and depth; `count` of them, multisampled where samples > 1."""

    def __init__(self, context: moderngl.Context, size: tuple[int, int], *, samples: int, count: int) -> None:
        self._context = context
        samples = samples if samples > 1 else 0
        self._resolved: moderngl.Framebuffer | None = None
        with out_of_room(size) as held:
            colours = [held(context.renderbuffer(size, 4, samples=samples, dtype="f4")) for _ in range(count)]
            depth = held(context.depth_renderbuffer(size, samples=samples))
            self.drawn = held(context.framebuffer(colours, depth))
            if samples:
                resolved = held(context.renderbuffer(size, 4, dtype="f4"))
                self._resolved = context.framebuffer([resolved])

    def clear(self) -> None:
        """Set colour and coverage to 0, and depth to the farthest."""
        self.drawn.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)

    def read(self, target: int = 0) -> Float32:
        """Return the pixels of a target, (height, width, 4), row 0 at the top."""
        source = self.drawn
        if self._resolved is not None:
            self._context.copy_framebuffer(self._resolved, self.drawn)
            source = self._resolved
        data = source.read(components=4, attachment=target, dtype="f4")
        width, height = source.size
        return np.frombuffer(data, np.float32).reshape(height, width, 4)[::-1].copy()

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for framebuffer in filter(None, (self.drawn, self._resolved)):
            for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
                if attachment is not None:
                    attachment.release()
            release_framebuffer(self._context, framebuffer)


def shading_inputs(first: Targets, second: Targets | None, third: Targets | None) -> ShadingInputs:
    """Read all of `INPUT_TARGETS`, and of `LAYER_INPUT_TARGETS` and `BRAGG_INPUT_TARGETS` what was drawn."""
    values: dict[str, NDArray[np.generic]] = {}
    for index, (colour, scalar) in enumerate(INPUT_TARGETS):
        pixels = first.read(index)
        values[colour], values[scalar] = pixels[..., :3].copy(), pixels[..., 3].copy()
    for names, drawn in ((LAYER_INPUT_TARGETS, second), (BRAGG_INPUT_TARGETS, third)):
        for index, (colour, scalar) in enumerate(names):
            pixels = np.zeros_like(pixels) if drawn is None else drawn.read(index)
            values[colour] = pixels[..., :3].copy()
            if scalar:
                values[scalar] = pixels[..., 3].copy()
    values["material"] = np.rint(values["material"]).astype(np.int32) - 1
    return ShadingInputs(**values)  # type: ignore[arg-type]
