"""A method's parameters, as its evaluator takes them."""

from __future__ import annotations

from collections.abc import Mapping

from gltf_iri.errors import UsageError
from gltf_iri.planning.method import Method, ParameterValue

__all__ = ["checked_parameters"]


def checked_parameters(method: Method, given: Mapping[str, ParameterValue]) -> dict[str, ParameterValue]:
    """Return all parameters of `method`; UsageError where it has none so called or not of such a value."""
    known = {parameter.name: parameter for parameter in method.parameters}
    for name in given:
        if name not in known:
            has = f"; it has {', '.join(known)}" if known else ", nor any other"
            raise UsageError(f"The method '{method.name}' has no parameter '{name}'{has}.")
    return {name: each.checked(given.get(name, each.default), method.name) for name, each in known.items()}
