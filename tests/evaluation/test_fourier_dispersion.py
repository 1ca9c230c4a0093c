"""One index per channel: what stands for a channel, and what that costs with published media."""

from __future__ import annotations

import numpy as np

from gltf_iri.bench.media import FILM_MEDIA, METALS, N_BK7
from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.evaluation.dispersive import representative_wavelengths_nm


def test_what_is_linear_in_wavenumber_has_its_colour_at_the_representative_wavelengths() -> None:
    def linear(rows: np.ndarray, wavelength_nm: np.ndarray) -> np.ndarray:
        return np.broadcast_to(0.1 + 200.0 / wavelength_nm, (len(rows), wavelength_nm.shape[-1]))

    for white in ("D65", "E"):
        at_channels = 0.1 + 200.0 / np.array(representative_wavelengths_nm(white))
        assert np.abs(integrate_colour(linear, 1, white=white)[0] - at_channels).max() <= 1e-12


def test_published_media_are_what_their_sources_print() -> None:
    assert abs(N_BK7(np.array([587.56]))[0] - 1.5168) <= 1e-4  # Schott's n_d
    assert abs(FILM_MEDIA["SiO2"](np.array([587.6]))[0] - 1.45846) <= 1e-5  # Malitson, table I
    assert abs(FILM_MEDIA["TiO2"](np.array([589.3]))[0] - 2.612) <= 1e-2
    assert METALS["gold"](np.array([616.8]))[0] == 0.21 + 3.272j
