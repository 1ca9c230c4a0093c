"""Which settings of a method are worth measuring: rows of the benchmarks, and what a budget chooses among."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from gltf_iri.planning.method import METHODS, ParameterValue

__all__ = ["SETTINGS", "Settings", "settings_of", "with_defaults"]

Settings = Mapping[str, ParameterValue]

# Beside the defaults, which come first for every method.
SETTINGS: Final[Mapping[str, tuple[Settings, ...]]] = {
    "fourier": ({"tolerance": 1e-3}, {"tolerance": 1e-6}),
    "bloch": ({"samples": 16}, {"samples": 24}),
    "landmarks-sub": (
        *({"subdivisions": s} for s in (2, 4, 5)),
        *({"root_finder": finder} for finder in ("newton-1", "bisect-10")),
    ),
}


def settings_of(method: str) -> tuple[Settings, ...]:
    """Return what is chosen of a method's parameters, a row each; the first chooses nothing."""
    different: list[Settings] = [{}]
    for chosen in SETTINGS.get(method, ()):
        if with_defaults(method, chosen) not in [with_defaults(method, each) for each in different]:
            different.append(chosen)
    return tuple(different)


def with_defaults(method: str, chosen: Settings) -> dict[str, ParameterValue]:
    """Return all parameters of a method where `chosen` are set and the others left alone."""
    return {each.name: chosen.get(each.name, each.default) for each in METHODS[method].parameters}
