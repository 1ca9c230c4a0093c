"""Timed twins are those that were asked for, and what is drawn is the function on the subject's rows."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from gltf_iri.bench.film_set import film_set
from gltf_iri.errors import UsageError
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.timed_calls import call_colours, time_calls
from gltf_iri.rendering.timing import averaging_call, one_channel_call, time_twins, twin_call


def test_each_method_has_its_time_on_this_renderer(gl_context: moderngl.Context) -> None:
    times = time_twins(gl_context, ("khr", "spectral"), film_set(8), rounds=3, side=64)
    assert times.renderer == renderer_name(gl_context)
    assert list(times.ns_per_eval) == ["khr", "spectral"]
    # Five hundred wavelengths cost more than one formula, whatever draws them.
    assert times.ns_per_eval["spectral"] > times.ns_per_eval["khr"]
    assert times.baseline_ns > 0.0


def test_a_method_without_a_twin_is_not_timed(gl_context: moderngl.Context) -> None:
    with pytest.raises(UsageError, match="kehr"):
        time_twins(gl_context, ("kehr",), film_set(8), side=8)


def test_averaging_over_thickness_is_timed_by_the_twin_that_averages(gl_context: moderngl.Context) -> None:
    film = film_set(16)
    plain, averaging = twin_call("fourier", film), averaging_call("fourier", film, 0.05)
    times = time_calls(gl_context, [plain, averaging], rounds=1, side=16)
    assert len(times.ns) == 2
    at_mean, averaged = (call_colours(gl_context, call, 16) for call in (plain, averaging))
    assert np.abs(averaged - at_mean).max() > 1e-3
    with pytest.raises(UsageError, match="cannot average"):
        averaging_call("khr", film, 0.05)


def test_one_channel_of_a_grey_base_is_all_three(gl_context: moderngl.Context) -> None:
    film = film_set(16)
    three, one = (
        call_colours(gl_context, make("fourier", film), 16) for make in (twin_call, one_channel_call)
    )
    assert np.abs(one - three).max() < 1e-6
