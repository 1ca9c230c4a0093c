"""Workload `glsl`: what the methods' GLSL twins cost on the OpenGL at hand, and how far they are off."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from gltf_iri.bench import films, mirrors
from gltf_iri.bench.colour_rows import WHITE, ColourRow, colour_row, with_ratios
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS, Domain, method_names, truth_of
from gltf_iri.planning.settings import Settings, settings_of, with_defaults
from gltf_iri.rendering.probe import Probe
from gltf_iri.rendering.timing import time_twins

if TYPE_CHECKING:
    import moderngl

__all__ = ["GLSL_ROUNDS", "GLSL_WORKLOADS", "measure_glsl"]

GLSL_ROUNDS: Final = 7
_CELLS: Final = 20
_SIDE: Final = 256  # the truth as a loop in GLSL takes a second for so many pixels in software

GLSL_WORKLOADS: Final[Mapping[str, tuple[Domain, Callable[[], Film | Mirror]]]] = {
    "glsl-films": ("film", film_set),
    f"glsl-mirrors-{_CELLS}": ("mirror", lambda: mirror_set(_CELLS)),
}


def measure_glsl(
    context: moderngl.Context, rounds: int = GLSL_ROUNDS, after_workload: Callable[[], None] = lambda: None
) -> list[ColourRow]:
    """Return a row for each method that has a GLSL twin and each of its settings; `backend` is the renderer.

    A round draws each method once, with one of its settings; a method that has fewer than others stands in
    every one, and keeps the times of the first.
    """
    rows: list[ColourRow] = []
    for workload, (domain, subjects) in GLSL_WORKLOADS.items():
        subject = subjects()
        names = [name for name in method_names(domain) if METHODS[name].glsl_function]
        if names:
            measured = list(_measure(context, workload, subject, names, rounds))
            rows += with_ratios(measured, films.RATIO_TO if domain == "film" else mirrors.RATIO_TO)
        after_workload()
    return rows


def _measure(
    context: moderngl.Context, workload: str, subject: Film | Mirror, names: Sequence[str], rounds: int
) -> Iterator[ColourRow]:
    truth = evaluate(_truth(subject), subject, white=WHITE, backend="numpy").rgb
    probe = Probe(context)
    settings = {name: settings_of(name) for name in names}
    for turn in range(max(map(len, settings.values()))):
        now: dict[str, Settings] = {name: each[min(turn, len(each) - 1)] for name, each in settings.items()}
        times = time_twins(context, names, subject, parameters=now, rounds=rounds, side=_SIDE, white=WHITE)
        for name in names:
            if turn < len(settings[name]):
                rgb = probe.evaluate(name, subject, white=WHITE, parameters=now[name]).rgb
                labels = workload, name, times.renderer
                yield colour_row(labels, with_defaults(name, now[name]), times.ns_per_eval[name], rgb, truth)


def _truth(subject: Film | Mirror) -> str:
    return truth_of("mirror" if isinstance(subject, Mirror) else "film")
