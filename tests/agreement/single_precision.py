"""What float32 holds, and sets of films on which GLSL and Python must agree."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.optics.ior import fresnel0_to_ior

__all__ = ["branch_films", "edge_films", "film_of", "random_films", "rounded"]

RANDOM_FILMS = 100_000

# Steps around a branch, in float32 ulp: as many rows inside GLSL_BRANCH_ULP as outside.
STEPS_ULP = np.arange(-16, 17)


def rounded(values: ArrayLike) -> NDArray[np.float64]:
    """`values` as float32 sees them, in float64."""
    return np.asarray(values, dtype=np.float32).astype(np.float64)


def film_of(outside: ArrayLike, film: ArrayLike, f0: ArrayLike, nm: ArrayLike, cosine: ArrayLike) -> Film:
    return Film.of(
        rounded(cosine), rounded(nm), rounded(film), base_from_f0(rounded(f0)), outside_ior=rounded(outside)
    )


def random_films() -> Film:
    """glTF's films (under air) and, for every fourth row, films under another medium."""
    g = np.random.default_rng(20170501)
    n = RANDOM_FILMS
    outside = np.where(np.arange(n) % 4 == 0, g.uniform(1.0, 1.7, n), 1.0)
    f0 = g.uniform(0.0, 1.0, (n, 3))
    f0[::3] = 1.0 - f0[::3] ** 2  # bright metals, next to the text's pole
    longest_nm = np.where(np.arange(n) % 2 == 0, 1_000.0, 10_000.0)
    return film_of(outside, g.uniform(1.0, 3.0, n), f0, longest_nm * g.random(n), g.random(n))


def edge_films() -> Film:
    """Every combination of the limits, with film indices equal to the bases' among them."""
    f0 = [0.0, 0.04, 0.5, 0.999, np.nextafter(np.float32(0.9999), np.float32(0.0)), 0.9999, 1.0]
    equal = [float(fresnel0_to_ior(x)) for x in (0.04, 0.0401, 0.5, 0.5001)]
    rows = np.array(
        list(
            itertools.product(
                [1.0, 1.5], [1.0, 1.3, 1.5, *equal], f0, [0.0, 1e-3, 100.0, 1e4], [0, 1e-4, 0.5, 1]
            )
        )
    )
    outside, film, grey, nm, cosine = rows.T
    return film_of(outside, film, np.repeat(grey[:, None], 3, axis=1), nm, cosine)


def branch_films() -> Film:
    """Films some float32 steps around equal indices and around the critical angle."""
    g = np.random.default_rng(1815)
    n = 60
    steps = np.tile(STEPS_ULP, n)
    f0 = np.repeat(g.uniform(0.01, 0.2, (n, 3)), len(STEPS_ULP), axis=0)
    nm, cosine = (np.repeat(x, len(STEPS_ULP)) for x in (g.uniform(0, 2_000, n), g.uniform(0, 1, n)))
    base = _stepped(fresnel0_to_ior(rounded(f0[:, 0]) + 1e-4), steps)
    one = np.ones(len(steps))
    thin = np.repeat(g.uniform(1.0, 1.3, n), len(STEPS_ULP))
    critical = np.sqrt(1.0 - (rounded(thin) / 1.5) ** 2)
    return film_of(
        np.concatenate([one, one * 1.5, one * 1.5]),
        np.concatenate([base, _stepped(one * 1.5, steps), thin]),
        np.tile(f0, (3, 1)),
        np.tile(nm, 3),
        np.concatenate([cosine, cosine, _stepped(critical, steps)]),
    )


def _stepped(values: NDArray[np.float64], steps: NDArray[np.int64]) -> NDArray[np.float64]:
    single = np.asarray(values, dtype=np.float32)
    return np.asarray((single.view(np.int32) + steps.astype(np.int32)).view(np.float32), dtype=np.float64)
