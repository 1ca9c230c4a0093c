"""What a method is to the plan: its name, its parameters, what is known of its cost and its error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from gltf_iri.backends import Backend
from gltf_iri.errors import UsageError

__all__ = ["Domain", "Method", "Parameter", "ParameterValue"]

Domain = Literal["film", "mirror", "layers"]
ParameterValue = float | str


@dataclass(frozen=True, slots=True)
class Parameter:
    """What a method lets its caller choose: a number in a range, whole where `default` is, or a word."""

    name: str
    about: str
    default: ParameterValue
    minimum: float = 0.0
    maximum: float = 0.0
    choices: tuple[str, ...] = ()

    def checked(self, value: ParameterValue, method: str) -> ParameterValue:
        """Return `value` in the type of the default; UsageError where it is not one of those allowed."""
        if self.choices:
            if value in self.choices:
                return value
            wanted = f"one of {', '.join(self.choices)}"
        else:
            is_whole = isinstance(self.default, int)
            wanted = f"a {'whole ' if is_whole else ''}number from {self.minimum:g} to {self.maximum:g}"
            try:
                number = float(value)
            except (TypeError, ValueError):
                number = float("nan")
            if self.minimum <= number <= self.maximum and not (is_whole and number % 1.0):
                return int(number) if is_whole else number
        raise UsageError(f"The parameter {self.name} of method '{method}' wants {wanted}, not '{value}'.")


@dataclass(frozen=True, slots=True)
class Method:
    """One way to turn a film, a mirror or layers of mirrors into a colour."""

    name: str
    domain: Domain
    about: str
    source: str
    is_truth: bool  # exact up to a stated, converged quadrature error
    glsl_function: str | None  # the twin in shaders/optics, or None where there is none
    # CIEDE2000 against truth on the benchmark's set for its domain; None where it has no number of its own
    delta_e_mean: float | None
    parameters: tuple[Parameter, ...] = ()  # keyword arguments of its evaluator
    backends: tuple[Backend, ...] = ("numpy",)  # with more than one, its evaluator takes `backend`
    glsl_tables: tuple[str, ...] = ()  # the samplers that its twin reads (rendering/optics_tables.py)
    # The twin that averages over a Gaussian spread of thickness, and what it reads; None where there is none
    glsl_spread_function: str | None = None
    glsl_spread_tables: tuple[str, ...] = ()

    @property
    def define(self) -> str:
        """The preprocessor symbol that selects the method in GLSL: khr-guarded → METHOD_KHR_GUARDED."""
        return "METHOD_" + self.name.upper().replace("-", "_")
