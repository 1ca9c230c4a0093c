"""Every law is kept by every method, or shown to be broken for the reason that the table gives."""

from __future__ import annotations

from itertools import chain
from pathlib import Path

import pytest
from laws_cells import CELL_SUBJECTS
from laws_film import FILM_LAWS
from laws_spectral import SUBJECTS
from laws_table import BROKEN, MADE_OF, TABLES, markdown

from gltf_iri.planning.method import METHODS, method_names

NOTES = Path(__file__).resolve().parents[2] / "spec" / "optics-notes.md"

KEPT = [
    pytest.param(which, subject, law, id=f"{subject}: {law}")
    for which, subjects in BROKEN.items()
    for subject, reasons in subjects.items()
    for law in TABLES[which]
    if law not in reasons
]
BREACHES = [
    pytest.param(which, subject, law, id=f"{subject}: {law}, because {reason}")
    for which, subjects in BROKEN.items()
    for subject, reasons in subjects.items()
    for law, reason in reasons.items()
]


@pytest.mark.parametrize(("which", "subject", "name"), KEPT)
def test_law_is_kept(which: str, subject: str, name: str) -> None:
    law = TABLES[which][name]
    assert law.departure(subject) <= law.bound


@pytest.mark.parametrize(("which", "subject", "name"), BREACHES)
def test_law_is_broken(which: str, subject: str, name: str) -> None:
    """Not by rounding: by ten times what is granted to it."""
    law = TABLES[which][name]
    assert law.departure(subject) > 10.0 * law.bound


def test_every_method_stands_in_the_table() -> None:
    assert set(BROKEN["film"]) == set(method_names("film"))
    assert set(BROKEN["mirror"]) == set(method_names("mirror"))
    assert set(BROKEN["wavelength"]) == set(SUBJECTS)
    assert set(BROKEN["cells"]) == set(CELL_SUBJECTS)
    assert set(MADE_OF) == {*method_names("film"), *method_names("mirror")}


def test_broken_laws_are_laws() -> None:
    for which, subjects in BROKEN.items():
        assert set(chain.from_iterable(subjects.values())) <= set(TABLES[which])


def test_truths_break_no_law() -> None:
    truths = [method for method in METHODS.values() if method.is_truth and method.domain in BROKEN]
    assert not any(BROKEN[method.domain][method.name] for method in truths)


def test_a_wrong_method_would_be_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The laws can fail: a colour that is made of the film's numbers keeps none of them."""
    import laws_film
    import numpy as np

    from gltf_iri.evaluation.film import Evaluation, Film

    def numbers_as_colour(method: str, film: Film, *, white: str = "D65") -> Evaluation:
        numbers = film.cos_theta_1 + film.film_ior + film.thickness_nm
        rgb = numbers[..., None] * np.array([1.0, 2.0, 3.0])
        return Evaluation(np.broadcast_to(rgb, (*film.shape, 3)), method, white)

    monkeypatch.setattr(laws_film, "evaluate", numbers_as_colour)
    kept = [name for name, law in FILM_LAWS.items() if law.departure("numbers") <= law.bound]
    assert kept == []


def test_notes_print_this_table() -> None:
    text = NOTES.read_text(encoding="utf-8")
    section = text.split("<!-- laws -->\n", 1)[1].split("<!-- /laws -->", 1)[0]
    assert section.strip() == markdown()
