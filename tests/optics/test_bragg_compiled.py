"""Compiled mirrors are numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.bragg import bragg_reflectance

pytest.importorskip("numba")

COUNT = 2000


@pytest.mark.parametrize(("cells", "bound"), [(1, 1e-13), (2, 1e-13), (3, 1e-13), (10, 1e-13), (200, 1e-11)])
def test_both_backends_agree(cells: int, bound: float) -> None:
    """To 1e-13 at ten cells; beyond, phases grow with the cells and their roundings with them."""
    g = np.random.default_rng(10)
    d1_nm, d2_nm = g.uniform(20.0, 500.0, (2, COUNT, 1))
    cosine, wavelength_nm = g.uniform(0.1, 1.0, (COUNT, 1)), g.uniform(380.0, 780.0, 5)
    for host, n1, n2 in ((1.0, 1.0, g.uniform(1.3, 2.2, (COUNT, 1))), (1.0, 1.59, 1.67), (1.3, 1.6, 1.4)):
        numpy, numba = (
            bragg_reflectance(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine, backend=backend)
            for backend in ("numpy", "numba")
        )
        assert np.abs(numpy - numba).max() <= bound


def test_rows_of_every_kind_go_together() -> None:
    """Some absorb, which are numpy's on either; others reflect totally in n1 or n2; all differ in cells."""
    g = np.random.default_rng(11)
    host, n1, n2 = g.uniform(1.0, 2.5, (3, COUNT))
    absorbing = n2 + 1j * np.where(np.arange(COUNT) % 3 == 0, 0.1, 0.0)
    cells = g.integers(1, 12, COUNT)
    numpy, numba = (
        bragg_reflectance(host, n1, absorbing, 90.0, 120.0, cells, 500.0, g_cosine, backend=backend)
        for g_cosine in (np.linspace(0.1, 1.0, COUNT),)
        for backend in ("numpy", "numba")
    )
    assert np.abs(numpy - numba).max() <= 1e-12
