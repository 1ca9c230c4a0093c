"""`gltf-iri evaluate --in FILMS.npy --out COLOURS.npy`: the same for as many films as a disk holds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import note, print_json, progress
from gltf_iri.cli.evaluate_material import chosen_material
from gltf_iri.cli.evaluate_subject import (
    DEFAULT_BASE,
    DEFAULT_FILM,
    DEFAULT_OUTSIDE_IOR,
    How,
)

if TYPE_CHECKING:
    from gltf_iri.arrays.evaluate_array import ArrayReport
    from gltf_iri.arrays.films import ArrayFilms
    from gltf_iri.evaluation.film import Base

__all__ = ["DEFAULT_COLUMNS", "array_to_array"]

DEFAULT_COLUMNS = ("cos", "thickness")

# The columns that each option is a constant for.
_OPTION_OF = {
    "thickness": "thickness",
    "film_ior": "film_ior",
    "outside_ior": "outside_ior",
    **dict.fromkeys(("base_f0", "base_r", "base_g", "base_b"), "base"),
}
_BASES = ("base_f0", "base_ior", "base_nk")


def array_to_array(
    source: Path,
    out: Path | None,
    columns: tuple[str, ...],
    file: Path | None,
    material: str | None,
    how: How,
    budget: float | None,
    given: dict[str, Any],
    *,
    as_json: bool,
) -> None:
    """Evaluate the rows of `source` into `out` and tell how; `given` are the options that describe a film."""
    from gltf_iri.arrays.evaluate_array import evaluate_array, steps_of_array
    from gltf_iri.baking.cache import TableCache
    from gltf_iri.colour.spaces import WHITES
    from gltf_iri.errors import UsageError

    if out is None:
        raise click.UsageError("--in wants --out, the .npy file that the colours are written to")
    white = next((each for each in WHITES if each == how.white), None)
    if white is None:
        raise UsageError(f"There is no white '{how.white}'; choose one of: {', '.join(WHITES)}.")
    films = _films(columns, file, material, given)
    cache = TableCache()
    with progress("Evaluating", steps_of_array(source, columns)) as advance:
        report = evaluate_array(
            source,
            out,
            films,
            method=how.method,
            budget=budget,
            parameters=how.parameters,
            white=white,
            backend=how.backend,
            cache=cache,
            advance=advance,
        )
    for text in cache.notes:
        note(text)
    if as_json:
        print_json(report.to_json())
    else:
        _print(report)


def _films(
    columns: tuple[str, ...], file: Path | None, material: str | None, given: dict[str, Any]
) -> ArrayFilms:
    """Return what the rows are films of; click.UsageError where a column and an option say the same."""
    from gltf_iri.arrays.films import ArrayFilms, lobe_of

    if any(given[name] is not None for name in ("bragg", "host_ior", "layer", "light", "period_texel")):
        raise click.UsageError("--in reads films; mirrors and layers are evaluated at --cos")
    asked = {name for name, value in given.items() if value is not None}
    for column in columns:
        option = _OPTION_OF.get(column)
        rivals = [*_BASES, "base_edge_tint"] if option == "base" else [option]
        for name in asked.intersection(name for name in rivals if name):
            raise click.UsageError(
                f"--{name.replace('_', '-')} and the column {column} say the same; give one"
            )
    if file is not None:
        return _films_of_material(columns, file, material, given)
    if material is not None:
        raise click.UsageError("--material needs a FILE")
    base = _base(given)
    return ArrayFilms(
        columns,
        _or(given["thickness"], DEFAULT_FILM.thickness_max_nm),
        _or(given["film_ior"], DEFAULT_FILM.film_ior),
        _or(given["outside_ior"], DEFAULT_OUTSIDE_IOR),
        {lobe_of(columns, base): (1.0, base)},
    )


def _base(given: dict[str, Any]) -> Base:
    import numpy as np

    from gltf_iri.evaluation.film import base_from_edge_tint, base_from_f0, base_from_ior

    named = [f"--{name.replace('_', '-')}" for name in _BASES if given[name] is not None]
    if len(named) > 1:
        raise click.UsageError(f"{' and '.join(named)} each describe the base: give one of them")
    if given["base_f0"] is not None:
        f0 = np.broadcast_to(np.asarray(given["base_f0"]), (3,))
        tint = given["base_edge_tint"]
        return base_from_f0(f0) if tint is None else base_from_edge_tint(f0, tint)
    if given["base_edge_tint"] is not None:
        raise click.UsageError("--base-edge-tint needs --base-f0, the metal's colour straight on")
    if given["base_nk"] is not None:
        return base_from_ior(complex(*given["base_nk"]))
    return base_from_ior(_or(given["base_ior"], DEFAULT_BASE.ior))


def _films_of_material(
    columns: tuple[str, ...], file: Path, name: str | None, given: dict[str, Any]
) -> ArrayFilms:
    from gltf_iri.arrays.films import films_of_material
    from gltf_iri.scene.load import load

    for option, value in given.items():
        if value is not None and option != "thickness":
            raise click.UsageError(f"FILE's material decides --{option.replace('_', '-')}; leave it out")
    for column in columns:
        if column not in DEFAULT_COLUMNS:
            raise click.UsageError(f"FILE's material decides {column}; leave the column out")
    materials = load(file).materials
    index = chosen_material(materials, name, file)
    return films_of_material(materials[index], index, columns, given["thickness"])


def _print(report: ArrayReport) -> None:
    threads = "1 thread" if report.threads == 1 else f"{report.threads} threads"
    kept = ""
    if report.delta_e is not None:
        from gltf_iri.budgets.search import figure

        kept = f", ΔE ≤ {figure(report.delta_e)}"
    held = "" if report.anonymous_bytes is None else f", {report.anonymous_bytes / 1e6:.0f} MB of memory"
    click.echo(
        f"{report.rows:,} colours are in {report.out}: {report.way}, by {report.backend}, {threads}{kept}; "
        f"{report.seconds:.2f} s after {report.planning_s:.2f} s of planning, "
        f"{report.ns_per_colour:.3g} ns a colour{held}."
    )
    for case, rows in report.undefined.items():
        note(f"the method leaves undefined: {case}, in {rows:,} rows.")


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
