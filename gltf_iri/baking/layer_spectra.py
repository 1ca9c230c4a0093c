"""The spectra of a plan's layers, at wavelengths that one rule gives for all, and how tables keep them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import choose_backend
from gltf_iri.colour.bands import bands_of
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.quadrature import HALF_BANDWIDTH_PER_NM, ColourRule, colour_density
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.planned_stack import period_nm
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer

__all__ = ["Weighing", "layer_rule", "layer_spectra", "path_nm", "weighing_of"]

Float64 = NDArray[np.float64]

# Even wavenumbers: two for each turn of the finest fringes see them, fifty and more the resonances beside the
# band gaps, which are so much narrower: of 20 cells of 200 nm, 2048 keep colours to ΔE 0.01 (p95).
_A_TURN: Final = 50.0
_FEWEST: Final = 512
_MOST: Final = 8192


@dataclass(frozen=True, slots=True)
class Weighing:
    """How tables keep a spectrum: B sums over its values at the wavelengths of `rule`.

    shares : (k, B) of each wavelength; weights : (B, 3) of each sum in linear Rec.709.
    """

    rule: ColourRule
    shares: Float64
    weights: Float64


def weighing_of(plan: LayersPlan, bands: int, white: White, *, is_colour: bool) -> Weighing:
    """Return how means over `bands` bands under `white` are made of the spectra of `plan`, or colours."""
    rule = layer_rule(plan, white)
    if is_colour:
        return Weighing(rule, rule.weights, np.eye(3))
    found = bands_of(bands, white)
    return Weighing(rule, found.shares(rule), found.weights)


def layer_rule(plan: LayersPlan, white: White) -> ColourRule:
    """Return wavelengths that resolve the layers' resonances, as far as so many can."""
    turns = 2.0 * HALF_BANDWIDTH_PER_NM * path_nm(plan)
    wanted = 2 ** math.ceil(math.log2(max(_A_TURN * turns, _FEWEST)))
    return _midpoints(min(wanted, _MOST), white)


def layer_spectra(
    plan: LayersPlan, layer: PlannedLayer, texel: Float64, cos_theta: Float64, rule: ColourRule
) -> Float64:
    """Return the reflectance (..., k) of facets met at `cos_theta` in the host; it and `texel` broadcast."""
    period = period_nm(plan, layer, texel)[..., None]
    spectra = math.prod(np.broadcast_shapes(np.shape(texel), np.shape(cos_theta)))
    return bragg_reflectance(
        plan.host_ior,
        layer.n1,
        layer.n2,
        layer.fill * period,
        (1.0 - layer.fill) * period,
        layer.cells,
        rule.wavelength_nm,
        cos_theta[..., None],
        # A colour of a film costs about as much as a value of a spectrum of a mirror here.
        backend=choose_backend(
            "auto", spectra * len(rule.wavelength_nm), ("numpy", "numba"), "layers-single"
        ),
    )


def path_nm(plan: LayersPlan) -> float:
    """Return the path difference of the finest fringes of any layer: through all its cells and back."""
    return max(
        2.0 * each.cells * max(each.period_nm) * (each.fill * each.n1 + (1.0 - each.fill) * each.n2)
        for each in plan.layers
    )


@cache
def _midpoints(count: int, white: White) -> ColourRule:
    """Return the midpoint rule of `count` even wavenumbers, whose integrand vanishes at both ends."""
    step = 2.0 * HALF_BANDWIDTH_PER_NM / count
    wavenumbers = 1.0 / WAVELENGTH_RANGE_NM[0] - step * (np.arange(count) + 0.5)
    wavelength_nm = np.asarray(1.0 / wavenumbers, np.float64)
    weights = colour_density(wavelength_nm, white) * wavelength_nm[:, None] ** 2
    weights /= weights.sum(axis=0)
    for array in (wavelength_nm, weights):
        array.setflags(write=False)
    return ColourRule(wavelength_nm, weights)
