"""The samples of mirrors hold the numbers that their READMEs state, and fall back to their colours."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.samples import dichroic_mirror, jewel_beetle, morpho, opal
from gltf_iri.samples.collection import build_samples
from gltf_iri.samples.domains import nearest_points, scrambled

VISIBLE_NM = np.arange(380.0, 781.0)
ROUNDED = 6e-4  # the modules hold three decimals


def face_on(
    host: float, ior_1: float, ior_2: float, period_nm: float | np.ndarray, fill: float, cells: int
) -> np.ndarray:
    """Return what a mirror reflects at normal incidence, linear Rec.709, (..., 3)."""
    first, second = fill * period_nm, (1.0 - fill) * period_nm
    return evaluate("yeh-spectral", Mirror.of(1.0, ior_1, ior_2, first, second, cells, host)).rgb


def spectrum(ior_1: float, ior_2: float, period_nm: float, fill: float, cells: int) -> np.ndarray:
    """Return the reflectance in air at `VISIBLE_NM`, face on."""
    first, second = fill * period_nm, (1.0 - fill) * period_nm
    return bragg_reflectance(1.0, ior_1, ior_2, first, second, cells, VISIBLE_NM, 1.0)


@pytest.mark.parametrize("area", jewel_beetle.AREAS)
def test_the_beetle_keeps_its_colours_face_on_without_the_extension(area: str) -> None:
    seen = face_on(1.0, *jewel_beetle.AREAS[area])
    np.testing.assert_allclose(jewel_beetle.FALLBACK_F0[area], np.maximum(seen, 0.0), atol=ROUNDED)


@pytest.mark.parametrize(("area", "peak_nm"), [("green", 521.0), ("purple", 672.0)])
def test_the_beetles_bands_lie_where_its_readme_says(area: str, peak_nm: float) -> None:
    assert VISIBLE_NM[spectrum(*jewel_beetle.AREAS[area]).argmax()] == peak_nm


def test_the_beetles_films_in_the_other_order_give_no_band() -> None:
    ior_1, ior_2, period_nm, fill, cells = jewel_beetle.AREAS["green"]
    stated = spectrum(ior_1, ior_2, period_nm, fill, cells)
    assert stated.max() == pytest.approx(0.33, abs=0.005)
    assert spectrum(ior_2, ior_1, period_nm, 1.0 - fill, cells).max() < 0.13


def test_the_morpho_keeps_its_blue_without_the_extension() -> None:
    layer = morpho.SHELVES
    seen = face_on(1.0, 1.0, layer["ior2"], layer["periodMaximum"], layer["fill"], layer["cells"])
    np.testing.assert_allclose(morpho.FALLBACK_F0, np.clip(seen, 0.0, 1.0), atol=ROUNDED)


def test_the_glasses_show_half_their_colour_without_the_extension() -> None:
    for glass, scale in dichroic_mirror.GLASSES.items():
        layer = dichroic_mirror.mirror(scale)
        host = dichroic_mirror.HOST_IOR
        seen = face_on(host, host, layer["ior2"], layer["periodMaximum"], layer["fill"], layer["cells"])
        np.testing.assert_allclose(
            dichroic_mirror.FALLBACK_F0[glass], np.clip(seen, 0.0, 1.0) / 2.0, atol=ROUNDED
        )


def test_the_middle_glass_is_of_quarter_waves() -> None:
    silica_nm, titania_nm = dichroic_mirror.QUARTER_NM
    assert 4.0 * dichroic_mirror.HOST_IOR * silica_nm == pytest.approx(550.0, abs=0.5)
    assert 4.0 * dichroic_mirror.FILM_IOR * titania_nm == pytest.approx(550.0, abs=0.5)


def test_the_opals_domains_keep_their_colours_face_on_without_the_extension() -> None:
    layer, host = opal.LAYER, opal.HOST_IOR
    share = np.array(opal.LEVELS) / 255.0
    period_nm = (1.0 - share) * layer["periodMinimum"] + share * layer["periodMaximum"]
    seen = face_on(host, host, layer["ior2"], period_nm, layer["fill"], layer["cells"])
    np.testing.assert_allclose(opal.FALLBACK_F0, np.maximum(seen, 0.0), atol=ROUNDED)


def test_each_sample_of_layers_says_what_is_seen_without_them() -> None:
    for sample in build_samples():
        has_layers = b"EXT_materials_bragg" in next(iter(sample.files.values()))
        assert has_layers == ("## Without the extension" in sample.readme), sample.name


def test_scrambled_numbers_are_the_same_on_every_machine_and_spread() -> None:
    assert [scrambled(i) for i in range(3)] == [0x71AC59E3, 0x97615F7F, 0xD6F828DA]
    bits = np.array([[scrambled(i) >> b & 1 for b in range(32)] for i in range(2000)])
    np.testing.assert_allclose(bits.mean(axis=0), 0.5, atol=0.06)


def test_every_texel_lies_in_the_domain_whose_point_is_nearest() -> None:
    side, count = 24, 9
    domains = nearest_points(side, count)
    points = [(scrambled(2 * i) % side, scrambled(2 * i + 1) % side) for i in range(count)]
    for row, column in np.ndindex(side, side):
        distances = [np.hypot(row - y, column - x) for y, x in points]
        assert distances[domains[row, column]] == min(distances)
