"""What the options of `gltf-iri evaluate` describe (a film, a mirror, a file's material), and its colours."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import choose_backend
from gltf_iri.cli.common import material_label
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.mirror import ONE_CELL
from gltf_iri.planning.way import Way

if TYPE_CHECKING:
    from gltf_iri.evaluation.film import Evaluation
    from gltf_iri.material.material import Material

__all__ = ["DEFAULT_BASE", "DEFAULT_FILM", "DEFAULT_OUTSIDE_IOR", "How", "chosen_material", "from_file"]
__all__ += ["from_mirror", "from_parameters"]

# glTF's own defaults, for the film and for its base.
DEFAULT_FILM = Iridescence()
DEFAULT_BASE = Ior()
DEFAULT_OUTSIDE_IOR = 1.0

# Textures that make another base under the film; the film's own have their place in the title.
_TEXTURES_OF_THE_BASE = frozenset(
    {"base-color-texture", "metallic-roughness-texture", "specular-texture", "specular-color-texture"}
)

_LISTED_MAX = 8  # materials that an error names; `plan` lists them all


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
    result = _result(cosines, evaluation)
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
    return _result(cosines, evaluation)


def from_file(
    file: Path,
    name: str | None,
    cosines: tuple[float, ...],
    how: How,
    layered: bool,
    given: dict[str, Any],
) -> dict[str, Any]:
    """Return what `evaluate --json` prints of the material of `file` called `name`."""
    from gltf_iri.evaluation.material_film import evaluate_material
    from gltf_iri.planning.decide import plan_material
    from gltf_iri.scene.load import load

    for option, value in given.items():
        if value is not None and option != "thickness":
            raise click.UsageError(f"FILE's material decides --{option.replace('_', '-')}; leave it out")
    materials = load(file).materials
    index = chosen_material(materials, name, file)
    plan = plan_material(materials[index], index, method=how.method)
    way = None
    if how.budget is not None and plan.method is not None:
        way = _way_of(materials[index], index, len(cosines), how, given["thickness"])
        plan = replace(plan, method=way.method)
    done = evaluate_material(
        materials[index],
        plan,
        cosines,
        thickness_nm=given["thickness"],
        white=how.white,
        backend=how.backend,
        parameters=how.parameters if way is None else way.parameters,
    )
    film = done.film
    if way is not None:
        film = replace(film, delta_e=way.delta_e, ns_per_colour=way.ns_per_colour)
    result = _result(cosines, film)
    result |= {"material": plan.name, "index": index, "thickness_nm": done.thickness_nm}
    result |= {"thickness_range_nm": done.thickness_range_nm, "factor": done.factor}
    result["textures_left_out"] = [e.value for e in plan.effects if e.value in _TEXTURES_OF_THE_BASE]
    if layered:
        result |= {"specular": done.layer.specular, "base_weight": done.layer.base_weight}
    return result


def _way_of(material: Material, index: int, count: int, how: How, thickness_nm: float | None) -> Way:
    """Return the cheapest method within the budget, at all angles, for the material without its textures."""
    from gltf_iri.arrays.films import films_of_material, reach_of_films
    from gltf_iri.budgets.choose import Asked, choose_way
    from gltf_iri.errors import UsageError

    label = f"material '{material_label(index, material.name)}'"
    reach = reach_of_films(films_of_material(material, index, ("cos",), thickness_nm), {})
    device = choose_backend(how.backend, count, ("numpy", "numba"), "budget")
    asked = Asked(how.budget or 0.0, count, device, how.white, is_film_needed=True, has_tables=False)
    if reach is None:
        raise UsageError(f"A budget does not know what lies under the film of {label}; name a --method.")
    return choose_way(reach, asked, label).way


def chosen_material(materials: tuple[Material, ...], name: str | None, file: Path) -> int:
    """Return the index of the material called `name` or numbered so, or of the only one with a film.

    Raises UsageError where there is none, or more than one, and lists them.
    """
    from gltf_iri.errors import UsageError

    candidates = list(range(len(materials)))
    if name is None:
        candidates = fits = [i for i, material in enumerate(materials) if material.iridescence is not None]
    else:
        fits = [i for i, material in enumerate(materials) if material.name == name]
        if not fits and name.isdecimal() and int(name) < len(materials):
            fits = [int(name)]
    if len(fits) == 1:
        return fits[0]
    if name is None and not fits and any(material.bragg is not None for material in materials):
        raise UsageError(
            f"{file} has layers and no film; give layers by --layer, or draw them with `render`."
        )
    wanted = "with a film" if name is None else f"called '{name}'"
    has = f"{len(fits)} materials {wanted}" if fits else f"no material {wanted}"
    if not candidates:
        raise UsageError(f"{file} has {has}; name another file.")
    listed = ", ".join(material_label(i, materials[i].name) for i in candidates[:_LISTED_MAX])
    more = f" and {len(candidates) - _LISTED_MAX} more" if len(candidates) > _LISTED_MAX else ""
    raise UsageError(f"{file} has {has}; choose one with --material from: {listed}{more}.")


def _result(cosines: tuple[float, ...], evaluation: Evaluation) -> dict[str, Any]:
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
        "undefined": {
            case: [c for c, touched in zip(cosines, mask, strict=True) if touched]
            for case, mask in evaluation.undefined.items()
        },
    }


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
