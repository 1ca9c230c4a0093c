"""Mitsuba 3 as an outside opinion: its spectral path tracer sees films in the colours of the CPU reference.

Mitsuba draws wavelengths, light and lobes at random, so the verdict is statistical: over all matched pixels
and channels of all scenes together, agreement is rejected wrongly for 1 % of all seeds. Seeds are fixed. The
same pictures must tell a film that is 2 % thicker.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from film_scenes import (
    MAP_HEIGHT,
    SCENES,
    VIEW,
    FilmScene,
    grey_radiance,
    matched_pixels,
    mitsuba_twin,
    our_picture,
)
from matrix_film import base_ior_of, film_reflectance
from mitsuba_scene import batches, environment_emitter, mitsuba_scene
from sidak import compare_means

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.spectral import film_spectrum

BATCHES = 64
THICKER = 1.02


def test_the_characteristic_matrix_gives_the_series_of_airy() -> None:
    wavelength_nm = np.linspace(360.0, 830.0, 200)
    for film_ior, base_ior in ((1.45, base_ior_of(0.6)), (2.0, 1.5), (1.33, 1.33)):
        for cosine in (0.05, 0.5, 1.0):
            ours = film_spectrum(Film.of(cosine, 420.0, film_ior, base_from_ior(base_ior)), wavelength_nm)[0]
            theirs = film_reflectance(film_ior, 420.0, base_ior, cosine, wavelength_nm, np.cos)
            np.testing.assert_allclose(theirs, ours, rtol=0.0, atol=1e-13)


def test_agreement_is_found_where_it_is_and_not_where_it_is_not() -> None:
    rng = np.random.default_rng(5)
    values = rng.normal(2.0, 0.1, (BATCHES, 500))
    nothing = np.zeros(500)
    assert compare_means(values, np.full(500, 2.0), nothing, 1).agrees
    one_is_off = np.full(500, 2.0)
    one_is_off[17] += 0.1
    assert not compare_means(values, one_is_off, nothing, 1).agrees


def test_mitsuba_sees_the_same_environment_through_the_same_pixels_in_the_same_white(
    mitsuba: ModuleType,
) -> None:
    sky = environment_emitter(mitsuba, grey_radiance, MAP_HEIGHT)
    scene = mitsuba_scene(mitsuba, None, {}, [sky], VIEW, 8)
    expected = np.repeat(grey_radiance(VIEW.directions())[..., None], 3, axis=-1)
    verdict = compare_means(batches(mitsuba, scene, BATCHES), expected, np.zeros_like(expected), 1)
    assert verdict.agrees, str(verdict)


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_mitsuba_sees_the_film_in_the_same_colours_and_tells_a_film_2_percent_thicker(
    scene: FilmScene,
    mitsuba: ModuleType,
    tmp_path: Path,
    record_property: Callable[[str, object], None],
) -> None:
    ours = our_picture(scene, tmp_path)
    thicker = our_picture(scene, tmp_path, thickness_nm=THICKER * scene.thickness_nm)
    theirs = batches(mitsuba, mitsuba_twin(mitsuba, scene, tmp_path), BATCHES)
    matched = matched_pixels(ours)
    verdict, power = (
        compare_means(
            theirs[:, matched],
            frame.rgba[matched][:, :3],
            frame.standard_error[matched],
            scene.reference_freedom,
            scenes=len(SCENES),
        )
        for frame in (ours, thicker)
    )
    off = np.abs(theirs[:, matched].mean(axis=(0, 1)) - ours.rgba[matched][:, :3].mean(axis=0))
    record_property(
        "measured",
        f"{scene.name}, Mitsuba against the CPU reference: {verdict}; mean colour {off.max():.1e} apart; "
        f"a film 2 % thicker: {power}",
    )
    assert verdict.agrees, str(verdict)
    assert not power.agrees, f"a film 2 % thicker passes: {power}"
