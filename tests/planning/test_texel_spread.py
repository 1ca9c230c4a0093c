"""The spread within footprints, against moments of whole blocks."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.planning.texel_spread import texel_spread


def test_a_texture_of_one_value_has_no_spread() -> None:
    for value in (0, 77, 255):
        spread = texel_spread(np.full((64, 48), value, np.uint8))
        assert (spread.usual, spread.greatest) == (0.0, 0.0)


def test_a_checkerboard_spreads_by_half_its_contrast_on_every_level() -> None:
    board = np.where(np.indices((64, 64)).sum(axis=0) % 2 == 0, 255, 51).astype(np.uint8)
    spread = texel_spread(board)
    assert spread.usual == pytest.approx(0.4, rel=1e-4)
    assert spread.greatest == pytest.approx(0.4, rel=1e-4)


def test_a_step_of_one_byte_is_a_spread() -> None:
    board = (100 + np.indices((64, 64)).sum(axis=0) % 2).astype(np.uint8)
    spread = texel_spread(board)
    assert spread.usual == pytest.approx(0.5 / 255.0, rel=0.02)
    assert spread.greatest == pytest.approx(0.5 / 255.0, rel=0.02)


def test_the_greatest_spread_is_that_of_some_whole_block() -> None:
    g = np.random.default_rng(3)
    texels = g.integers(0, 256, (128, 128), np.uint8)
    share = texels / 255.0
    blocks = [
        share.reshape(128 // side, side, 128 // side, side).std(axis=(1, 3)) for side in (2, 4, 8, 16, 32, 64)
    ]
    greatest = max(each.max() for each in [*blocks, share.std()])
    spread = texel_spread(texels)
    assert spread.greatest == pytest.approx(greatest, rel=1e-4)
    assert 0.0 < spread.usual <= spread.greatest


def test_levels_where_a_texture_is_a_few_texels_do_not_count_as_usual() -> None:
    # Smooth within 16 × 16 texels, different from one such block to the next.
    texels = np.kron(np.indices((8, 8)).sum(axis=0) % 2 * 255, np.ones((64, 64))).astype(np.uint8)
    spread = texel_spread(texels)
    assert spread.usual == 0.0
    assert spread.greatest == pytest.approx(0.5, rel=1e-4)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (5, 3), (17, 2)])
def test_small_and_odd_textures_have_a_spread_too(shape: tuple[int, int]) -> None:
    texels = np.arange(np.prod(shape)).reshape(shape).astype(np.uint8)
    spread = texel_spread(texels)
    assert 0.0 <= spread.usual <= spread.greatest <= 0.5
