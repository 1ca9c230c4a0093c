"""How far apart the colours of neighbouring values of a thickness texture are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gltf_iri.errors import UsageError
from gltf_iri.validation.optics.film_colours import bases_of, film_colours, largest_difference

if TYPE_CHECKING:
    from gltf_iri.validation.iridescence.film import Film

__all__ = ["largest_step"]


def largest_step(film: Film, levels: int) -> float:
    """Return the largest CIEDE2000, straight on, between texels that differ by one of `levels` − 1 steps.

    0 where the file does not say what the film is, or says what no film can be.
    """
    nm = np.linspace(film.minimum_nm, film.maximum_nm, levels)
    try:
        colours = [film_colours(base, nm, film.ior, cosines=1.0)[0] for base in bases_of(film)]
    except UsageError:
        return 0.0
    return max(largest_difference(rgb[1:], rgb[:-1]) for rgb in colours)
