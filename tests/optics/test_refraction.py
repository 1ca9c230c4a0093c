"""Snell's law: which of two roots is the wave that goes on."""

from __future__ import annotations

import pytest

from gltf_iri.optics.refraction import normal_index


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_a_wave_beyond_total_reflection_fades_away_from_the_interface(zero: float) -> None:
    assert normal_index(complex(-4.0, zero)) == 2j
