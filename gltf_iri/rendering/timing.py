"""What the GLSL twins cost: nanoseconds for each evaluation on the renderer at hand.

Each twin is drawn over a target of a million pixels, one evaluation a pixel, its arguments read from
textures. The same shader with the function left out is the baseline, which is taken off.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.fullscreen import release_framebuffer
from gltf_iri.rendering.optics_tables import table_texture
from gltf_iri.rendering.source import assemble, assemble_text, build_program
from gltf_iri.rendering.twins import COMPONENTS, Twin, find_twin
from gltf_iri.rendering.uniforms import bind

if TYPE_CHECKING:
    import moderngl

__all__ = ["TwinTimes", "time_twins"]

_SIDE: Final = 1024
_SHORTEST_S: Final = 0.02  # shorter draws are repeated, that what else runs weighs less
_ARGUMENTS: Final = "timed_arguments"


@dataclass(frozen=True, slots=True)
class TwinTimes:
    """ns_per_eval : method → nanoseconds; renderer : OpenGL's own name for what was timed."""

    renderer: str
    ns_per_eval: Mapping[str, float]
    baseline_ns: float  # reading the arguments and writing the colour; already taken off


def time_twins(
    context: moderngl.Context,
    methods: Sequence[str],
    subject: Film | Mirror,
    *,
    white: str = "D65",
    parameters: Mapping[str, Mapping[str, ParameterValue]] = MappingProxyType({}),
    rounds: int = 7,
    side: int = _SIDE,
) -> TwinTimes:
    """Time the GLSL twins of `methods`, all of films or all of mirrors, on the rows of `subject`.

    Rows follow each other from pixel to pixel, again from the first after the last: drawn at random they are
    the worst that a picture can ask for, whose neighbouring pixels are alike and leave a loop together.
    A round draws every method in turn; each number is the median over the rounds, less the baseline's.
    A context draws with as many threads as it was made for: pin the process to one core before making it.

    methods : such as ("khr", "fourier") or ("bloch", "landmarks-sub"); each needs a GLSL twin.
    parameters : for each method its own, where they are not to be the defaults.
    side : the target has side² pixels.

    Raises UsageError as `Probe.evaluate`.
    """
    twins = {name: find_twin(name, subject, white, parameters.get(name, {})) for name in methods}
    draws = [_TimedDraw(context, twin, side) for twin in twins.values()]
    draws.append(_TimedDraw(context, next(iter(twins.values())), side, is_baseline=True))
    target = context.texture((side, side), 4, dtype="f4")
    framebuffer = context.framebuffer([target])
    try:
        context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        framebuffer.use()
        for draw in draws:
            draw.warm_up()
        measured = [[draw.seconds() for draw in draws] for _ in range(rounds)]
    finally:
        for draw in draws:
            draw.release()
        release_framebuffer(context, framebuffer)
        target.release()
    *medians, baseline = (1e9 * statistics.median(column) / side**2 for column in zip(*measured, strict=True))
    times = {name: median - baseline for name, median in zip(twins, medians, strict=True)}
    return TwinTimes(renderer_name(context), MappingProxyType(times), baseline)


class _TimedDraw:
    def __init__(
        self, context: moderngl.Context, twin: Twin, side: int, *, is_baseline: bool = False
    ) -> None:
        self._context = context
        tables = {} if is_baseline else twin.tables
        self._textures = {name: table_texture(context, table) for name, table in tables.items()}
        self._textures[_ARGUMENTS] = table_texture(context, _rows(twin, side))
        fragment = assemble_text(_fragment(twin, is_baseline=is_baseline), f"timing of {twin.function}")
        self._program = build_program(context, assemble("pass/fullscreen.vert"), fragment)
        self._triangle = context.vertex_array(self._program, [])
        self._repeats = 1

    def warm_up(self) -> None:
        """Have the driver compile, as it does when a program first draws, and see how long a draw takes."""
        self.seconds()
        self._repeats = max(1, math.ceil(_SHORTEST_S / self.seconds()))

    def seconds(self) -> float:
        """Return how long one draw takes, from an idle renderer to an idle renderer."""
        bind(self._program, {}, self._textures)
        self._context.finish()
        started = time.perf_counter()
        for _ in range(self._repeats):
            self._triangle.render(vertices=3)
            self._context.finish()  # else a renderer may drop a draw that the next one covers
        return (time.perf_counter() - started) / self._repeats

    def release(self) -> None:
        self._triangle.release()
        self._program.release()
        for texture in self._textures.values():
            texture.release()


def _rows(twin: Twin, side: int) -> NDArray[np.float32]:
    """Return (side, texels · side, 4): for each pixel its arguments, four to a texel, zeros at the end."""
    shape = np.broadcast_shapes(
        *(
            np.shape(a)[:-1] if t == "vec3" else np.shape(a)
            for a, t in zip(twin.arguments, twin.types, strict=True)
        )
    )
    columns = [
        np.broadcast_to(a, (*shape, 3) if t == "vec3" else shape).reshape(-1, COMPONENTS[t])
        for a, t in zip(twin.arguments, twin.types, strict=True)
    ]
    rows = np.concatenate(columns, axis=1).astype(np.float32)
    padded = np.zeros((len(rows), 4 * _texels(twin)), dtype=np.float32)
    padded[:, : rows.shape[1]] = rows
    return np.resize(padded, (side * side, padded.shape[1])).reshape(side, -1, 4)


def _texels(twin: Twin) -> int:
    return -(-sum(COMPONENTS[t] for t in twin.types) // 4)


def _fragment(twin: Twin, *, is_baseline: bool) -> str:
    """Return the shader that reads the arguments and gives them to the function, or only adds them."""
    texels = _texels(twin)
    values = iter(f"given[{i // 4}].{'xyzw'[i % 4]}" for i in range(4 * texels))
    arguments = []
    for type_name in twin.types:
        parts = [next(values) for _ in range(COMPONENTS[type_name])]
        arguments.append(parts[0] if type_name == "float" else f"vec3({', '.join(parts)})")
    value = " + ".join(f"vec3({a})" for a in arguments)
    if not is_baseline:
        value = f"{twin.function}({', '.join(arguments)})"
    return "\n".join(
        [
            *([] if is_baseline else [f'#include "{twin.include}"']),
            f"uniform highp sampler2D {_ARGUMENTS};",
            "out vec4 o;",
            "void main() {",
            "    ivec2 at = ivec2(gl_FragCoord.xy);",
            f"    vec4 given[{texels}];",
            *(
                f"    given[{i}] = texelFetch({_ARGUMENTS}, ivec2({texels} * at.x + {i}, at.y), 0);"
                for i in range(texels)
            ),
            f"    o = vec4({value}, 1.0);",
            "}",
        ]
    )
