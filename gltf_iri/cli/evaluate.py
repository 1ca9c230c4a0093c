"""`gltf-iri evaluate`: the reflectance colour of a film over angles."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import BACKENDS
from gltf_iri.cli.common import json_option, material_label, note, print_json, print_table
from gltf_iri.cli.value_types import Numbers, Setting
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.planning.method import DEFAULT_METHOD, DEFAULT_MIRROR_METHOD, METHODS, parameters_text

if TYPE_CHECKING:
    from gltf_iri.evaluation.film import Evaluation
    from gltf_iri.material.material import Material
    from gltf_iri.planning.method import Parameter

__all__ = ["command"]

# Even in cos θ, from straight on to grazing.
_DEFAULT_COSINES = tuple(i / 10 for i in range(10, -1, -1))

# glTF's own defaults, for the film and for its base.
_DEFAULT_FILM = Iridescence()
_DEFAULT_BASE = Ior()
_DEFAULT_OUTSIDE_IOR = 1.0

# Textures that make another base under the film; the film's own have their place in the title.
_TEXTURES_OF_THE_BASE = frozenset(
    {"base-color-texture", "metallic-roughness-texture", "specular-texture", "specular-color-texture"}
)

_LISTED_MAX = 8  # materials that an error names; `plan` lists them all


def _parameters_help() -> str:
    """Return the parameters of all methods, a line each, for the end of ``--help``."""
    lines = [
        f"  {method.name:13}  {each.name:12}  {_allowed(each)} [{_shown(each.default)}]"
        for method in METHODS.values()
        for each in method.parameters
    ]
    # Click leaves the lines of a paragraph alone that \b begins.
    return "\n".join(("\b", "Parameters for --set:", *lines))


def _shown(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _allowed(parameter: Parameter) -> str:
    if parameter.choices:
        return ", ".join(parameter.choices)
    return f"{parameter.minimum:g} to {parameter.maximum:g}"


@click.command(name="evaluate", epilog=_parameters_help())
@click.argument("file", required=False, type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--material", metavar="M", help="Material of FILE, by name or number; else its only film.")
@click.option("--film-ior", type=float, help=f"Refractive index of the film [{_DEFAULT_FILM.film_ior:g}].")
@click.option(
    "--thickness", type=float, metavar="NM", help=f"In nanometres [{_DEFAULT_FILM.thickness_max_nm:g}]."
)
@click.option("--base-f0", type=Numbers(1, 3), metavar="F|R,G,B", help="Base by its reflectance under air.")
@click.option("--base-ior", type=float, help=f"Base by its real index [{_DEFAULT_BASE.ior:g}].")
@click.option("--base-nk", type=Numbers(2), metavar="N,K", help="Base by its complex index N + iK.")
@click.option(
    "--base-edge-tint", type=Numbers(3), metavar="R,G,B", help="With --base-f0: a metal's tint at its edge."
)
@click.option("--outside-ior", type=float, help=f"Index outside the film [{_DEFAULT_OUTSIDE_IOR:g}].")
@click.option(
    "--cos",
    "cosines",
    type=Numbers(),
    metavar="C,C,…",
    default=_DEFAULT_COSINES,
    help="Cosines [1 to 0 by 0.1].",
)
@click.option(
    "--bragg",
    type=Numbers(5),
    metavar="N1,N2,D1,D2,CELLS",
    help="Mirror instead of a film: indices, thicknesses in nanometres, n1 first.",
)
@click.option("--host", "host_ior", type=float, help="Index outside the mirror [n1].")
@click.option(
    "--method",
    metavar="NAME",
    help=f"One of {', '.join(METHODS)} [{DEFAULT_METHOD}; for mirrors {DEFAULT_MIRROR_METHOD}].",
)
@click.option(
    "--set",
    "settings",
    type=Setting(),
    multiple=True,
    metavar="NAME=VALUE",
    help="Parameter of the method, see below.",
)
@click.option("--backend", type=click.Choice(BACKENDS), default="auto", help="What calculates [auto].")
@click.option("--white", metavar="D65|E", default="D65", help="White of the colours [D65].")
@click.option("--layered", is_flag=True, help="Add the specular colour and base weight of FILE's material.")
@json_option
def command(
    file: Path | None,
    material: str | None,
    cosines: tuple[float, ...],
    method: str | None,
    white: str,
    layered: bool,
    settings: tuple[tuple[str, str], ...],
    backend: str,
    as_json: bool,
    **subject: Any,
) -> None:
    """Print the film's or mirror's reflectance colour, linear Rec.709, at the outside angle's cosines.

    Either of a material of FILE, at its thickness maximum and without its textures, or of a film or a Bragg
    mirror given by options. Colours are not cut to the gamut: the truth may be negative in a channel.
    """
    parameters = dict(settings)
    if len(parameters) < len(settings):
        raise click.UsageError("--set names a parameter twice; give each once")
    how = _How(method, white, backend, parameters)
    if file is not None:
        result = _from_file(file, material, cosines, how, layered, subject)
    elif material is not None or layered:
        raise click.UsageError("--material and --layered need a FILE")
    elif subject["bragg"] is not None:
        result = _from_mirror(cosines, how, subject)
    else:
        result = _from_parameters(cosines, how, subject)
    if as_json:
        print_json(result)
        return
    _print(result)


@dataclass(frozen=True, slots=True)
class _How:
    """By which method, under which white, and by what."""

    method: str | None
    white: str
    backend: str
    parameters: dict[str, str]


def _from_mirror(cosines: tuple[float, ...], how: _How, given: dict[str, Any]) -> dict[str, Any]:
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
    )
    return _result(cosines, evaluation)


def _from_parameters(cosines: tuple[float, ...], how: _How, given: dict[str, Any]) -> dict[str, Any]:
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
        thickness_nm=_or(given["thickness"], _DEFAULT_FILM.thickness_max_nm),
        film_ior=_or(given["film_ior"], _DEFAULT_FILM.film_ior),
        base_f0=f0[0] if f0 is not None and len(f0) == 1 else f0,
        base_ior=given["base_ior"],
        base_nk=given["base_nk"],
        base_edge_tint=given["base_edge_tint"],
        outside_ior=_or(given["outside_ior"], _DEFAULT_OUTSIDE_IOR),
        white=how.white,
        backend=how.backend,
        parameters=how.parameters,
    )
    return _result(cosines, evaluation)


def _from_file(
    file: Path,
    name: str | None,
    cosines: tuple[float, ...],
    how: _How,
    layered: bool,
    given: dict[str, Any],
) -> dict[str, Any]:
    from gltf_iri.evaluation.material_film import evaluate_material
    from gltf_iri.planning.decide import plan_material
    from gltf_iri.scene.load import load

    for option, value in given.items():
        if value is not None and option != "thickness":
            raise click.UsageError(f"FILE's material decides --{option.replace('_', '-')}; leave it out")
    materials = load(file).materials
    index = _chosen(materials, name, file)
    plan = plan_material(materials[index], index, method=how.method)
    done = evaluate_material(
        materials[index],
        plan,
        cosines,
        thickness_nm=given["thickness"],
        white=how.white,
        backend=how.backend,
        parameters=how.parameters,
    )
    result = _result(cosines, done.film)
    result |= {"material": plan.name, "index": index, "thickness_nm": done.thickness_nm}
    result |= {"thickness_range_nm": done.thickness_range_nm, "factor": done.factor}
    result["textures_left_out"] = [e.value for e in plan.effects if e.value in _TEXTURES_OF_THE_BASE]
    if layered:
        result |= {"specular": done.layer.specular, "base_weight": done.layer.base_weight}
    return result


def _chosen(materials: tuple[Material, ...], name: str | None, file: Path) -> int:
    """Return the index of the material called `name` or numbered so, or of the only one with a film."""
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
    wanted = "with a film" if name is None else f"called '{name}'"
    has = f"{len(fits)} materials {wanted}" if fits else f"no material {wanted}"
    if not candidates:
        raise UsageError(f"{file} has {has}; name another file.")
    listed = ", ".join(material_label(i, materials[i].name) for i in candidates[:_LISTED_MAX])
    more = f" and {len(candidates) - _LISTED_MAX} more" if len(candidates) > _LISTED_MAX else ""
    raise UsageError(f"{file} has {has}; choose one with --material from: {listed}{more}.")


def _result(cosines: tuple[float, ...], evaluation: Evaluation) -> dict[str, Any]:
    return {
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


def _print(result: dict[str, Any]) -> None:
    columns = ["cos θ", "R", "G", "B"]
    rows = [
        [f"{c:g}", *(f"{v:.6f}" for v in rgb)] for c, rgb in zip(result["cos"], result["rgb"], strict=True)
    ]
    if "specular" in result:
        columns += ["specular R", "G", "B", "base weight"]
        for row, specular, weight in zip(rows, result["specular"], result["base_weight"], strict=True):
            row += [*(f"{v:.6f}" for v in specular), f"{weight:.6f}"]
    method = ", ".join(filter(None, (result["method"], parameters_text(result["parameters"]))))
    title = f"{method}, by {result['backend']}, {result['white']} white, linear Rec.709"
    if "material" in result:
        label = material_label(result["index"], result["material"])
        low_nm, high_nm = result["thickness_range_nm"]
        of_range = "" if low_nm == high_nm else f" of {low_nm:g} to {high_nm:g}"
        title += f"; material {label}, {result['thickness_nm']:g} nm{of_range}, factor {result['factor']:g}"
    print_table(columns, rows, title=title)
    if result.get("textures_left_out"):
        left_out = ", ".join(result["textures_left_out"])
        note(f"The base is that of the material's factors alone, without {left_out}.")
    for case, where in result["undefined"].items():
        note(f"the method leaves undefined: {case}, at cos θ = {', '.join(f'{c:g}' for c in where)}.")


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
