"""What the GLSL twins cost: nanoseconds for each evaluation on the renderer at hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.planning.method import ParameterValue, find_method
from gltf_iri.rendering.optics_tables import optics_table
from gltf_iri.rendering.timed_calls import TimedCall, time_calls
from gltf_iri.rendering.twins import find_twin

if TYPE_CHECKING:
    import moderngl

__all__ = ["TwinTimes", "averaging_call", "one_channel_call", "time_twins", "twin_call"]

_SIDE: Final = 1024


@dataclass(frozen=True, slots=True)
class TwinTimes:
    """ns_per_eval : method → nanoseconds; renderer : OpenGL's own name for what was timed."""

    renderer: str
    ns_per_eval: Mapping[str, float]
    baseline_ns: float  # reading the arguments and writing the colour; already taken off


def twin_call(
    method: str,
    subject: Film | Mirror,
    white: str = "D65",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> TimedCall:
    """Return the call of a method's GLSL twin on the rows of `subject`; raises UsageError as `find_twin`."""
    twin = find_twin(method, subject, white, parameters)
    arguments = ", ".join(f"a{i}" for i in range(len(twin.types)))
    return TimedCall(
        twin.function,
        (f'#include "{twin.include}"',),
        f"{twin.function}({arguments})",
        twin.types,
        twin.arguments,
        tables=twin.tables,
    )


def one_channel_call(
    method: str,
    film: Film,
    white: str = "D65",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> TimedCall:
    """Return the call of the twin of `method` over bases that the compiler sees are grey.

    Raises UsageError as `find_twin`.
    """
    call = twin_call(method, film, white, parameters)
    base = f"a{call.types.index('vec3')}"
    return replace(call, expression=call.expression.replace(base, f"vec3({base}.x)"))


def averaging_call(
    method: str,
    film: Film,
    share: float,
    white: str = "D65",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> TimedCall:
    """Return the call of the twin of `method` that averages over a deviation of `share` of each thickness.

    Raises UsageError as `find_twin`, and for a method that cannot average.
    """
    descriptor = find_method(method, "film")
    if descriptor.glsl_spread_function is None:
        raise UsageError(f"The method '{method}' cannot average over thickness in GLSL.")
    twin = find_twin(method, film, white, parameters)
    function = descriptor.glsl_spread_function
    names = [f"a{i}" for i in range(len(twin.types))]
    *before, cosine = names
    arguments = ", ".join((*before, f"{share!r} * {before[-1]}", cosine))
    tables = {
        name: optics_table(name, white, twin.blank.parameters) for name in descriptor.glsl_spread_tables
    }
    include = f"optics/{function.removeprefix('iridescent_fresnel_')}.glsl"
    return TimedCall(
        function, (f'#include "{include}"',), f"{function}({arguments})", twin.types, twin.arguments, tables
    )


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

    Rows follow each other from pixel to pixel: drawn at random they are the worst that a picture can ask for,
    whose neighbouring pixels are alike and leave a loop together. Otherwise as `time_calls`.

    methods : such as ("khr", "fourier") or ("bloch", "landmarks-sub"); each needs a GLSL twin.
    parameters : for each method its own, where they are not to be the defaults.
    side : the target has side² pixels.

    Raises UsageError as `Probe.evaluate`.
    """
    calls = [twin_call(name, subject, white, parameters.get(name, {})) for name in methods]
    times = time_calls(context, calls, rounds=rounds, side=side)
    return TwinTimes(
        times.renderer, MappingProxyType(dict(zip(methods, times.ns, strict=True))), times.baseline_ns
    )
