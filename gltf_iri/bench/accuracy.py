"""The map of cost and error: every way to a colour, on every device, over fixed sets and real materials."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from gltf_iri.bench.accuracy_entries import Truth, measured, method_entries, table_entries, true_colours
from gltf_iri.bench.accuracy_glsl import glsl_rows
from gltf_iri.bench.accuracy_layers import (
    LAYERS,
    LayerSubject,
    layer_rows,
    layer_subject,
    layer_truth,
    stack_tables,
)
from gltf_iri.bench.accuracy_layers_glsl import layer_glsl_rows
from gltf_iri.bench.accuracy_row import AccuracyRow, Errors
from gltf_iri.bench.accuracy_sets import ACCURACY_SETS
from gltf_iri.bench.accuracy_tables import Tables, film_tables, look_ups, set_parts
from gltf_iri.bench.film_parts import FilmPart, film_of, points_of
from gltf_iri.bench.mirror_tables import mirror_tables
from gltf_iri.bench.real_materials import SAMPLES, file_parts, sample_parts, set_names
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror

if TYPE_CHECKING:
    import moderngl

__all__ = ["Subject", "measure_set", "subjects"]

# Timing of one set, on numpy and compiled together, and in OpenGL: eight sets and the samples stay well below
# ten minutes.
_PYTHON_S: Final = 14.0
_GLSL_S: Final = 8.0

_POINTS: Final = 1200
_SEED: Final = 4


@dataclass(frozen=True, slots=True)
class Subject:
    """A set: its films or mirrors, and those of its films that have tables, in groups measured apart."""

    colours: Film | Mirror
    parts: Sequence[Sequence[FilmPart]]


def subjects(files: Sequence[Path] = ()) -> Mapping[str, Callable[[], Subject | LayerSubject]]:
    """Return every set by its name: the fixed ones, then the materials of `files` or of the samples.

    A set of a file raises UsageError where it has no film, and as `load` where it cannot be read.
    """
    found: dict[str, Callable[[], Subject | LayerSubject]] = {
        name: partial(_fixed, name) for name in ACCURACY_SETS
    }
    found[LAYERS] = layer_subject
    if not files:
        found[SAMPLES] = _samples
    for name, path in zip(set_names(files), files, strict=True):
        found[name] = partial(_file, path)
    return found


def measure_set(
    workload: str,
    subject: Subject | LayerSubject,
    context: moderngl.Context | None,
    rounds: int | None = None,
) -> list[AccuracyRow]:
    """Return the rows of one set on numpy, compiled where numba is installed, and in OpenGL with a context.

    rounds : of the timings; None for as many as some seconds allow.
    """
    if isinstance(subject, LayerSubject):
        of_layers, filled = layer_truth(subject), stack_tables(subject)
        found = layer_rows(workload, subject, of_layers, filled, _PYTHON_S, rounds)
        if context is not None:
            found += layer_glsl_rows(context, workload, subject, of_layers.rgb, filled, _GLSL_S, rounds)
        return found
    truth = true_colours(subject.colours)
    tables = list(_tables(workload, subject))
    entries = list(method_entries(subject.colours, truth))
    for each in tables:
        entries += table_entries(each)
    rows = measured(workload, entries, _PYTHON_S, rounds)
    if not any(row.is_truth for row in rows):
        rows.insert(0, _truth_row(workload, truth))
    if context is not None:
        rows += glsl_rows(context, workload, subject.colours, truth.rgb, tables, _GLSL_S, rounds)
    return rows


def _fixed(name: str) -> Subject:
    colours = ACCURACY_SETS[name]()
    return Subject(colours, [] if isinstance(colours, Mirror) else set_parts(name, colours))


def _samples() -> Subject:
    return _real(sample_parts(), "the samples")


def _file(path: Path) -> Subject:
    return _real(file_parts(path), f"'{path}'")


def _real(parts: list[FilmPart], what: str) -> Subject:
    if not parts:
        raise UsageError(f"No material of {what} has a film to measure.")
    g = np.random.default_rng(_SEED)
    points = [points_of(part, max(1, _POINTS // len(parts)), g) for part in parts]
    return Subject(film_of(points), [parts])


def _tables(workload: str, subject: Subject) -> list[Tables]:
    colours = subject.colours
    if isinstance(colours, Mirror):
        return list(mirror_tables(colours))
    tables = [each for parts in subject.parts for each in film_tables(parts)]
    lobe = subject.parts[0][0].lobe
    return [*tables, *look_ups(colours, lobe)] if workload in ACCURACY_SETS else tables


def _truth_row(workload: str, truth: Truth) -> AccuracyRow:
    exact = Errors(0.0, 0.0, 0.0, 0.0, 0)
    ns = 1e9 * truth.seconds / len(truth.rgb)
    return AccuracyRow(workload, "numpy", truth.method, truth.method, truth.method, ns, exact)
