"""Evaluates any function of shaders/optics and shaders/material on arrays of float32.

Arguments become vertex attributes and results leave through transform feedback, both as plain float32: no
filter or framebuffer lies between the arrays and the function. Tables that the function samples are textures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.optics_tables import Table, table_texture
from gltf_iri.rendering.source import ShaderSource, assemble_text, build_program
from gltf_iri.rendering.twins import COMPONENTS, ResultType, find_twin
from gltf_iri.rendering.uniforms import bind

if TYPE_CHECKING:
    import moderngl

__all__ = ["Probe", "probe_source"]

Float32 = NDArray[np.float32]

# Methods whose text leaves values undefined; Python lists the rows, GLSL cannot.
_WITH_UNDEFINED_CASES: Final = frozenset({"khr"})


class Probe:
    """Calls GLSL functions on arrays; one program per function is kept."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._programs: dict[ShaderSource, moderngl.Program] = {}
        # Nothing is drawn into it; without a window OpenGL refuses to run at all until something is bound.
        self._scope = context.scope(context.simple_framebuffer((1, 1)))

    def evaluate(
        self,
        method: str,
        subject: Film | Mirror,
        *,
        white: str = "D65",
        parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
    ) -> Evaluation:
        """Return the reflectance of `subject` by the GLSL twin of `method`; `backend` names the renderer.

        Same signature as the Python evaluators'; arguments are rounded to float32. Parameters reach GLSL
        through the method's tables. GLSL cannot tell where the text leaves a value undefined: those rows are
        listed by the Python twin. Raises UsageError where the method, the white or a parameter is unknown,
        the method has no GLSL twin, and for what no twin computes: a mirror whose cells absorb.
        """
        twin = find_twin(method, subject, white, parameters)
        rgb = self.call(
            twin.function,
            twin.include,
            twin.arguments,
            argument_types=twin.types,
            tables=twin.tables,
        )
        named = twin.blank
        if method in _WITH_UNDEFINED_CASES:
            named = evaluate(method, subject, white=white, parameters=parameters)
        return replace(named, rgb=rgb.astype(np.float64), backend=renderer_name(self._context))

    def call(
        self,
        function: str,
        include: str,
        arguments: Sequence[ArrayLike],
        result: ResultType = "vec3",
        *,
        argument_types: Sequence[ResultType] | None = None,
        member: str = "",
        tables: Mapping[str, Table] = MappingProxyType({}),
        lines: Sequence[str] = (),
        defines: Sequence[str] = (),
    ) -> Float32:
        """Return `function` of the file `include` (below shaders/) for each row of the broadcast arguments.

        Parameters
        ----------
        arguments : a float takes an array (...), a vec3 one (..., 3).
        argument_types : the GLSL type of each; without it an array whose last axis is 3 is a vec3.
        result : the type of what the function returns, or of its `member` where it returns a struct.
        tables : for each sampler that the function reads, what fills it: (rows, columns, 1–4 channels).
        lines : GLSL after the include, such as a function that makes structs of the arguments; defines : what
            is switched on.

        Returns (...) for a float and (..., 3) for a vec3, float32. Raises ShaderError where the call does not
        compile, UsageError where shapes do not go together.
        """
        arrays = [np.asarray(argument, dtype=np.float32) for argument in arguments]
        types = argument_types or ["vec3" if a.shape[-1:] == (3,) else "float" for a in arrays]
        shape = _row_shape(arrays, types)
        rows = [
            np.broadcast_to(a, (*shape, 3) if t == "vec3" else shape).reshape(-1, COMPONENTS[t])
            for a, t in zip(arrays, types, strict=True)
        ]
        source = probe_source(function, include, types, result, member, lines=lines, defines=defines)
        values = self._run(source, np.ascontiguousarray(np.concatenate(rows, axis=1)), types, result, tables)
        return values.reshape((*shape, 3) if result == "vec3" else shape)

    def _run(
        self,
        source: ShaderSource,
        rows: Float32,
        types: Sequence[ResultType],
        result: ResultType,
        tables: Mapping[str, Table],
    ) -> Float32:
        if source not in self._programs:
            self._programs[source] = build_program(self._context, source, varyings=("probe_result",))
        program = self._programs[source]
        if rows.shape[0] == 0:
            return np.zeros((0, COMPONENTS[result]), dtype=np.float32)
        # A compiler removes an attribute on which nothing depends: its bytes are skipped.
        names = [f"a{i}" for i in range(len(types))]
        layout = " ".join(
            f"{COMPONENTS[t]}f" if name in program else f"{4 * COMPONENTS[t]}x"
            for name, t in zip(names, types, strict=True)
        )
        textures: dict[str, moderngl.Texture] = {}
        inputs = self._context.buffer(rows.tobytes())
        outputs = self._context.buffer(reserve=rows.shape[0] * COMPONENTS[result] * 4)
        array = self._context.vertex_array(
            program, [(inputs, layout, *(name for name in names if name in program))]
        )
        try:
            for name, table in tables.items():
                textures[name] = table_texture(self._context, table)
            bind(program, {}, textures)
            with self._scope:
                array.transform(outputs, mode=self._context.POINTS, vertices=rows.shape[0])
            return np.frombuffer(outputs.read(), dtype=np.float32).copy()
        finally:
            for texture in textures.values():
                texture.release()
            for resource in (array, inputs, outputs):
                resource.release()


def probe_source(
    function: str,
    include: str,
    argument_types: Sequence[ResultType],
    result: ResultType,
    member: str = "",
    *,
    lines: Sequence[str] = (),
    defines: Sequence[str] = (),
) -> ShaderSource:
    """Return the vertex shader that calls `function` on its attributes a0, a1, …"""
    names = [f"a{i}" for i in range(len(argument_types))]
    attributes = [f"in {t} {name};" for t, name in zip(argument_types, names, strict=True)]
    text = [
        f'#include "{include}"',
        *lines,
        *attributes,
        f"out {result} probe_result;",
        "void main() {",
        f"    probe_result = {function}({', '.join(names)}){'.' + member if member else ''};",
        "}",
    ]
    return assemble_text("\n".join(text), f"probe of {function}", defines)


def _row_shape(arrays: Sequence[Float32], types: Sequence[ResultType]) -> tuple[int, ...]:
    for array, type_name in zip(arrays, types, strict=True):
        if type_name == "vec3" and array.shape[-1:] != (3,):
            raise UsageError("A vec3 argument wants an array whose last axis has three channels.")
    try:
        return np.broadcast_shapes(
            *(a.shape[:-1] if t == "vec3" else a.shape for a, t in zip(arrays, types, strict=True))
        )
    except ValueError:
        shapes = ", ".join(str(a.shape) for a in arrays)
        raise UsageError(f"The arguments' shapes do not broadcast: {shapes}.") from None
