"""`gltf-iri bench`: time and error of every method."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import has_numba
from gltf_iri.cli.bench_accuracy import check_folder, measure_accuracy, print_accuracy, write_accuracy
from gltf_iri.cli.bench_aliasing import measure_pictures, print_aliasing, write_aliasing
from gltf_iri.cli.bench_budgets import measure_ways
from gltf_iri.cli.bench_scenes import WHOLE, measure_whole
from gltf_iri.cli.bench_tables import print_colours, print_optics
from gltf_iri.cli.common import json_option, note, print_json, progress
from gltf_iri.errors import UsageError

if TYPE_CHECKING:
    from gltf_iri.bench.accuracy_row import AccuracyRow
    from gltf_iri.bench.aliasing import Aliasing
    from gltf_iri.bench.colour_rows import ColourRow
    from gltf_iri.bench.optics import OpticsRow

__all__ = ["FILMS", "OPTICS", "command"]

OPTICS = ("W1", "W2", "W3", "W4", "W5", "lossy-film", "tir-film", "lossy-cells", "tir-cells")
FILMS = ("films", "films-3um")
_REST = ("accuracy", "aliasing", "budgets", *WHOLE)
_NAMES = (*FILMS, "dispersion", "mirrors", "optics", *OPTICS, "glsl", *_REST)
_DEFAULT = ("films", "mirrors")


@dataclass(slots=True)
class _Report:
    """What one call measured: tables for people, and the same rows for programs."""

    machine: dict[str, Any] = field(default_factory=dict)
    rows: list[Any] = field(default_factory=list)
    skipped: dict[str, str] = field(default_factory=dict)
    tables: list[Callable[[], None]] = field(default_factory=list)

    def leave_out(self, name: str, reason: str) -> None:
        """Note what is not measured, and why."""
        self.skipped[name] = reason
        note(f"{name} is left out: {reason}")


@click.command(name="bench")
@click.argument("names", metavar="[NAME]...", nargs=-1, type=click.Choice(_NAMES))
@click.option("--peers", is_flag=True, help="Beside the libraries that compute the same (optics only).")
@click.option("--rounds", type=click.IntRange(1, 1000), metavar="N", help="Rounds a median is taken over.")
@click.option(
    "--plot",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE.png",
    help="Draw time against error (optics only).",
)
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="Write tables, plots and the map of costs there (accuracy), or the pictures (aliasing).",
)
@click.option(
    "--file",
    "files",
    type=click.Path(exists=True, dir_okay=False, readable=True, path_type=Path),
    multiple=True,
    metavar="FILE",
    help="Measure this file in place of the samples (accuracy, budgets and scenes only).",
)
@click.option(
    "--count", type=click.IntRange(1), metavar="N", help="Films of the file (arrays), or materials (budgets)."
)
@json_option
def command(
    names: tuple[str, ...],
    peers: bool,
    rounds: int | None,
    plot: Path | None,
    out: Path | None,
    files: tuple[Path, ...],
    count: int | None,
    as_json: bool,
) -> None:
    """Measure the workloads called NAME; without a name, films and mirrors.

    films, films-3um: 1,200 random dielectric films up to 800 nm, or 3 µm, each method against the converged
    spectral truth under D65. mirrors: the same for Bragg mirrors of 5 to 200 cells. dispersion: what one
    index a channel costs where the media are real ones.

    optics: reflectances of films, mirrors and stacks on one thread, their error against 50 digits; it is the
    sum of W1 to W5, lossy-film, tir-film, lossy-cells and tir-cells, each of which is a NAME too.

    glsl: what a colour costs in OpenGL, on one core where the renderer is software.

    accuracy: the map of cost and error: every method with all its settings, and baked tables, by numpy,
    compiled and in OpenGL, over films, films on metals, thick films, mirrors, and the materials of files.

    aliasing: a sphere under a film of finely varying thickness in 16 to 1024 pixels, against many samples a
    pixel: drawn with the thickness of one texel, with the mean thickness, and with its spread.

    budgets: random materials planned within budgets of ΔE 3 to 0.001, and whether what was chosen keeps them
    at other points than those it was measured at.

    scenes: what iridescence adds to the time of shading 1024 × 1024 pixels, and its error. twenty: what 3
    iridescent materials add to a scene of 17, compiling included. image-light: rough films under a white
    sky. arrays: colours of a .npy file of films. layers: rough layers of mirrors as Fourneau et al. 2024
    measure them, beside their printed figures. layers-agreement: 100,000 random layers and 10,000 pairs, GLSL
    against Python.
    """
    chosen = dict.fromkeys(names or _DEFAULT)
    optics = [name for name in OPTICS if name in chosen or "optics" in chosen]
    if (peers or plot) and not optics:
        raise UsageError("--peers and --plot want a workload of reflectances: optics, or one of W1 to W5.")
    if files and chosen.keys().isdisjoint({"accuracy", "budgets", "scenes"}):
        raise UsageError("--file wants the workload accuracy, budgets or scenes.")
    if count and chosen.keys().isdisjoint({"arrays", "budgets"}):
        raise UsageError("--count wants the workload arrays or budgets.")
    if out and chosen.keys().isdisjoint({"accuracy", "aliasing"}):
        raise UsageError("-o wants the workload accuracy or aliasing.")
    if plot:
        _check_plot(plot)
    if out:
        check_folder(out)
    report = _Report()
    if not has_numba() and not set(chosen) <= {"glsl", "dispersion", "aliasing", "budgets", *WHOLE}:
        report.leave_out("numba", "compiled loops need it (pip install 'gltf-iri[fast]')")
    for name in FILMS:
        if name in chosen:
            _films(report, name, rounds)
    if "dispersion" in chosen:
        _dispersion(report)
    if "mirrors" in chosen:
        _mirrors(report, rounds)
    if optics:
        _optics(report, optics, peers, rounds)
    if "glsl" in chosen:
        _glsl(report, rounds)
    measured: list[AccuracyRow] = []
    if "accuracy" in chosen:
        measured, about = measure_accuracy(files, report.leave_out, rounds)
        report.machine.update(about)
        report.rows += measured
        report.tables.append(lambda: print_accuracy(measured))
    pictures: Aliasing | None = None
    if "aliasing" in chosen:
        pictures, about = measure_pictures()
        report.machine.update(about)
        report.rows += pictures.rows
        report.tables.append(partial(print_aliasing, pictures))
    if "budgets" in chosen:
        ways, table = measure_ways(files, count)
        report.rows += ways
        report.tables.append(table)
    for name in WHOLE:
        if name in chosen:
            whole, table = measure_whole(name, files, rounds, count)
            report.rows += whole
            report.tables.append(table)
    if as_json:
        rows = [row.to_json() for row in report.rows]
        print_json({"white": "D65", "machine": report.machine, "skipped": report.skipped, "rows": rows})
    else:
        for table in report.tables:
            table()
    if plot:
        # After the figures, which a full disk must not cost.
        _draw(plot, report)
        if not as_json:
            click.echo(f"The plot is {plot}.")
    if out and measured:
        write_accuracy(out, measured, report.machine, report.skipped)
        if not as_json:
            click.echo(f"The map is in {out}.")
    if out and pictures:
        write_aliasing(out, pictures, report.machine)
        if not as_json:
            click.echo(f"The pictures are in {out}.")


def _check_plot(plot: Path) -> None:
    """Refuse a place where no plot can be written before anything is measured."""
    if plot.suffix.lower() != ".png":
        raise UsageError(f"A plot is a .png file; '{plot.name}' is not.")
    if not plot.parent.is_dir():
        raise UsageError(f"There is no folder '{plot.parent}' to write '{plot.name}' into; make it first.")


def _draw(plot: Path, report: _Report) -> None:
    from gltf_iri.bench.optics import OpticsRow
    from gltf_iri.bench.plot import plot_optics
    from gltf_iri.whole_files import write_or_refuse

    write_or_refuse({plot: plot_optics([row for row in report.rows if isinstance(row, OpticsRow)])})


def _films(report: _Report, name: str, rounds: int | None) -> None:
    from gltf_iri.bench.films import FILM_ROUNDS, measure_films
    from gltf_iri.bench.timing import one_thread

    count = rounds or FILM_ROUNDS
    with one_thread(), progress(name, count) as advance:
        rows = measure_films(name, count, advance)
    _add_colours(report, rows, "Films against spectral truth")


def _dispersion(report: _Report) -> None:
    from gltf_iri.bench.dispersion_cost import DISPERSIVE_PAIRS, measure_dispersion

    with progress("dispersion", len(DISPERSIVE_PAIRS)) as advance:
        rows = measure_dispersion(advance)
    _add_colours(report, rows, "One index a channel against indices by wavelength")


def _mirrors(report: _Report, rounds: int | None) -> None:
    from gltf_iri.bench.mirrors import MIRROR_ROUNDS, MIRROR_WORKLOADS, landmark_parts, measure_mirrors
    from gltf_iri.bench.timing import one_thread

    count = rounds or MIRROR_ROUNDS
    rows: list[ColourRow] = []
    with one_thread(), progress("mirrors", count * len(MIRROR_WORKLOADS)) as advance:
        for name in MIRROR_WORKLOADS:
            rows += measure_mirrors(name, count, advance)
        rows += landmark_parts()
    _add_colours(report, rows, "Mirrors against spectral truth")


def _glsl(report: _Report, rounds: int | None) -> None:
    from gltf_iri.bench.timing import one_thread

    with one_thread():
        from gltf_iri.bench.glsl import GLSL_ROUNDS, GLSL_WORKLOADS, measure_glsl
        from gltf_iri.rendering.context import create_context

        # Its threads are counted when it is made.
        context = create_context()
        with progress("glsl", len(GLSL_WORKLOADS)) as advance:
            rows = measure_glsl(context, rounds or GLSL_ROUNDS, advance)
    _add_colours(report, rows, "GLSL twins against spectral truth")


def _add_colours(report: _Report, rows: list[ColourRow], title: str) -> None:
    from gltf_iri.bench.machine import machine

    report.machine.update(machine())
    report.rows += rows
    report.tables.append(lambda: print_colours(rows, title))


def _optics(report: _Report, names: Sequence[str], peers: bool, rounds: int | None) -> None:
    from gltf_iri.bench.timing import one_thread

    with one_thread() as is_pinned:
        # Imported here: what they load reads the number of threads when it is loaded.
        from gltf_iri.bench.machine import machine
        from gltf_iri.bench.optics import OPTICS_ROUNDS, load_peers, measure_optics
        from gltf_iri.bench.peers import PEERS

        libraries: dict[str, Any] = {}
        if peers:
            libraries, missing = load_peers()
            for name, reason in missing.items():
                report.leave_out(name, reason)
        count = rounds or OPTICS_ROUNDS
        rows: list[OpticsRow] = []
        with progress("optics", count * len(names)) as advance:
            for measured in measure_optics(names, libraries, count, after_round=advance):
                rows += measured
        packages = tuple(dict.fromkeys(each.package for each in PEERS)) if peers else ()
        report.machine.update(machine(packages), threads=1, is_pinned_to_one_core=is_pinned)
    report.rows += rows
    report.tables.append(lambda: print_optics(rows, report.machine))
