"""Tone maps against their published GLSL, carried out one number at a time."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.rendering.tonemap import TONE_MAPS, tone_map

COLOURS = np.random.default_rng(3).exponential(1.0, (200, 3)) * np.logspace(-3, 2, 200)[:, None]


def neutral_as_published(r, g, b):
    x = min(r, g, b)
    offset = x - 6.25 * x * x if x < 0.08 else 0.04
    r, g, b = r - offset, g - offset, b - offset
    peak = max(r, g, b)
    if peak < 0.76:
        return r, g, b
    d = 1.0 - 0.76
    new_peak = 1.0 - d * d / (peak + d - 0.76)
    share = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0)
    return tuple(c * new_peak / peak * (1.0 - share) + new_peak * share for c in (r, g, b))


def test_neutral_is_the_published_curve():
    published = [neutral_as_published(*map(float, colour)) for colour in COLOURS]
    assert np.abs(tone_map("neutral", COLOURS) - np.clip(published, 0.0, 1.0)).max() <= 1e-14


def test_neutral_keeps_base_colours_and_takes_off_the_dielectric_reflection():
    base = np.array([[0.1, 0.3, 0.6], [0.5, 0.5, 0.5]])
    assert tone_map("neutral", base + 0.04) == pytest.approx(base, abs=1e-12)


def test_aces_keeps_grey_grey_and_lies_near_the_one_channel_fit():
    # Narkowicz 2015, "ACES Filmic Tone Mapping Curve", fits the same transforms in one channel, with 0.6 for
    # their exposure: the two fits stay within 0.07 of each other.
    grey = np.linspace(0.02, 4.0, 60)
    mapped = tone_map("aces", np.repeat(grey[:, None], 3, axis=1))
    assert np.ptp(mapped, axis=1).max() <= 1e-3
    x = grey * 0.6
    narkowicz = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    assert np.abs(mapped[:, 0] - narkowicz).max() <= 0.07


@pytest.mark.parametrize("name", TONE_MAPS)
def test_more_light_is_never_darker_and_always_displayable(name):
    grey = np.repeat(np.logspace(-4, 3, 300)[:, None], 3, axis=1)
    mapped = tone_map(name, grey)
    assert mapped.min() >= 0.0 and mapped.max() <= 1.0
    assert np.all(np.diff(mapped[:, 0]) >= 0.0)


def test_none_clips_and_nothing_else():
    assert tone_map("none", [-0.5, 0.25, 3.0]).tolist() == [0.0, 0.25, 1.0]


def test_an_unknown_name_lists_the_known_ones():
    with pytest.raises(UsageError, match="none, neutral, aces"):
        tone_map("filmic", [0.0, 0.0, 0.0])
