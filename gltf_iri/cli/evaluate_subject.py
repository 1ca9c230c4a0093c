"""What the options of `gltf-iri evaluate` describe, a film or a mirror, and its colours."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.budget import nanoseconds
from gltf_iri.cli.common import note
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.planning.method import METHODS, parameters_text
from gltf_iri.planning.mirror import ONE_CELL
from gltf_iri.planning.way import Way

if TYPE_CHECKING:
    from gltf_iri.evaluation.film import Evaluation

__all__ = ["DEFAULT_BASE", "DEFAULT_FILM", "DEFAULT_OUTSIDE_IOR", "How", "evaluation_json", "from_mirror"]
__all__ += ["from_parameters", "note_undefined", "title_of", "undefined_at"]

# glTF's own defaults, for the film and for its base.
DEFAULT_FILM = Iridescence()
DEFAULT_BASE = Ior()
DEFAULT_OUTSIDE_IOR = 1.0


@dataclass(frozen=True, slots=True)
class How:
    """By which method, or within which budget, under which white, and by what."""

    method: str | None
    white: str
    backend: str
    parameters: dict[str, str]
    budget: float | None = None


def from_mirror(cosines: tuple[float, ...], how: How, given: dict[str, Any]) -> dict[str, Any]:
    """Return what `evaluate --json` prints of the mirror `given`; a film's options are refused."""
    import gltf_iri

    for option, value in given.items():
        if value is not None and option not in ("bragg", "host_ior"):
            raise click.UsageError(f"a Bragg mirror has no --{option.replace('_', '-')}; leave it out")
    evaluation = gltf_iri.evaluate(
        how.method,
        cos_theta_1=cosines,
        bragg=given["bragg"],
        host_ior=given["host_ior"],
        white=how.white,
        backend=how.backend,
        parameters=how.parameters,
        budget=how.budget,
    )
    result = evaluation_json(cosines, evaluation)
    if METHODS[evaluation.method].domain == "film":
        result["reason"] = ONE_CELL
    return result


def from_parameters(cosines: tuple[float, ...], how: How, given: dict[str, Any]) -> dict[str, Any]:
    """Return what `evaluate --json` prints of the film `given`; two bases are refused."""
    import gltf_iri

    if given["host_ior"] is not None:
        raise click.UsageError("--host is the index outside a mirror: give --bragg too, or --outside-ior")
    bases = [name for name in ("base_f0", "base_ior", "base_nk") if given[name] is not None]
    if len(bases) > 1:
        names = " and ".join("--" + name.replace("_", "-") for name in bases)
        raise click.UsageError(f"{names} each describe the base: give one of them")
    f0 = given["base_f0"]
    if given["base_edge_tint"] is not None and f0 is None:
        raise click.UsageError("--base-edge-tint needs --base-f0, the metal's colour straight on")
    evaluation = gltf_iri.evaluate(
        how.method,
        cos_theta_1=cosines,
        thickness_nm=_or(given["thickness"], DEFAULT_FILM.thickness_max_nm),
        film_ior=_or(given["film_ior"], DEFAULT_FILM.film_ior),
        base_f0=f0[0] if f0 is not None and len(f0) == 1 else f0,
        base_ior=given["base_ior"],
        base_nk=given["base_nk"],
        base_edge_tint=given["base_edge_tint"],
        outside_ior=_or(given["outside_ior"], DEFAULT_OUTSIDE_IOR),
        white=how.white,
        backend=how.backend,
        parameters=how.parameters,
        budget=how.budget,
    )
    return evaluation_json(cosines, evaluation)


def evaluation_json(cosines: tuple[float, ...], evaluation: Evaluation) -> dict[str, Any]:
    """Return what `evaluate --json` prints of a film or a mirror, whoever described it."""
    chosen = {}
    if evaluation.delta_e is not None:
        label = Way(evaluation.method, evaluation.parameters).label
        chosen = {
            "way": label,
            "delta_e": evaluation.delta_e,
            "ns_per_colour": evaluation.ns_per_colour,
        }
    return chosen | {
        "method": evaluation.method,
        "white": evaluation.white,
        "cos": cosines,
        "rgb": evaluation.rgb,
        "backend": evaluation.backend,
        "parameters": dict(evaluation.parameters),
        "undefined": undefined_at(cosines, evaluation),
    }


def undefined_at(cosines: tuple[float, ...], evaluation: Evaluation) -> dict[str, list[float]]:
    """Return the cosines that each undefined case of the method's text touched."""
    return {
        case: [c for c, touched in zip(cosines, mask, strict=True) if touched]
        for case, mask in evaluation.undefined.items()
    }


def title_of(result: Mapping[str, Any]) -> str:
    """Return what a table of `result`, as `evaluate --json` prints it, is called for people."""
    method = ", ".join(filter(None, (result["method"], parameters_text(result["parameters"]))))
    kept = ""
    if "delta_e" in result:
        from gltf_iri.budgets.search import figure

        kept = f", ΔE ≤ {figure(result['delta_e'])} for {nanoseconds(result['ns_per_colour'])} a colour"
    return f"{method}{kept}, by {result['backend']}, {result['white']} white, linear Rec.709"


def note_undefined(result: Mapping[str, Any]) -> None:
    """Say where the method's text leaves something of `result` undefined."""
    for case, where in result["undefined"].items():
        note(f"the method leaves undefined: {case}, at cos θ = {', '.join(f'{c:g}' for c in where)}.")


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
