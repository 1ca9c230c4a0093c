"""The layered surface of Granier & Heidrich against sums done another way."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from gltf_iri.optics.granier_heidrich import WAVELENGTHS_NM, inner_normal, layered_diffuse, layered_reflection

UP = np.array([0.0, 0.0, 1.0])


def direction(theta: float, phi: float = 0.0) -> np.ndarray:
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)])


@pytest.mark.parametrize("theta", [0.0, 0.4, 1.1, 1.5])
def test_parallel_boundaries_make_two_waves_interfere(theta: float) -> None:
    """|√R + √T e^{i2Φ}|² with Φ = 2π n d cos θ_t/λ: the same sum in complex numbers and angles."""
    n, d_nm = 1.45, 310.0
    rho = layered_reflection(
        direction(theta), direction(theta, math.pi), UP, UP, 1.0, [n, n, n], d_nm, 1.0, 1.0
    )
    inside = math.asin(math.sin(theta) / n)
    f = ((1.0 - n) / (1.0 + n)) ** 2
    F = f + (1.0 - f) * (1.0 - math.cos(theta)) ** 5
    T = (1.0 - F) * (1.0 - f) * (1.0 - (1.0 - math.cos(inside)) ** 5)
    for value, wavelength_nm in zip(rho, WAVELENGTHS_NM, strict=True):
        phase = 4.0 * math.pi * n * d_nm * math.cos(inside) / wavelength_nm
        assert value == pytest.approx(
            abs(math.sqrt(F) + math.sqrt(T) * cmath.exp(1j * phase)) ** 2, abs=1e-12
        )


def test_a_tilted_inner_boundary_sends_each_channel_elsewhere() -> None:
    """The prism: the view in which the inner lobe is 1 is Snell's twice and the tilted mirror's once."""
    tilt, n = 0.1, np.array([1.4, 1.45, 1.6])
    normal_1 = direction(tilt)
    light = direction(0.3, math.pi)  # comes from the left
    inside = np.arcsin(math.sin(0.3) / n)
    outward = np.arcsin(n * np.sin(inside + 2.0 * tilt))  # the mirror turns the ray by twice its tilt
    brightest = [
        layered_reflection(light, direction(float(angle)), UP, normal_1, 1.0, n, 0.0, 0.0, 1e6)[channel]
        for channel, angle in enumerate(outward)
    ]
    beside = [
        layered_reflection(light, direction(float(angle) + 0.02), UP, normal_1, 1.0, n, 0.0, 0.0, 1e6)[
            channel
        ]
        for channel, angle in enumerate(outward)
    ]
    outer_only = [
        layered_reflection(light, direction(0.3), UP, -UP, 1.0, n, 0.0, 0.0, 1e6)[c] for c in range(3)
    ]
    assert np.all(np.array(brightest) > np.array(outer_only) + 0.1)
    assert np.allclose(beside, outer_only, atol=1e-9)
    assert np.ptp(outward) > 0.04


def test_without_an_inner_reflection_only_the_outer_lobe_is_left() -> None:
    rho = layered_reflection(UP, UP, UP, -UP, 1.0, [1.5, 1.5, 1.5], 300.0, 20.0, 20.0)
    assert rho == pytest.approx([0.04] * 3, abs=1e-15)


def test_a_layer_that_lets_no_light_in_reflects_all_of_it() -> None:
    grazing = direction(1.4), direction(1.4, math.pi)
    rho = layered_reflection(*grazing, UP, UP, 1.5, [1.2, 1.3, 1.4], 300.0, 1.0, 1.0)
    assert rho == pytest.approx([1.0] * 3, abs=1e-12)


def test_the_diffuse_share_is_the_mean_of_the_fresnel_lobe() -> None:
    """R_d = 1 − T_d, Eq. 14, is 2∫ F(c) c dc: Schlick's reflectance averaged over the hemisphere."""
    n = 1.6
    f = ((1.0 - n) / (1.0 + n)) ** 2
    x, w = np.polynomial.legendre.leggauss(8)
    c = 0.5 * (x + 1.0)
    R_d = float((w * (f + (1.0 - f) * (1.0 - c) ** 5) * c).sum())
    largest = layered_diffuse(1.0, [n, n, n], 0.0)
    assert largest == pytest.approx([1.0 + 2.0 * math.sqrt(R_d * (1.0 - R_d))] * 3, rel=1e-12)


def test_the_inner_boundary_leans_to_where_the_layer_thickens() -> None:
    """Normals of z = −d(x, y) by finite differences."""
    slope_x, slope_y = 0.3, -0.2
    along_x, along_y = np.array([1.0, 0.0, -slope_x]), np.array([0.0, 1.0, -slope_y])
    normal = np.cross(along_x, along_y)
    got = inner_normal(UP, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], slope_x, slope_y)
    assert got == pytest.approx(normal / np.linalg.norm(normal), abs=1e-15)
