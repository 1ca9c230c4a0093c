"""Films: what the cases cannot show one by one."""

from __future__ import annotations

import itertools
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.fourier import evaluate_fourier
from gltf_iri.evaluation.incoherent import evaluate_incoherent
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.validation.iridescence import images as iridescence_images
from gltf_iri.validation.iridescence.effect import COHERENCE_NM
from gltf_iri.validation.iridescence.film import Base
from gltf_iri.validation.optics import banding
from gltf_iri.validation.optics.film_colours import COSINES, film_colours

NAME = "KHR_materials_iridescence"
NUMBERS = (
    "iridescenceFactor",
    "iridescenceIor",
    "iridescenceThicknessMinimum",
    "iridescenceThicknessMaximum",
)
CASES = Path(__file__).with_name("cases") / "iridescence"
PLAIN = {"baseColorFactor": [0.2, 0.2, 0.2, 1.0], "metallicFactor": 0.0}


def worn(film: dict[str, Any], **others: Any) -> dict[str, Any]:
    """Return a file with one film; `others` are more extensions of its material."""
    material = {"pbrMetallicRoughness": PLAIN, "extensions": {NAME: film, **others}}
    return {"extensionsUsed": [NAME, *others], "materials": [material]}


@pytest.mark.parametrize("key", NUMBERS)
@pytest.mark.parametrize("value", [-1.0, "1", None, True, [], float("nan"), float("inf")])
def test_of_a_film_with_a_broken_number_only_that_is_told(codes: Any, key: str, value: Any) -> None:
    told = codes(
        worn({"iridescenceFactor": 1.0, "iridescenceThicknessMaximum": 0.0, key: value}), raises=True
    )
    assert {code for code, _ in told if code.startswith("IRI_IRIDESCENCE")} == set()
    assert told


@pytest.mark.parametrize("optics", [False, True])
def test_no_number_is_too_great_for_the_rules(codes: Any, optics: bool) -> None:
    extremes = (0, 5e-324, 1e-3, 2**60, 1e308, 10**400)
    iors = (1, 1 + 1e-12, *extremes[3:])
    for ior, least, most in itertools.product(iors[:4:3] if optics else iors, extremes, extremes):
        film = {
            "iridescenceFactor": 1,
            "iridescenceIor": ior,
            "iridescenceThicknessMinimum": least,
            "iridescenceThicknessMaximum": most,
            "iridescenceThicknessTexture": {},
        }
        others = {
            "KHR_materials_ior": {"ior": ior},
            "KHR_materials_specular": {"specularColorFactor": [most, 0, 1]},
            "KHR_materials_clearcoat": {"clearcoatFactor": 1},
        }
        assert codes(worn(film, **others), raises=True, optics=optics and least == most)


def test_a_file_without_the_extension_is_not_looked_at_for_films(codes: Any) -> None:
    undeclared = worn({"iridescenceFactor": 0.0, "iridescenceIor": 1.0})
    del undeclared["extensionsUsed"]
    assert not any(code.startswith("IRI_IRIDESCENCE") for code, _ in codes(undeclared))


def test_an_unknown_property_of_the_base_does_not_hide_it(codes: Any) -> None:
    asset = worn({"iridescenceFactor": 1.0, "iridescenceIor": 1.5})
    asset["materials"][0]["pbrMetallicRoughness"] = {**PLAIN, "gloss": 3, "extras": {}}
    assert ("IRI_IRIDESCENCE_FILM_IS_BASE", f"/materials/0/extensions/{NAME}/iridescenceIor") in codes(asset)


def test_a_broken_base_is_not_judged(codes: Any) -> None:
    asset = worn({"iridescenceFactor": 1.0, "iridescenceIor": 1.5})
    asset["materials"][0]["pbrMetallicRoughness"] = {**PLAIN, "metallicFactor": 2.0}
    assert not any(code.startswith("IRI_IRIDESCENCE") for code, _ in codes(asset))


def test_numpy_stays_away_where_no_step_can_be_seen() -> None:
    script = (
        "import sys; from gltf_iri.validation.validate import validate\n"
        "validate(sys.argv[1]); print('numpy' in sys.modules)"
    )
    case = CASES / "thickness_in_8_bits_over_a_narrow_range.gltf"
    done = subprocess.run([sys.executable, "-c", script, case], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_the_steps_of_a_file_are_measured_once_and_not_without_end(
    codes: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    measured = []
    monkeypatch.setattr(banding, "largest_step", lambda film, levels: measured.append(film) or 2.0)
    monkeypatch.setattr(iridescence_images, "_MOST_MEASURED", 3)
    films = [
        {
            "iridescenceFactor": 1.0,
            "iridescenceThicknessMaximum": nm,
            "iridescenceThicknessTexture": {"index": 0},
        }
        for nm in (900.0, 900.0, 1000.0, 1100.0, 1200.0, 1300.0)
    ]
    asset = {
        "extensionsUsed": [NAME],
        "materials": [{"pbrMetallicRoughness": PLAIN, "extensions": {NAME: film}} for film in films],
        "textures": [{"source": 0}],
        "images": [{"uri": "ramp8.png"}],
    }
    told = [
        code
        for code, _ in codes(asset, folder=CASES, raises=True)
        if code == "IRI_IRIDESCENCE_THICKNESS_BANDING"
    ]
    assert (len(measured), len(told)) == (3, 4)


def random_films(count: int, seed: int) -> list[tuple[float, np.ndarray]]:
    """Return (index, base F0), grey and coloured in turn."""
    g = np.random.default_rng(seed)
    return [
        (g.uniform(1.05, 4.0), np.repeat(g.uniform(0, 0.98), 3) if k % 2 else g.uniform(0, 0.98, 3))
        for k in range(count)
    ]


def straight_on(ior: float, f0: np.ndarray, opd_nm: np.ndarray) -> Film:
    return Film.of(1.0, opd_nm / (2.0 * ior), ior, base_from_f0(f0))


def test_beyond_the_coherence_the_film_is_its_mean() -> None:
    opd_nm = np.arange(COHERENCE_NM, 20_000.0, 25.0)
    before_nm = np.arange(5000.0, COHERENCE_NM, 25.0)
    worst_before = 0.0
    for ior, f0 in random_films(60, 3):
        for nm in (opd_nm, before_nm):
            film = straight_on(ior, f0, nm)
            rgb = evaluate_fourier(film, "D65").rgb
            worst = float(delta_e_2000(rgb, evaluate_incoherent(film, "D65").rgb).max())
            if nm is opd_nm:
                assert worst < 1.0
            worst_before = max(worst_before, worst)
    assert worst_before > 1.0  # and the bound is no wider than it has to be


def test_no_film_changes_faster_than_its_steps_are_taken_for() -> None:
    opd_nm = np.arange(0.0, 4000.0, 2.0)
    for darkness, bound in (
        (1.0, iridescence_images._STEEPEST_PER_NM),
        (iridescence_images._DARK_F0, iridescence_images._STEEPEST_ON_DARK_PER_NM),
    ):
        steepest = 0.0
        for ior, f0 in random_films(60, 4):
            rgb = evaluate_fourier(straight_on(ior, darkness * f0, opd_nm), "D65").rgb
            steepest = max(steepest, float(delta_e_2000(rgb[1:], rgb[:-1]).max()) / 2.0)
        assert bound / 3.0 < steepest < bound


@pytest.mark.parametrize(
    ("method", "named"), [("truth", "spectral"), ("letter", "khr"), ("mean", "incoherent")]
)
def test_colours_are_those_of_the_methods_of_their_names(method: str, named: str) -> None:
    f0 = (0.3, 0.04, 0.8)
    nm = np.array([50.0, 420.0, 900.0])
    film = Film.of(COSINES[:, None], nm, 1.7, base_from_f0(f0))
    here = film_colours(Base("a metal", f0, "", is_known=True), nm, 1.7, method=method)
    assert float(delta_e_2000(here, evaluate(named, film, backend="numpy").rgb).max()) < 0.02


def test_cutting_f0_changes_nothing_below_the_cut() -> None:
    base = Base("a metal", (0.9, 0.5, 0.1), "", is_known=True)
    assert np.array_equal(*(film_colours(base, 300.0, 1.4, method=method) for method in ("letter", "cut")))


def test_a_base_with_a_texture_is_measured_at_half_its_colour() -> None:
    textured = Base("a metal", (0.8, 0.6, 0.4), "", is_known=False)
    half = Base("a metal", (0.4, 0.3, 0.2), "", is_known=True)
    assert np.array_equal(film_colours(textured, 300.0, 1.4), film_colours(half, 300.0, 1.4))


def test_the_largest_step_is_the_one_between_two_neighbours(codes: Any) -> None:
    film = straight_on(1.5, np.array([0.5, 0.5, 0.5]), 3.0 * np.linspace(200.0, 900.0, 256))
    rgb = evaluate("spectral", film).rgb

    class Film256:
        minimum_nm, maximum_nm, ior = 200.0, 900.0, 1.5
        bases = (Base("a metal", (0.5, 0.5, 0.5), "", is_known=True),)

    expected = float(delta_e_2000(rgb[1:], rgb[:-1]).max())
    assert banding.largest_step(Film256, 256) == pytest.approx(expected, abs=0.02)  # type: ignore[arg-type]
