"""`naive-rgb` is the exact film at three wavelengths, and nothing else."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from tmm import unpolarized_RT

from gltf_iri.colour.quadrature import colour_density
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_dispersion, base_from_f0, base_from_ior
from gltf_iri.evaluation.naive_rgb import CHANNEL_NM
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS


def test_wavelengths_are_where_the_channels_weigh_most() -> None:
    wavelength_nm = np.arange(360.0, 830.0, 0.5)
    peaks = wavelength_nm[colour_density(wavelength_nm, "D65").argmax(axis=0)]
    assert tuple(peaks) == CHANNEL_NM
    assert tuple(parameter.default for parameter in METHODS["naive-rgb"].parameters) == CHANNEL_NM


@pytest.mark.parametrize("base", [1.5, 0.2 + 3.4j])
def test_each_channel_is_tmm_at_its_wavelength(base: complex) -> None:
    rgb = evaluate("naive-rgb", Film.of([0.3, 1.0], 420.0, 1.33, base_from_ior(base))).rgb
    for row, cosine in zip(rgb, (0.3, 1.0), strict=True):
        theirs = [
            unpolarized_RT([1.0, 1.33, base], [np.inf, 420.0, np.inf], np.arccos(cosine), nm)["R"]
            for nm in CHANNEL_NM
        ]
        assert row == pytest.approx(theirs, abs=1e-12)


def test_other_wavelengths_may_be_chosen() -> None:
    film = Film.of(0.7, 420.0, 1.33, base_from_ior(1.8))
    chosen = {"red_nm": CHANNEL_NM[2], "green_nm": CHANNEL_NM[2], "blue_nm": CHANNEL_NM[2]}
    assert np.ptp(evaluate("naive-rgb", film, parameters=chosen).rgb) == 0.0
    assert evaluate("naive-rgb", film, parameters=chosen).rgb[0] == evaluate("naive-rgb", film).rgb[2]
    with pytest.raises(UsageError, match="red_nm"):
        evaluate("naive-rgb", film, parameters={"red_nm": 200.0})


def test_dispersive_media_have_each_channels_index() -> None:
    def glass(nm: np.ndarray) -> np.ndarray:
        return 1.5 + 4000.0 / nm**2

    def metal(nm: np.ndarray) -> np.ndarray:
        return 0.2 + 1j * nm / 150.0

    rgb = evaluate("naive-rgb", Film.of(0.6, 300.0, glass, base_from_dispersion(metal))).rgb
    for channel, nm in enumerate(np.array(CHANNEL_NM)):
        single = Film.of(0.6, 300.0, float(glass(nm)), base_from_ior(complex(metal(nm))))
        assert rgb[channel] == pytest.approx(evaluate("naive-rgb", single).rgb[channel], abs=1e-14)


@pytest.mark.parametrize("base", [base_from_f0([0.0, 0.5, 1.0]), base_from_ior(3j), base_from_ior(1e-6)])
def test_every_film_has_a_colour_within_0_and_1(base: object) -> None:
    for outside_ior, film_ior, thickness_nm in itertools.product(
        (1.0, 1e-6, 1e6), (1.0, 1.3, 1e6), (0, 5e-324, 1e12)
    ):
        film = Film.of([0.0, 5e-324, 1e-8, 0.5, 1.0], thickness_nm, film_ior, base, outside_ior)
        rgb = evaluate("naive-rgb", film).rgb
        assert np.all((rgb >= 0.0) & (rgb <= 1.0))
