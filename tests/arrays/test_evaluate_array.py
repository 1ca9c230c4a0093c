"""Budgets of whole arrays, where rows say what no reach does."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gltf_iri.arrays.evaluate_array import evaluate_array
from gltf_iri.arrays.films import ArrayFilms
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate


def test_rows_that_repeat_evenly_are_all_looked_at(tmp_path: Path) -> None:
    # Every second film is too thin to err by any method; a step of two would meet no other.
    count = 1 << 15
    cosine = np.random.default_rng(2).uniform(size=count)
    thickness_nm = np.where(np.arange(count) % 2 == 0, 0.0, 1100.0)
    np.save(tmp_path / "films.npy", np.column_stack([cosine, thickness_nm, np.full(count, 1.8)]))
    base = base_from_f0(np.full(3, 0.3))
    films = ArrayFilms(("cos", "thickness", "film_ior"), 0.0, 1.8, 1.0, {"dielectric": (1.0, base)})
    evaluate_array(tmp_path / "films.npy", tmp_path / "colours.npy", films, budget=1.0)
    some = slice(0, 2000)
    truth = evaluate("spectral", Film.of(cosine[some], thickness_nm[some], 1.8, base)).rgb
    found = np.load(tmp_path / "colours.npy")[some]
    assert np.percentile(delta_e_2000(found, truth), 95) <= 1.0
