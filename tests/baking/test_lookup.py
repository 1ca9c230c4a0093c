"""Tables give what OpenGL's filter gives, compiled or not."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import axis_coordinate, axis_values, look_up
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.reach import Span

COS = TableAxis("cos_theta", Span(0.0, 1.0), 5)
NM = TableAxis("thickness_nm", Span(100.0, 700.0), 4)
BASE = TableAxis("base_f0", Span(0.04, 1.0), 3)
ROUGH = TableAxis("roughness", Span(0.0, 0.8), 2)
SPREAD = TableAxis("spread_nm", Span(0.0, 60.0), 3)
ALL_AXES = [(COS,), (COS, NM), (COS, BASE), (COS, NM, BASE), (COS, BASE, SPREAD), (COS, NM, BASE, ROUGH)]
ALL_AXES += [(COS, NM, ROUGH, SPREAD), (COS, NM, ROUGH, TableAxis("spread_nm", Span(0.0, 0.0), 1))]


def baked_of(axes: tuple[TableAxis, ...], texel: str = "f4") -> BakedTable:
    table = FilmTable("metal", 1.3, 400.0, (0.5, 0.5, 0.5), axes, texel, 0.0)
    texels = np.random.default_rng(1).uniform(size=(*table.shape, 3)).astype(texel)
    return BakedTable(table, texels, "D65", 0.0, is_cached=False)


def points(count: int) -> tuple[tuple, dict]:
    g = np.random.default_rng(2)
    positional = g.uniform(-0.1, 1.1, count), g.uniform(50.0, 800.0, count), g.uniform(0.0, 1.0, (count, 3))
    return positional, {"roughness": g.uniform(0.0, 1.0, count), "spread_nm": g.uniform(0.0, 70.0, count)}


@pytest.mark.parametrize("axes", ALL_AXES, ids=lambda axes: "-".join(a.quantity for a in axes))
def test_both_backends_give_the_same(axes: tuple[TableAxis, ...]) -> None:
    pytest.importorskip("numba")
    for texel in ("f2", "f4"):
        baked = baked_of(axes, texel)
        where, more = points(5000)
        by_numpy = look_up(baked, *where, **more, backend="numpy")
        by_numba = look_up(baked, *where, **more, backend="numba")
        np.testing.assert_allclose(by_numba, by_numpy, rtol=0, atol=1e-13)


@pytest.mark.parametrize("axes", ALL_AXES, ids=lambda axes: "-".join(a.quantity for a in axes))
def test_a_look_up_is_linear_along_each_axis_in_turn(axes: tuple[TableAxis, ...]) -> None:
    baked = baked_of(axes)
    (cosine, thickness, base), more = points(300)
    given = {"cos_theta": cosine, "thickness_nm": thickness, **more}
    found = look_up(baked, cosine, thickness, base, **more)
    for i, c in product(range(0, 300, 10), range(3)):
        texels = baked.texels[..., c].astype(np.float64)
        for axis in axes:
            value = base[i, c] if axis.quantity == "base_f0" else given[axis.quantity][i]
            places = np.linspace(0.0, 1.0, axis.nodes)
            t = axis_coordinate(axis, np.asarray(value))
            texels = np.apply_along_axis(lambda line, t=t, at=places: np.interp(t, at, line), 0, texels)
        assert found[i, c] == pytest.approx(texels, rel=0, abs=1e-13)


@pytest.mark.parametrize("axis", [COS, NM, BASE, ROUGH, SPREAD], ids=lambda axis: axis.quantity)
def test_texel_centres_stand_for_the_axis_values(axis: TableAxis) -> None:
    values = axis_values(axis)
    np.testing.assert_allclose(axis_coordinate(axis, values), np.linspace(0.0, 1.0, axis.nodes), atol=1e-15)
    assert (values[0], values[-1]) == (axis.span.low, axis.span.high)


@pytest.mark.parametrize("backend", ["numpy", "numba"])
def test_what_is_not_a_number_stays_one_and_touches_no_other(backend: str) -> None:
    if backend == "numba":
        pytest.importorskip("numba")
    baked = baked_of((COS, NM, BASE))
    cosine = np.array([0.3, np.nan, 0.3])
    base = np.array([[0.2, 0.3, 0.4], [0.2, 0.3, 0.4], [0.2, np.nan, 0.4]])
    rgb = look_up(baked, cosine, 400.0, base, backend=backend)
    assert np.isnan(rgb).tolist() == [[False] * 3, [True] * 3, [False, True, False]]


def test_shapes_broadcast_and_may_be_empty() -> None:
    baked = baked_of((COS, NM))
    assert look_up(baked, np.zeros((4, 1)), np.zeros(5), np.zeros(3)).shape == (4, 5, 3)
    assert look_up(baked, np.zeros(0), 400.0, np.zeros(3)).shape == (0, 3)


@pytest.mark.parametrize("backend", ["numpy", "numba"])
def test_a_base_below_0_is_read_as_the_darkest(backend: str) -> None:
    if backend == "numba":
        pytest.importorskip("numba")
    baked = baked_of((COS, BASE))
    below, darkest = (look_up(baked, 0.3, 400.0, np.full(3, f0), backend=backend) for f0 in (-0.01, 0.04))
    np.testing.assert_allclose(below, darkest, rtol=0, atol=1e-13)
