"""Shader sources from files: `#include`, conditions, defines, and error lines that point into the files.

Each file is included once. The assembler remembers where every line came from and tells a driver's "0:57" as
"shaders/optics/khr.glsl:12". It writes no `#line`: inside expressions Mesa's parser forgets the number of the
source string (its errors name string 0), so that the lines 12 of two files could not be told apart.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from gltf_iri.errors import GltfIriError
from gltf_iri.interrupts import interrupts_held
from gltf_iri.rendering.conditions import Conditions, is_directive
from gltf_iri.rendering.switches import SWITCHES
from gltf_iri.resources import shader_root

if TYPE_CHECKING:
    import moderngl

__all__ = ["ShaderError", "ShaderSource", "assemble", "assemble_text", "build_program", "compile_program"]
__all__ += ["translate_log"]

_INCLUDE: Final = re.compile(r'\s*#\s*include\s+"([^"]+)"\s*(?://.*)?$')

# Where compilers put the line and the message.
_DRIVER_FORMATS: Final = (
    re.compile(r"^0:(?P<line>\d+)\(\d+\): (?P<message>.*)$"),  # Mesa
    re.compile(r"^0\((?P<line>\d+)\) : (?P<message>.*)$"),  # NVIDIA
    re.compile(
        r"^(?:ERROR|WARNING): (?:0|.*/?[\w.-]+):(?P<line>\d+): (?P<message>.*)$"
    ),  # glslang, AMD, ANGLE
)
_STAGE_HEADER: Final = re.compile(r"^(vertex|fragment)(?:_shader| info)$", re.IGNORECASE)


class ShaderError(GltfIriError):
    """A shader of this program cannot be put together or compiled."""


@dataclass(frozen=True, slots=True)
class ShaderSource:
    """GLSL ready for a compiler, and where it came from."""

    text: str
    files: tuple[str, ...]  # in the order of their first appearance
    origins: tuple[str, ...]  # for each line of `text` "file:line", or "" where the assembler wrote it


def assemble(entry: str, defines: Sequence[str] = (), *, version: str = "330 core") -> ShaderSource:
    """Return the source of `entry`, a path below the shaders folder such as "pass/mesh.frag".

    `defines` are injected in the order given, after `#version`: a switch ("HAS_METAL"), or a name and its
    value ("LIGHT_COUNT 3"). Raises ShaderError for an unknown switch, an unknown file, a cycle of includes, a
    condition out of place, and a value that no line uses.
    """
    return assemble_text(_read(entry, entry), f"shaders/{entry}", defines, version=version)


def assemble_text(
    text: str, name: str, defines: Sequence[str] = (), *, version: str = "330 core"
) -> ShaderSource:
    """Return the source made of `text`, which errors call `name`; otherwise as `assemble`."""
    switches = {define for define in defines if " " not in define}
    for switch in sorted(switches - SWITCHES):
        raise ShaderError(f"'{switch}' is not a switch that gltf_iri/rendering/switches.py knows.")
    embedded = version.endswith("es")
    walk = _Walk(switches | ({"GL_ES"} if embedded else set()))
    walk.take(text, name, ())
    body = "\n".join(walk.lines) + "\n"
    for define in defines:
        value_name = define.split(" ")[0]
        if value_name not in switches and not re.search(rf"\b{re.escape(value_name)}\b", body):
            raise ShaderError(f"No line of {name} uses the define '{define}'.")
    head = [f"#version {version}", *(f"#define {define}" for define in defines)]
    if embedded:  # films reach 10 µm over nanometre wavelengths: mediump cannot carry their phase
        head += ["precision highp float;", "precision highp int;"]
    origins = (*([""] * len(head)), *walk.origins)
    return ShaderSource("\n".join(head) + "\n" + body, tuple(walk.files), origins)


class _Walk:
    """Collects the lines of one file and of what it includes."""

    def __init__(self, defined: set[str]) -> None:
        self.defined = defined
        self.files: list[str] = []
        self.lines: list[str] = []
        self.origins: list[str] = []

    def take(self, text: str, name: str, chain: tuple[str, ...]) -> None:
        self.files.append(name)
        chain = (*chain, name)
        conditions = Conditions(self.defined)
        for at, line in enumerate(text.splitlines(), start=1):
            if is_directive(line):
                try:
                    conditions.step(line)
                except ValueError as error:
                    raise ShaderError(f"{name}:{at}: {error}.") from None
                continue
            if not conditions.active:
                continue
            include = _INCLUDE.match(line)
            if include is None:
                self.lines.append(line)
                self.origins.append(f"{name}:{at}")
            else:
                self._include(include[1], f"{name}:{at}", chain)
        if not conditions.balanced:
            raise ShaderError(f"{name}: a condition is opened and not closed with #endif.")

    def _include(self, path: str, where: str, chain: tuple[str, ...]) -> None:
        name = f"shaders/{path}"
        if name in chain:
            raise ShaderError("Includes form a cycle: " + " -> ".join((*chain, name)) + ".")
        if name not in self.files:
            self.take(_read(path, where), name, chain)


def _read(path: str, where: str) -> str:
    file = shader_root() / Path(path)
    if not file.is_file():
        raise ShaderError(f"{where}: there is no shader file 'shaders/{path}'.")
    return file.read_text(encoding="utf-8")


def compile_program(
    context: moderngl.Context, vertex_entry: str, fragment_entry: str, defines: Sequence[str] = ()
) -> moderngl.Program:
    """Return the linked program of two entry files, both with `defines`; raises ShaderError."""
    return build_program(context, assemble(vertex_entry, defines), assemble(fragment_entry, defines))


def build_program(
    context: moderngl.Context,
    vertex: ShaderSource,
    fragment: ShaderSource | None = None,
    *,
    varyings: tuple[str, ...] = (),
) -> moderngl.Program:
    """Return the linked program; a driver's complaint becomes a ShaderError in terms of the files."""
    import moderngl

    try:
        with interrupts_held():  # moderngl ends the process where Ctrl-C meets it here
            return context.program(
                vertex_shader=vertex.text,
                fragment_shader=None if fragment is None else fragment.text,
                varyings=varyings,
            )
    except moderngl.Error as error:
        told = translate_log(str(error), vertex, fragment)
        raise ShaderError(f"The driver refuses a shader:\n{told}") from error


def translate_log(log: str, vertex: ShaderSource, fragment: ShaderSource | None = None) -> str:
    """Return what a driver's log says, as "file:line: message" wherever it names a place."""
    stage = vertex
    told = []
    for line in log.splitlines():
        header = _STAGE_HEADER.match(line.strip())
        if header is not None:
            stage = fragment if fragment and header[1].lower() == "fragment" else vertex
        elif line.strip(" =-"):
            told.append(_translate_line(line, stage.origins))
    return "\n".join(told)


def _translate_line(line: str, origins: tuple[str, ...]) -> str:
    for pattern in _DRIVER_FORMATS:
        match = pattern.match(line)
        if match is not None and 0 < int(match["line"]) <= len(origins):
            return f"{origins[int(match['line']) - 1] or 'the defines'}: {match['message']}"
    return line
