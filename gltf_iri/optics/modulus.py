"""The square of a complex number's size: what an amplitude carries in power."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["squared_modulus"]


def squared_modulus(z: NDArray[Any]) -> NDArray[np.float64]:
    """Return |z|² (...), without the root that np.abs would take first."""
    return np.asarray(z.real * z.real + z.imag * z.imag)
