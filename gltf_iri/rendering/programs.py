"""Surface shaders, compiled once for every permutation; the key is the ordered tuple of defines."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import METHODS, Method, ParameterValue, find_method, method_names
from gltf_iri.planning.permutation import film_lobes
from gltf_iri.rendering.layer_tables import check_layers_method
from gltf_iri.rendering.source import ShaderSource, assemble, build_program

if TYPE_CHECKING:
    import moderngl

__all__ = ["KEPT_PROGRAMS", "ProgramStore", "check_method", "computed_method", "film_parameters"]
__all__ += ["surface_sources"]


def surface_sources(defines: tuple[str, ...]) -> tuple[ShaderSource, ShaderSource]:
    """Return the vertex and the fragment shader of one permutation, as the compiler sees them.

    What has a value is the fragment shader's alone.
    """
    switches = tuple(define for define in defines if " " not in define)
    return assemble("pass/surface.vert", switches), assemble("pass/surface.frag", defines)


def check_method(name: str | None) -> None:
    """Raise UsageError where neither films nor layers are drawn by the method `name`; None is no method."""
    if name is not None and name in method_names("layers"):
        check_layers_method(name)
    elif name is not None and find_method(name, "film").glsl_function is None:
        drawable = ", ".join(m.name for m in METHODS.values() if m.glsl_function and m.domain == "film")
        raise UsageError(f"The method '{name}' cannot be drawn; methods that can are: {drawable}.")


def computed_method(plan: MaterialPlan) -> Method | None:
    """Return the film method that shaders of `plan` compute; None without a film or where tables hold it.

    Raises UsageError where the method has no GLSL twin.
    """
    if plan.method is None or None not in film_lobes(plan).values():
        return None
    check_method(plan.method)
    return find_method(plan.method, "film")


def film_parameters(plan: MaterialPlan) -> dict[str, ParameterValue]:
    """Return the parameters of the method of `plan`, by name: its way's, else the defaults."""
    if plan.method is None:
        return {}
    defaults = {each.name: each.default for each in find_method(plan.method).parameters}
    return defaults if plan.way is None else {**defaults, **plan.way.parameters}


_SAMPLER: Final = re.compile(r"^\s*uniform (?:highp )?sampler", re.MULTILINE)

# On llvmpipe a program holds some 10 MB; a picture uses a handful, and many files in a row ever new ones.
KEPT_PROGRAMS: Final = 32


class ProgramStore:
    """The compiled permutations of one context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._programs: dict[tuple[str, ...], moderngl.Program] = {}

    def get(self, defines: tuple[str, ...], *, material: str = "") -> moderngl.Program:
        """Return the program of one permutation; `material` is its name in errors.

        Raises MissingCapabilityError where it samples more textures at once than this OpenGL can: of 3.3 that
        is 16, and a material with a texture in every place asks for some 25.
        """
        if defines not in self._programs:
            vertex, fragment = surface_sources(defines)
            count = len(_SAMPLER.findall(fragment.text))
            limit = self._context.info["GL_MAX_TEXTURE_IMAGE_UNITS"]
            if count > limit:
                raise MissingCapabilityError(
                    f"The material '{material}' samples {count} textures at once, its lights' included; "
                    f"this OpenGL takes {limit}."
                )
            self._programs[defines] = build_program(self._context, vertex, fragment)
        self._programs[defines] = self._programs.pop(defines)  # the last in order is the last used
        return self._programs[defines]

    def trim(self) -> None:
        """Give all but the `KEPT_PROGRAMS` used last back to OpenGL; between pictures only."""
        while len(self._programs) > KEPT_PROGRAMS:
            self._programs.pop(next(iter(self._programs))).release()

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for program in self._programs.values():
            program.release()
        self._programs.clear()
