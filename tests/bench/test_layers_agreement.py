"""Colours of layers by the whole rule, in GLSL and in Python: some of those of `bench layers-agreement`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from gltf_iri.bench.layers_agreement import agreement_steps, measure_agreement

if TYPE_CHECKING:
    import moderngl


@pytest.mark.gl
def test_every_colour_of_one_layer_and_of_two_has_its_row(gl_context: moderngl.Context) -> None:
    counts, chunks = {1: 200, 2: 100}, []
    rows = measure_agreement(gl_context, counts, lambda: chunks.append(1))
    assert [(row.layers, row.colour) for row in rows] == [
        (1, "reflected by layer 1"),
        (1, "passed"),
        (1, "f_r"),
        (2, "reflected by layer 1"),
        (2, "reflected by layer 2"),
        (2, "passed"),
        (2, "f_r"),
    ]
    assert len(chunks) == agreement_steps(counts)
    for row in rows:
        assert row.count == counts[row.layers]
        assert row.max_abs > 0.0
        # A narrow lobe moves further by a step of its cosines than colours do.
        assert row.beyond <= (row.colour == "f_r")
        assert row.beyond_steps == 0
