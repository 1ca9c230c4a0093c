"""Compiled programs are kept for the next picture, but not for ever."""

from __future__ import annotations

import itertools

from gltf_iri.planning.effects import Effect
from gltf_iri.rendering.programs import KEPT_PROGRAMS, ProgramStore

SWITCHES = (Effect.BASE_COLOR_TEXTURE, Effect.ALPHA_MASK, Effect.ALPHA_BLEND, Effect.VERTEX_COLOR)


def permutations(count: int) -> list[tuple[str, ...]]:
    chosen = itertools.chain.from_iterable(
        itertools.combinations((*SWITCHES, Effect.EMISSION, Effect.NORMAL_TEXTURE), n) for n in range(7)
    )
    return [
        (Effect.UNLIT.define, *(e.define for e in effects)) for effects in itertools.islice(chosen, count)
    ]


def test_the_programs_used_last_are_kept_and_no_more(gl_context):
    store = ProgramStore(gl_context)
    first, *others = permutations(KEPT_PROGRAMS + 5)
    kept = store.get(first)
    for defines in others:
        store.get(defines)
    assert store.get(first) is kept
    store.trim()
    assert store.get(first) is kept
    assert len(store._programs) == KEPT_PROGRAMS
    store.release()
