"""`gltf-iri evaluate`: the reflectance colour of a film, a mirror or layers over angles."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import BACKENDS
from gltf_iri.cli.budget import budget_option, check_choice
from gltf_iri.cli.common import json_option, material_label, note, print_json, print_table, working
from gltf_iri.cli.evaluate_array import DEFAULT_COLUMNS, array_to_array
from gltf_iri.cli.evaluate_layers import from_layers, layer_options, print_layers, refuse_layer_options
from gltf_iri.cli.evaluate_material import from_file, print_material_layers
from gltf_iri.cli.evaluate_subject import (
    DEFAULT_BASE,
    DEFAULT_FILM,
    DEFAULT_OUTSIDE_IOR,
    How,
    from_mirror,
    from_parameters,
    note_undefined,
    title_of,
)
from gltf_iri.cli.value_types import Numbers, Setting
from gltf_iri.planning.method import (
    DEFAULT_LAYERS_METHOD,
    DEFAULT_METHOD,
    DEFAULT_MIRROR_METHOD,
    METHODS,
)

if TYPE_CHECKING:
    from gltf_iri.planning.method import Parameter

__all__ = ["command"]

# Even in cos θ, from straight on to grazing.
_DEFAULT_COSINES = tuple(i / 10 for i in range(10, -1, -1))
_BY_DEFAULT = click.core.ParameterSource.DEFAULT


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
@click.option(
    "--material", metavar="M", help="Material of FILE, by name or number; else its only film or layers."
)
@click.option("--film-ior", type=float, help=f"Refractive index of the film [{DEFAULT_FILM.film_ior:g}].")
@click.option(
    "--thickness", type=float, metavar="NM", help=f"In nanometres [{DEFAULT_FILM.thickness_max_nm:g}]."
)
@click.option("--base-f0", type=Numbers(1, 3), metavar="F|R,G,B", help="Base by its reflectance under air.")
@click.option("--base-ior", type=float, help=f"Base by its real index [{DEFAULT_BASE.ior:g}].")
@click.option("--base-nk", type=Numbers(2), metavar="N,K", help="Base by its complex index N + iK.")
@click.option(
    "--base-edge-tint", type=Numbers(3), metavar="R,G,B", help="With --base-f0: a metal's tint at its edge."
)
@click.option("--outside-ior", type=float, help=f"Index outside the film [{DEFAULT_OUTSIDE_IOR:g}].")
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
@layer_options
@click.option("--host", "host_ior", type=float, help="Index outside the mirror or layers [n1].")
@click.option(
    "--method",
    metavar="NAME",
    help=f"One of {', '.join(METHODS)} [{DEFAULT_METHOD}; for mirrors {DEFAULT_MIRROR_METHOD}; "
    f"for layers {DEFAULT_LAYERS_METHOD}].",
)
@budget_option
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
@click.option(
    "--in",
    "source",
    type=click.Path(path_type=Path),
    metavar="FILMS.npy",
    help="Films, a row each, for --out.",
)
@click.option(
    "--out", type=click.Path(path_type=Path), metavar="COLOURS.npy", help="Colours, a row each, of --in."
)
@click.option(
    "--columns",
    metavar="NAME,NAME,…",
    help="What --in holds: cos, thickness, film_ior, outside_ior, base_f0 or base_r, base_g, base_b "
    f"[{','.join(DEFAULT_COLUMNS)}].",
)
@click.option(
    "--layered",
    is_flag=True,
    help="Add what FILE's material makes of it: of a film the specular colour and base weight, of layers the "
    "surface without them and both, mixed by the factor.",
)
@json_option
def command(
    file: Path | None,
    material: str | None,
    cosines: tuple[float, ...],
    method: str | None,
    budget: float | None,
    white: str,
    source: Path | None,
    out: Path | None,
    columns: str | None,
    layered: bool,
    settings: tuple[tuple[str, str], ...],
    backend: str,
    as_json: bool,
    **subject: Any,
) -> None:
    """Print reflectance colours of a film, mirror or layers, linear Rec.709, at cosines of the outside angle.

    Either of a material of FILE, at its thickness or period maxima and without its textures, or of a film, a
    Bragg mirror or rough layers given by options; or of all the films in a .npy file, into another. Of
    layers, what they send back over all directions, and what they transmit and absorb, or with --light their
    BRDF. Colours are not cut to the gamut: the truth may be negative in a channel.
    """
    parameters = dict(settings)
    if len(parameters) < len(settings):
        raise click.UsageError("--set names a parameter twice; give each once")
    check_choice(budget, method=method, set=settings)
    how = How(method, white, backend, parameters, budget)
    subject["layer"] = subject["layer"] or None
    if subject["layer"] is None:
        refuse_layer_options(subject, has_file=file is not None)
    if source is not None:
        if layered or click.get_current_context().get_parameter_source("cosines") is not _BY_DEFAULT:
            raise click.UsageError("--in has its cosines in a column, and no --layered")
        names = DEFAULT_COLUMNS if columns is None else tuple(name.strip() for name in columns.split(","))
        array_to_array(source, out, names, file, material, how, budget, subject, as_json=as_json)
        return
    if out is not None or columns is not None:
        raise click.UsageError("--out and --columns need --in, a .npy file of films")
    if file is not None:
        with working("Evaluating the material"):
            result = from_file(file, material, cosines, how, layered, subject)
        if "layers" in result and not as_json:
            print_material_layers(result)
            _note_the_rest(result)
            return
    elif material is not None or layered:
        raise click.UsageError("--material and --layered need a FILE")
    elif subject["layer"] is not None:
        with working("Evaluating the layers"):
            layers = from_layers(cosines, how, subject)
        (print_json if as_json else print_layers)(layers)
        return
    elif subject["bragg"] is not None:
        result = from_mirror(cosines, how, subject)
    else:
        result = from_parameters(cosines, how, subject)
    if as_json:
        print_json(result)
        return
    _print(result)


def _print(result: dict[str, Any]) -> None:
    columns = ["cos θ", "R", "G", "B"]
    rows = [
        [f"{c:g}", *(f"{v:.6f}" for v in rgb)] for c, rgb in zip(result["cos"], result["rgb"], strict=True)
    ]
    if "specular" in result:
        columns += ["specular R", "G", "B", "base weight"]
        for row, specular, weight in zip(rows, result["specular"], result["base_weight"], strict=True):
            row += [*(f"{v:.6f}" for v in specular), f"{weight:.6f}"]
    title = title_of(result)
    if "material" in result:
        label = material_label(result["index"], result["material"])
        low_nm, high_nm = result["thickness_range_nm"]
        of_range = "" if low_nm == high_nm else f" of {low_nm:g} to {high_nm:g}"
        title += f"; material {label}, {result['thickness_nm']:g} nm{of_range}, factor {result['factor']:g}"
    print_table(columns, rows, title=title)
    if "reason" in result:
        note(f"Computed as a film: {result['reason']}.")
    note_undefined(result)
    _note_the_rest(result)


def _note_the_rest(result: Mapping[str, Any]) -> None:
    """Say what of a file's material is not in the numbers."""
    if result.get("textures_left_out"):
        left_out = ", ".join(result["textures_left_out"])
        note(f"The material's factors stand alone, without {left_out}.")
    for effect, reason in result.get("not_drawn", {}).items():
        note(f"{effect} is not in these numbers: {reason}.")
