"""Method `yeh-grid`: the exact mirror at a fixed number of evenly spaced wavelengths."""

from __future__ import annotations

from gltf_iri.colour.spaces import White
from gltf_iri.colour.wavelength_grid import integrate_on_grid
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.spectral_grid import GRID_SAMPLES
from gltf_iri.evaluation.yeh_spectral import MirrorRows

__all__ = ["evaluate_yeh_grid"]


def evaluate_yeh_grid(mirror: Mirror, white: White, *, samples: int = GRID_SAMPLES) -> Evaluation:
    """Evaluate `yeh-grid` at `samples` wavelengths from 360 to 830 nm (`colour/wavelength_grid.py`).

    Exact at each of them; the fringes of many cells alias. Raises UsageError where so few see nothing of the
    light.
    """
    rows = MirrorRows(mirror)
    rgb = integrate_on_grid(rows.reflectance, rows.count, samples, white=white)
    return Evaluation(rgb.reshape(*mirror.shape, 3), "yeh-grid", str(white))
