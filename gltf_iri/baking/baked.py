"""A table with its texels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.film_table import FilmTable

__all__ = ["BakedTable"]


@dataclass(frozen=True, slots=True)
class BakedTable:
    """A filled table.

    texels : (*table.shape, 3), float16 or float32 as `table.texel` says; axis 0 is cos_theta.
    white : the illuminant it was integrated under.
    filled_in_s : seconds that filling took, now or when it was put into the cache.
    is_cached : True where it was read from the cache.
    """

    table: FilmTable
    texels: NDArray[np.floating[Any]]
    white: str
    filled_in_s: float
    is_cached: bool
