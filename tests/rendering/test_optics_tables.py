"""Tables of the GLSL twins: every name is known, and every table is what its shader takes it for."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.optics_tables import (
    OPTICS_TABLES,
    SENSITIVITY_FINE_END_NM,
    SENSITIVITY_FINE_PER_NM,
    SENSITIVITY_LAST,
    SENSITIVITY_MAX,
    SENSITIVITY_SLOPE_BITS,
    SENSITIVITY_SLOPE_MAX,
    OpticsTableStore,
    optics_table,
    table_texture,
)


def test_every_table_of_a_method_is_filled_and_every_filled_one_used() -> None:
    read = {name for method in METHODS.values() for name in (*method.glsl_tables, *method.glsl_spread_tables)}
    assert read == set(OPTICS_TABLES)


@pytest.mark.parametrize("name", OPTICS_TABLES)
def test_a_table_is_finite_and_of_at_most_four_channels(name: str) -> None:
    table = optics_table(name, "D65", {})
    assert table.dtype in (np.float32, np.uint32)
    assert table.ndim == 3
    assert table.shape[2] <= 4
    assert np.isfinite(table).all()


def test_wavenumbers_keep_forty_bits_in_two_parts_of_which_the_first_has_twelve() -> None:
    table = optics_table("spectral_rule", "E", {})
    leading, rest = table[0, :, 0], table[0, :, 1]
    exact = 1.0 / colour_rule(table.shape[1] - 1, "E").wavelength_nm
    assert (np.abs(leading.astype(np.float64) + rest - exact) <= 2.0**-35 * exact).all()
    assert (leading.view(np.uint32) & 0xFFF == 0).all()
    np.testing.assert_allclose(table[1:, :, :3].sum(axis=1), 1.0, rtol=0, atol=2e-6)


@pytest.mark.parametrize("white", ["D65", "E"])
def test_a_texels_lines_are_the_cubics_as_far_as_half_way_to_the_next(white: White) -> None:
    texels = optics_table("film_sensitivity", white, {"tolerance": 1e-4}).reshape(2, -1, 4)
    assert not texels[:, SENSITIVITY_LAST:].any()
    g = np.random.default_rng(7)
    near_the_end_of_the_fine = np.linspace(-2.0, 2.0, 41)
    opd_nm = np.concatenate(
        [g.uniform(0.0, 1.0, 20_000) ** 3 * END_NM, SENSITIVITY_FINE_END_NM + near_the_end_of_the_fine]
    )
    coarse = opd_nm + (SENSITIVITY_FINE_PER_NM - 1) * SENSITIVITY_FINE_END_NM
    at = np.minimum(SENSITIVITY_FINE_PER_NM * opd_nm, coarse)
    nearest = np.floor(at + 0.5)
    words = texels[:, nearest.astype(int)]
    # What sensitivity_line of shaders/optics/film_sensitivity.glsl makes of them.
    value, slope = (
        words[..., :3].view(np.int32),
        (words[..., :3] << (32 - SENSITIVITY_SLOPE_BITS)).view(np.int32),
    )
    line = 2.0**-31 * (
        SENSITIVITY_MAX * value + (SENSITIVITY_SLOPE_MAX * (at - nearest))[:, None] * slope.astype(np.float64)
    )
    table = sensitivity_table(white)
    np.testing.assert_allclose(line[0] + 1j * line[1], table.at(opd_nm), rtol=0, atol=3e-6)
    bound = np.ascontiguousarray(words[0, :, 3]).view(np.float32)
    np.testing.assert_allclose(0.5e-4 * bound, table.bound(opd_nm), rtol=2e-3, atol=1e-5)


def test_a_store_makes_each_table_once_for_each_white(gl_context: moderngl.Context) -> None:
    store = OpticsTableStore(gl_context)
    made = store.textures(("spectral_rule",), "D65", {})["spectral_rule"]
    assert store.textures(("spectral_rule",), "D65", {})["spectral_rule"] is made
    other = store.textures(("spectral_rule",), "E", {})["spectral_rule"]
    assert made.read() != other.read()
    store.release()


def test_a_table_too_large_is_told(gl_context: moderngl.Context) -> None:
    columns = gl_context.info["GL_MAX_TEXTURE_SIZE"] + 1
    with pytest.raises(MissingCapabilityError, match=str(columns)):
        table_texture(gl_context, np.zeros((1, columns, 1), dtype=np.float32))


def test_an_unknown_table_names_those_that_there_are() -> None:
    with pytest.raises(UsageError, match="spectral_rule"):
        optics_table("spectral_ruler", "D65", {})
