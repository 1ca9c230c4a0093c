"""The colours of checked Bragg layers as smooth mirrors, all along the range of their periods."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.colour.wavelength_grid import integrate_on_grid
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.yeh_spectral import MirrorRows
from gltf_iri.optics.fresnel import f_schlick

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from gltf_iri.validation.bragg.stack import Layer, Stack

    Float64 = NDArray[np.float64]

__all__ = ["COSINES", "bare_colours", "cost_of", "layer_colours", "periods", "stack_colours"]

# From straight on to 78°, in the host: towards grazing light all surfaces are white.
COSINES = np.linspace(1.0, 0.2, 9)

# Every nanometre from 360 to 830, doubled until each fringe has a few: a hundredth of the truth's time. The
# fringes of more than twenty cells, which hardly add to a colour, are not resolved.
_WAVELENGTHS = 471
_MOST_WAVELENGTHS = 64 * _WAVELENGTHS
_PER_FRINGE = 8
_FRINGES_AT_NM = 400.0
_MOST_CELLS = 20

# How finely a range of periods is looked at.
_PERIODS = 33

_DIELECTRIC_F0 = 0.04


def layer_colours(
    layer: Layer, host_ior: float | None, period_nm: ArrayLike, cosines: ArrayLike = 1.0
) -> Float64:
    """Return (cosines, periods, 3) linear Rec.709 under D65 of what the layer's mirror alone reflects.

    Raises UsageError where the file does not say what it is, or says what no mirror can be.
    """
    rows = MirrorRows(_mirror(layer, host_ior, period_nm, cosines))
    rgb = integrate_on_grid(rows.reflectance, rows.count, _samples(layer, period_nm), white="D65")
    return rgb.reshape(np.size(cosines), -1, 3)


def stack_colours(stack: Stack, texel: float) -> Float64:
    """Return (cosines, 3): all layers on their base, at one value of the period texture; factor 1.

    Every path is reflected once, and the base, without its own interface, takes what the layers let through.
    """
    metallic, colour = _base(stack)
    under = (1.0 - metallic) * colour + metallic * f_schlick(colour, COSINES[:, None])
    at = {layer: periods(layer, np.array([texel])) for layer in stack.layers}
    mirrors = [MirrorRows(_mirror(layer, stack.host_ior, nm, COSINES)) for layer, nm in at.items()]
    samples = max((_samples(layer, nm) for layer, nm in at.items()), default=_WAVELENGTHS)

    def spectrum(rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
        total = np.zeros((len(rows), len(wavelength_nm)))
        passed = np.ones_like(total)
        for mirror in mirrors:
            reflectance = mirror.reflectance(rows, wavelength_nm)
            total += passed * reflectance
            passed *= (1.0 - reflectance) ** 2
        return np.asarray(total[..., None] + passed[..., None] * under[rows][:, None])

    return integrate_on_grid(spectrum, len(COSINES), samples, white="D65")


def bare_colours(stack: Stack) -> Float64:
    """Return (cosines, 3) of the core material, its textures left out."""
    metallic, colour = _base(stack)
    cosine = COSINES[:, None]
    fresnel = f_schlick(np.full(3, _DIELECTRIC_F0), cosine)
    dielectric = fresnel + (1.0 - fresnel) * colour
    return np.asarray((1.0 - metallic) * dielectric + metallic * f_schlick(colour, cosine))


def cost_of(stack: Stack) -> int:
    """Return how many reflectances it takes to look at all layers all over; UsageError where too many."""
    return sum(_samples(layer, periods(layer)) for layer in stack.layers) * _PERIODS * len(COSINES)


def periods(layer: Layer, texels: Float64 | None = None) -> Float64:
    """Return the periods at values of the texture; without them, all over the range."""
    if layer.periods_nm is None:
        raise UsageError("The file does not say what the period is.")
    low, high = layer.periods_nm[0], layer.periods_nm[-1]
    if texels is None:
        texels = np.linspace(0.0, 1.0, _PERIODS) if low != high else np.array([1.0])
    return low + texels * (high - low)


def _samples(layer: Layer, period_nm: ArrayLike) -> int:
    """Return how many wavelengths the layer's fringes ask for; UsageError where it is too many."""
    index = max(value or 0.0 for value in (layer.ior1, layer.ior2))
    path_nm = 2.0 * index * float(np.max(period_nm)) * min(layer.cells or 1.0, _MOST_CELLS)
    low, high = WAVELENGTH_RANGE_NM
    wanted = (high - low) * _PER_FRINGE * path_nm / _FRINGES_AT_NM**2
    samples = _WAVELENGTHS
    while samples < wanted:
        samples *= 2
        if samples > _MOST_WAVELENGTHS:
            raise UsageError("The fringes of such thick cells are too fine.")
    return samples


def _mirror(layer: Layer, host_ior: float | None, period_nm: ArrayLike, cosines: ArrayLike) -> Mirror:
    told = (layer.ior1, layer.ior2, layer.fill, layer.cells, host_ior)
    if None in told:
        raise UsageError("The file does not say what the layer is.")
    ior1, ior2, fill, cells, host = (float(value or 0.0) for value in told)
    nm = np.atleast_1d(np.asarray(period_nm, dtype=np.float64))
    angles = np.atleast_1d(np.asarray(cosines, dtype=np.float64))[:, None]
    return Mirror.of(angles, ior1, ior2, fill * nm, (1.0 - fill) * nm, cells, host)


def _base(stack: Stack) -> tuple[float, Float64]:
    pbr = stack.material.get("pbrMetallicRoughness", {})
    return pbr.get("metallicFactor", 1.0), np.array(pbr.get("baseColorFactor", (1.0, 1.0, 1.0))[:3])
