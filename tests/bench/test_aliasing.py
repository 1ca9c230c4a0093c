"""What is drawn with the spread of its thickness comes nearer to many samples a pixel than its mean does."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.bench.aliasing import WAYS, measure_aliasing
from gltf_iri.bench.aliasing_sheet import aliasing_sheet
from gltf_iri.bench.fine_film import THICKEST_NM, fine_film

ONE_TEXEL, MEAN, SPREAD = WAYS


@pytest.fixture(scope="module")
def _kept():
    return []


@pytest.fixture
def measured(gl_context, _kept):
    """Drawn once for all tests."""
    if not _kept:
        _kept.append(measure_aliasing(gl_context, sizes={16: 16, 64: 8}, texture_rows=256))
    return _kept[0]


@pytest.mark.parametrize("pixels", [16, 64])
def test_the_spread_brings_a_small_picture_near_the_supersampled_one(measured, pixels):
    of = {row.way: row for row in measured.rows if row.pixels == pixels}
    for before in (ONE_TEXEL, MEAN):
        assert of[SPREAD].delta_e_mean < of[before].delta_e_mean / 3
        assert of[SPREAD].delta_e_p95 < of[before].delta_e_p95 / 3
        assert of[SPREAD].max_abs < of[before].max_abs


def test_the_reference_has_all_the_light_of_the_pictures(measured):
    for size, reference in measured.references.items():
        assert reference.shape == (size, size, 3)
        np.testing.assert_array_equal(reference[0, 0], measured.pictures[size][SPREAD][0, 0])  # the sky


def test_the_sheet_shows_every_picture(measured):
    sheet = aliasing_sheet(measured)
    assert sheet.dtype == np.uint8
    assert len(np.unique(sheet.reshape(-1, 3), axis=0)) > 500


def test_the_film_reaches_from_none_to_the_thickest_and_spares_no_scale():
    with fine_film(64) as model:
        film = model.materials[0].iridescence
        texels = model.document.image(0).pixels[..., 1].astype(float)
    assert film.thickness_max_nm == pytest.approx(THICKEST_NM)
    assert texels.min() < 10
    assert texels.max() > 245
    halves = texels.reshape(32, 2, 64, 2).mean(axis=(1, 3))
    assert np.std(texels) > np.std(halves) > 0.5 * np.std(texels)
