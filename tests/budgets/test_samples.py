"""The points at which errors are measured fill what a film meets."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.budgets.samples import points_of
from gltf_iri.planning.reach import Reach, Span

POINT = Span.at
GREY = (POINT(0.04),) * 3
METAL = POINT(1.0)


def reach(metallic: Span = METAL, *, is_grey: bool = False) -> Reach:
    base = (Span(0.2, 0.9), Span(0.1, 0.5), POINT(0.3))
    return Reach(1.4, POINT(1.0), Span(100, 700), metallic, Span(0.2, 0.8), base, GREY, True, is_grey)


def test_points_lie_in_their_spans_and_reach_both_ends() -> None:
    points = points_of(reach(), "metal", 1024, from_all_around=True)
    columns = {
        (0.0, 1.0): points.cos_theta,
        (100.0, 700.0): points.thickness_nm,
        (0.2, 0.9): points.base_f0[:, 0],
        (0.1, 0.5): points.base_f0[:, 1],
        (0.2, 0.8): points.roughness,
    }
    for (low, high), column in columns.items():
        assert low <= column.min() < low + 0.01 * (high - low)
        assert high - 0.01 * (high - low) < column.max() <= high
    assert np.all(points.base_f0[:, 2] == 0.3)


def test_points_are_spread_more_evenly_than_random_ones() -> None:
    points = points_of(reach(), "metal", 1024)
    share = np.column_stack([points.cos_theta, (points.thickness_nm - 100.0) / 600.0])
    boxes = np.histogram2d(*share.T, bins=8)[0]
    assert boxes.std() < 0.5 * np.sqrt(boxes.mean())


def test_fewer_points_begin_more_of_them() -> None:
    few, many = (points_of(reach(), "metal", count) for count in (64, 256))
    assert np.array_equal(few.thickness_nm, many.thickness_nm[:64])
    later = points_of(reach(), "metal", 64, first=192)
    assert np.allclose(later.base_f0, many.base_f0[192:])


def test_channels_of_grey_bases_are_equal() -> None:
    assert np.ptp(points_of(reach(is_grey=True), "metal", 64).base_f0, axis=1).max() == 0.0
    assert np.ptp(points_of(reach(), "metal", 64).base_f0, axis=1).min() > 0.0


@pytest.mark.parametrize(
    ("metallic", "lobes"),
    [
        (POINT(0.0), ("dielectric",)),
        (POINT(1.0), ("metal",)),
        (Span(0.0, 1.0), ("dielectric", "metal")),
        (POINT(0.5), ("dielectric", "metal")),
    ],
)
def test_lobes_without_weight_are_not_measured(metallic: Span, lobes: tuple[str, ...]) -> None:
    assert reach(metallic).lobes == lobes


def test_white_facets_stay_white() -> None:
    points = points_of(reach(), "metal", 64, from_all_around=True)
    assert points.facets is not None
    colours = np.ones((*points.facets.cosines.shape, 3))
    assert np.allclose(points.mean(colours), 1.0)
