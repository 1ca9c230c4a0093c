"""What calls in GLSL cost: each is drawn over a target, one call a pixel, its arguments read from a texture.

The same shader without the call is the baseline, which is taken off.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.fullscreen import release_framebuffer
from gltf_iri.rendering.optics_tables import Table, table_texture
from gltf_iri.rendering.source import assemble, assemble_text, build_program
from gltf_iri.rendering.twins import COMPONENTS, ResultType
from gltf_iri.rendering.uniforms import bind

if TYPE_CHECKING:
    import moderngl

__all__ = ["CallTimes", "TimedCall", "call_colours", "time_calls"]

_SHORTEST_S: Final = 0.02  # shorter draws are repeated, that what else runs weighs less
_FEWEST_ROUNDS: Final = 2
_ARGUMENTS: Final = "timed_arguments"


@dataclass(frozen=True, slots=True)
class TimedCall:
    """A call that is drawn for its time.

    name : what errors call it.
    lines : GLSL before main: includes, declarations, functions.
    expression : the vec3 that is drawn, of the arguments a0, a1, …
    types, arguments : of each argument; a float takes (...), a vec3 (..., 3), and they broadcast.
    tables : what the samplers that the lines name are filled with; textures : those that the caller keeps.
    """

    name: str
    lines: tuple[str, ...]
    expression: str
    types: tuple[ResultType, ...]
    arguments: tuple[NDArray[Any], ...]
    tables: Mapping[str, Table] = field(default_factory=dict)
    textures: Mapping[str, Any] = field(default_factory=dict)
    uniforms: Mapping[str, Any] = field(default_factory=dict)
    defines: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CallTimes:
    """ns : of each call, in their order; renderer : OpenGL's own name for what was timed."""

    renderer: str
    ns: tuple[float, ...]
    baseline_ns: float  # reading the arguments and writing the colour; already taken off


def time_calls(
    context: moderngl.Context,
    calls: Sequence[TimedCall],
    *,
    rounds: int,
    side: int,
    limit_s: float = math.inf,
) -> CallTimes:
    """Time `calls`, all of the same types, over a target of side² pixels.

    Rows of the arguments follow each other from pixel to pixel, again from the first after the last. A round
    draws every call in turn; each time is the median over the rounds, less that of the first call's baseline.
    A context draws with as many threads as it was made for: pin the process to one core before making it.

    limit_s : fewer rounds, never less than two, where so many would last longer.
    Raises ShaderError for a call that does not compile.
    """
    draws = [_TimedDraw(context, call, side) for call in calls]
    draws.append(_TimedDraw(context, calls[0], side, is_baseline=True))
    target = context.texture((side, side), 4, dtype="f4")
    framebuffer = context.framebuffer([target])
    try:
        context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        framebuffer.use()
        for draw in draws:
            draw.warm_up()
        started = time.perf_counter()
        for draw in draws:
            draw.seconds()
        round_s = time.perf_counter() - started
        count = min(rounds, max(_FEWEST_ROUNDS, int(limit_s / round_s) if math.isfinite(limit_s) else rounds))
        measured = [[draw.seconds() for draw in draws] for _ in range(count)]
    finally:
        for draw in draws:
            draw.release()
        release_framebuffer(context, framebuffer)
        target.release()
    *medians, baseline = (1e9 * statistics.median(column) / side**2 for column in zip(*measured, strict=True))
    return CallTimes(renderer_name(context), tuple(each - baseline for each in medians), baseline)


def call_colours(context: moderngl.Context, call: TimedCall, count: int) -> NDArray[np.float32]:
    """Return (count, 3): what `call` draws for its first `count` rows."""
    side = math.isqrt(max(count - 1, 0)) + 1
    draw = _TimedDraw(context, call, side)
    target = context.texture((side, side), 4, dtype="f4")
    framebuffer = context.framebuffer([target])
    try:
        context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        framebuffer.use()
        draw.seconds()
        pixels = np.frombuffer(target.read(), dtype=np.float32).reshape(-1, 4)
        return pixels[:count, :3].copy()
    finally:
        draw.release()
        release_framebuffer(context, framebuffer)
        target.release()


class _TimedDraw:
    def __init__(
        self, context: moderngl.Context, call: TimedCall, side: int, *, is_baseline: bool = False
    ) -> None:
        self._context = context
        tables = {} if is_baseline else call.tables
        self._own = {name: table_texture(context, table) for name, table in tables.items()}
        self._own[_ARGUMENTS] = table_texture(context, _rows(call, side))
        self._textures = {**({} if is_baseline else call.textures), **self._own}
        self._uniforms = call.uniforms
        text = _fragment(call, is_baseline=is_baseline)
        fragment = assemble_text(text, f"timing of {call.name}", () if is_baseline else call.defines)
        self._program = build_program(context, assemble("pass/fullscreen.vert"), fragment)
        self._triangle = context.vertex_array(self._program, [])
        self.repeats = 1

    def warm_up(self) -> None:
        """Have the driver compile, as it does when a program first draws, and see how long a draw takes."""
        self.seconds()
        self.repeats = max(1, math.ceil(_SHORTEST_S / self.seconds()))

    def seconds(self) -> float:
        """Return how long one draw takes, from an idle renderer to an idle renderer; the median of repeats.

        Draws during which the system let another process run then weigh nothing.
        """
        bind(self._program, self._uniforms, self._textures)
        self._context.finish()
        times = []
        for _ in range(self.repeats):
            started = time.perf_counter()
            self._triangle.render(vertices=3)
            self._context.finish()  # else a renderer may drop a draw that the next one covers
            times.append(time.perf_counter() - started)
        return statistics.median(times)

    def release(self) -> None:
        self._triangle.release()
        self._program.release()
        for texture in self._own.values():
            texture.release()


def _rows(call: TimedCall, side: int) -> NDArray[np.float32]:
    """Return (side, texels · side, 4): for each pixel its arguments, four to a texel, zeros at the end."""
    pairs = list(zip(call.arguments, call.types, strict=True))
    shape = np.broadcast_shapes(*(np.shape(a)[:-1] if t == "vec3" else np.shape(a) for a, t in pairs))
    columns = [
        np.broadcast_to(a, (*shape, 3) if t == "vec3" else shape).reshape(-1, COMPONENTS[t]) for a, t in pairs
    ]
    rows = np.concatenate(columns, axis=1).astype(np.float32)
    padded = np.zeros((len(rows), 4 * _texels(call)), dtype=np.float32)
    padded[:, : rows.shape[1]] = rows
    return np.resize(padded, (side * side, padded.shape[1])).reshape(side, -1, 4)


def _texels(call: TimedCall) -> int:
    return -(-sum(COMPONENTS[t] for t in call.types) // 4)


def _fragment(call: TimedCall, *, is_baseline: bool) -> str:
    """Return the shader that reads the arguments and gives them to the call, or only adds them."""
    texels = _texels(call)
    values = iter(f"given[{i // 4}].{'xyzw'[i % 4]}" for i in range(4 * texels))
    arguments = []
    for type_name in call.types:
        parts = [next(values) for _ in range(COMPONENTS[type_name])]
        arguments.append(parts[0] if type_name == "float" else f"vec3({', '.join(parts)})")
    total = " + ".join(f"vec3(a{i})" for i in range(len(arguments)))
    return "\n".join(
        [
            *([] if is_baseline else call.lines),
            f"uniform highp sampler2D {_ARGUMENTS};",
            "out vec4 o;",
            "void main() {",
            "    ivec2 at = ivec2(gl_FragCoord.xy);",
            f"    vec4 given[{texels}];",
            *(
                f"    given[{i}] = texelFetch({_ARGUMENTS}, ivec2({texels} * at.x + {i}, at.y), 0);"
                for i in range(texels)
            ),
            *(f"    {t} a{i} = {a};" for i, (t, a) in enumerate(zip(call.types, arguments, strict=True))),
            f"    o = vec4({total if is_baseline else call.expression}, 1.0);",
            "}",
        ]
    )
