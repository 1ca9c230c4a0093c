"""Which settings of a method are worth measuring: rows of the benchmarks, and what a budget chooses among."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from gltf_iri.planning.method import METHODS, ParameterValue

__all__ = ["ACCURACY_SETTINGS", "SETTINGS", "Settings", "settings_of", "with_defaults"]

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


# From three samples, one a channel, to one a nanometre of the visible range; between them ever twice as fine.
_GRIDS: Final = tuple({"samples": n} for n in (3, 5, 9, 17, 33, 65, 129, 257, 471))

# What the map of cost and error shows of each method: its whole reach.
ACCURACY_SETTINGS: Final[Mapping[str, tuple[Settings, ...]]] = {
    **SETTINGS,
    "bb17": ({"orders": 1}, {"orders": 2}),
    "fourier": tuple({"tolerance": t} for t in (0.1, 0.03, 0.01, 1e-3, 1e-5, 1e-6, 1e-8)),
    "spectral-grid": _GRIDS,
    "yeh-grid": _GRIDS,
    "landmarks": tuple({"root_finder": finder} for finder in ("newton-1", "bisect-10")),
    "layers-single-table": ({"nodes": 128}, {"wavelengths": 512}),
    "layers-rgb": tuple({"reflectance": r} for r in ("yeh-spectral", "landmarks", "landmarks-sub")),
    "layers-bands": tuple({"bands": n} for n in (4, 6, 8, 12, 24, 32, 64)),
    "bloch": tuple({"samples": n} for n in (8, 16, 24, 32, 48, 64, 96, 128)),
}


def settings_of(method: str, shown: Mapping[str, tuple[Settings, ...]] = SETTINGS) -> tuple[Settings, ...]:
    """Return what is chosen of a method's parameters, a row each; the first chooses nothing."""
    different: list[Settings] = [{}]
    for chosen in shown.get(method, ()):
        if with_defaults(method, chosen) not in [with_defaults(method, each) for each in different]:
            different.append(chosen)
    return tuple(different)


def with_defaults(method: str, chosen: Settings) -> dict[str, ParameterValue]:
    """Return all parameters of a method where `chosen` are set and the others left alone."""
    return {each.name: chosen.get(each.name, each.default) for each in METHODS[method].parameters}
