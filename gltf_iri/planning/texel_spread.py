"""How far texels within a pixel's footprint differ: the standard deviations on the levels of a mip chain."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Spread", "texel_spread"]

# A texture that is seen this small is a few pixels wide: what coarser levels hold is hardly ever drawn.
_FEWEST_TEXELS: Final = 16

_USUAL_PERCENT: Final = 95.0


@dataclass(frozen=True, slots=True)
class Spread:
    """Standard deviations within footprints.

    usual : what 95 % of footprints lie below, where every level down to 16 texels is as likely as another.
    greatest : of any footprint on any level.
    """

    usual: float
    greatest: float

    def times(self, factor: float) -> Spread:
        """Return the spread of `factor` times the texels."""
        return Spread(factor * self.usual, factor * self.greatest)


def texel_spread(channel: NDArray[np.uint8]) -> Spread:
    """Return the spread of one channel (height, width) of bytes, in units of 255 of them."""
    import numpy as np

    from gltf_iri.asset.moments import MEAN, ROUNDING, SQUARE, moment_levels

    greatest = 0.0
    samples: list[NDArray[np.float64]] = []
    for level in islice(moment_levels(channel), 1, None):
        mean = level[..., MEAN].astype(np.float64)
        variance = level[..., SQUARE] - mean * mean
        # What single precision leaves of equal texels is not a spread.
        deviation = np.sqrt(np.where(variance < ROUNDING, 0.0, variance))
        greatest = max(greatest, float(deviation.max()))
        if not samples or min(deviation.shape) >= _FEWEST_TEXELS:
            samples.append(np.percentile(deviation, np.arange(0.5, 100.0)))
    usual = float(np.percentile(np.concatenate(samples), _USUAL_PERCENT)) if samples else 0.0
    return Spread(usual, greatest)
