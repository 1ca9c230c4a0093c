"""Tables of the GLSL twins: every name is known, and every table is what its shader takes it for."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.sensitivity_table import sensitivity_table
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.optics_tables import (
    OPTICS_TABLES,
    SENSITIVITY_FINE_END_NM,
    SENSITIVITY_FINE_PER_NM,
    SENSITIVITY_LAST,
    SENSITIVITY_ROW,
    SENSITIVITY_ROWS,
    OpticsTableStore,
    optics_table,
    table_texture,
)


def test_every_table_of_a_method_is_filled_and_every_filled_one_used() -> None:
    assert {name for method in METHODS.values() for name in method.glsl_tables} == set(OPTICS_TABLES)


@pytest.mark.parametrize("name", OPTICS_TABLES)
def test_a_table_is_finite_float32_of_at_most_four_channels(name: str) -> None:
    table = optics_table(name, "D65", {})
    assert table.dtype == np.float32
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


def test_sensitivities_between_texels_are_those_of_the_cubics() -> None:
    texels = optics_table("film_sensitivity", "D65", {"tolerance": 1e-4}).astype(np.float64)
    real, imaginary = texels[:SENSITIVITY_ROWS], texels[SENSITIVITY_ROWS:]
    np.testing.assert_array_equal(real[:-1, -1], real[1:, 0])
    g = np.random.default_rng(7)
    i = g.integers(0, SENSITIVITY_LAST, 5000)
    fine = SENSITIVITY_FINE_PER_NM * SENSITIVITY_FINE_END_NM
    opd_nm = np.where(i < fine, (i + 0.5) / SENSITIVITY_FINE_PER_NM, i + 0.5 - fine + SENSITIVITY_FINE_END_NM)
    row, column = np.divmod(i, SENSITIVITY_ROW)
    table = sensitivity_table("D65")
    for rows, expected in ((real, table.at(opd_nm).real), (imaginary, table.at(opd_nm).imag)):
        between = 0.5 * (rows[row, column] + rows[row, column + 1])
        np.testing.assert_allclose(between[:, :3], expected, rtol=0, atol=2e-6)
    bound = 0.5 * (real[row, column] + real[row, column + 1])[:, 3]
    np.testing.assert_allclose(0.5e-4 * bound, table.bound(opd_nm), rtol=0, atol=1e-6)
    assert not texels.reshape(2, -1, 4)[:, SENSITIVITY_LAST + SENSITIVITY_ROWS :].any()


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
