"""The fixed sets of films and mirrors on which the map of cost and error is drawn."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np

from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.mirror_set import MIRROR_CELLS, mirror_set
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.planning.reach import Span

__all__ = ["ACCURACY_SETS", "METAL_F0", "THICK_NM", "THIN_NM", "metal_set", "thick_set"]

# Oil on water, varnish and soap bubbles: fringes that no three wavelengths resolve.
THICK_NM: Final = Span(1000.0, 10_000.0)
THIN_NM: Final = Span(100.0, 800.0)
METAL_F0: Final = Span(0.2, 1.0)

_METALS: Final = 600
_METALS_SEED: Final = 2
_MIRRORS: Final = 300


def metal_set(count: int = _METALS) -> Film:
    """Return `count` films on coloured metals, drawn one by one so that a shorter set begins a longer one.

    In this order, all uniform: film index 1.1–2.2, thickness 100–800 nm, three base reflectances 0.2–1, cos θ
    0.05–1.
    """
    g = np.random.default_rng(_METALS_SEED)
    thickness, f0 = (THIN_NM.low, THIN_NM.high), (METAL_F0.low, METAL_F0.high)
    ranges = ((1.1, 2.2), thickness, f0, f0, f0, (0.05, 1.0))
    drawn = np.array([[g.uniform(low, high) for low, high in ranges] for _ in range(count)])
    return Film.of(drawn[:, 5], drawn[:, 1], drawn[:, 0], base_from_f0(drawn[:, 2:5]))


def thick_set() -> Film:
    """Return the film set with its thicknesses stretched from 100–800 nm to `THICK_NM`: the same draws."""
    thin = film_set()
    share = (thin.thickness_nm - THIN_NM.low) / (THIN_NM.high - THIN_NM.low)
    thickness_nm = THICK_NM.low + share * (THICK_NM.high - THICK_NM.low)
    return Film.of(thin.cos_theta_1, thickness_nm, thin.film_ior, base_from_ior(thin.base.index[..., 0].real))


# The names are those under which planning/costs.json keeps what they cost.
ACCURACY_SETS: Final[Mapping[str, Callable[[], Film | Mirror]]] = {
    "films": film_set,
    "metals": metal_set,
    "thick": thick_set,
    **{f"mirrors-{cells}": functools.partial(mirror_set, cells, _MIRRORS) for cells in MIRROR_CELLS},
}
