"""Where light on layered mirrors goes: sent back, passed on into the base's medium, and the rest.

Of one layer all light is accounted for. Facets at θ_d are met in proportion to their visible density D_v; the
share R of theirs leaves where no other facet masks it, G₁(o), and 1 − R passes where none masks the way on,
G₁(i) (Fourneau et al. 2024, Eq. 17 and 22):

    R(i) = ∫ D_v G₁(o) R dω_m,   T(i) = ∫ D_v G₁(i) (1 − R) dω_m,   A = 1 − R − T ≥ 0,   ∫ D_v dω_m = 1.

A is what facets mask, and counts as absorbed. The loss of Eq. 30 is that of the transmission alone, 1 − G₁
at most: beside what is reflected it may be too much or too little. Of a stack in the single-reflection model,
the rest also holds all light that would be reflected more than once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_spectra import LayerSpectra, fringes_of
from gltf_iri.evaluation.layers import BraggLayer, LayerColours, LayerStack, coating_reflectance
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_lobe import LobeNodes, layer_lobe, lobe_nodes
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.quadrature import gauss_unit

__all__ = ["LayerShares", "StackEnergy", "layer_shares", "stack_energy"]

Float64 = NDArray[np.float64]

# Gauss points over angles (each of three panels) and turns of what one layer sends: 1e-12 of its sum. And for
# each fringe more, so that R of single wavelengths keeps 2e-7 at five fringes, 1e-4 at twenty and 7e-4 at
# thirty, where resonances are narrow. For stacks, where every point costs a spectrum, fewer: 3e-6 of smooth
# colours for α from 0.005, in air and under a coating.
_ANGLES: Final = 32
_TURNS: Final = 32
_POINTS_A_FRINGE: Final = 6
_POINTS_MAX: Final = 160
_STACK_ANGLES: Final = 12
_STACK_TURNS: Final = 16

_VALUES_AT_ONCE: Final = 1 << 21  # bounds memory: points × wavelengths

_COSINES: Final = 32  # of what a Lambertian base sends

# Facets less rough than this are summed as smooth: beneath, cosines no longer hold the angles of their lobe,
# and at 1e-9 its sum is 95 times too large. But within α of the horizon both are the same to 1e-4.
_SMOOTH_ALPHA: Final = 1e-4


class LayerShares(NamedTuple):
    """Shares of unpolarised light: reflected, transmitted, absorbed; they add up to 1."""

    reflected: Float64
    transmitted: Float64
    absorbed: Float64


@dataclass(frozen=True, slots=True)
class StackEnergy:
    """Colours (n, 3) of what a stack makes of light at n angles, white 1.

    reflected : the whole BRDF over the hemisphere, and the coating's mirror image. from_base : what of it has
    been at the base. transmitted : into the base's medium. absorbed : 1 − (reflected − from_base) −
    transmitted, what facets mask and what would be reflected again; a channel of it may be negative, as any
    colour beyond Rec.709.
    """

    reflected: Float64
    from_base: Float64
    transmitted: Float64
    absorbed: Float64


def layer_shares(
    layer: BraggLayer, host_ior: float, cos_theta: ArrayLike, wavelength_nm: ArrayLike
) -> LayerShares:
    """Return R, T and A (n, k) of one layer met at `cos_theta` (n,) in its host, at `wavelength_nm` (k,).

    Raises UsageError for layers of arrays.
    """
    if layer.shape != ():
        raise UsageError("The shares of a layer are those of one layer: give numbers, not arrays.")
    cosine, wavelength = (np.atleast_1d(np.asarray(a, np.float64)) for a in (cos_theta, wavelength_nm))
    spectra = LayerSpectra(layer, host_ior)
    passed = spectra.transmissivity(cosine, wavelength)
    if spectra.alpha == 0.0:
        sent = spectra.reflectance(cosine, wavelength)
    else:
        sent = _sent(spectra, cosine, wavelength, fringes_of(layer, host_ior))
    return LayerShares(sent, passed, 1.0 - sent - passed)


def _sent(spectra: LayerSpectra, cosine: Float64, wavelength_nm: Float64, fringes: float) -> Float64:
    """Return R (n, k) of a rough layer, an integral over its lobe at each of `cosine` (n,)."""
    more = int(_POINTS_A_FRINGE * fringes)
    angles, turns = (min(count + more, _POINTS_MAX) for count in (_ANGLES, _TURNS))
    sent = np.zeros((len(cosine), len(wavelength_nm)))
    step = max(1, _VALUES_AT_ONCE // (3 * angles * turns))
    for row, each in enumerate(cosine):
        cos_h, weights = layer_lobe(each, spectra.alpha, angles=angles, turns=turns)
        for first in range(0, len(wavelength_nm), step):
            some = slice(first, first + step)
            sent[row, some] = weights @ spectra.reflectance(cos_h, wavelength_nm[some])
    return sent


def stack_energy(
    stack: LayerStack, cos_theta: ArrayLike, colours: LayerColours, white: White = "D65"
) -> StackEnergy:
    """Return where light at `cos_theta` (n,) outside goes, by a method's `colours` of one `stack`.

    What is transmitted comes of spectra, whatever the method. Raises UsageError for stacks of arrays.
    """
    if stack.host_ior.shape != () or any(layer.shape != () for layer in stack.layers):
        raise UsageError("The energy of a stack is that of one stack: give numbers, not arrays.")
    outside = np.atleast_1d(np.asarray(cos_theta, np.float64))
    host = float(stack.host_ior)
    enters = coating_transmittance(host, outside)[:, None]
    sent = np.zeros((len(outside), 3))
    for number, layer in enumerate(stack.layers):
        sent += _of_facets(host, outside, float(layer.alpha), number, colours)
    from_base = enters * _of_base(stack, host, outside, colours)
    mirrored = coating_reflectance(host, outside)[:, None]
    transmitted = enters * LayersSingle(stack, white).entering(cosine_in_host(host, outside))
    of_layers = mirrored + enters * sent
    return StackEnergy(of_layers + from_base, from_base, transmitted, 1.0 - of_layers - transmitted)


def _of_facets(host: float, outside: Float64, alpha: float, number: int, colours: LayerColours) -> Float64:
    if alpha < _SMOOTH_ALPHA:
        inside = cosine_in_host(host, outside)
        mirrored = colours.reflected(number, inside, inside, inside)
        return np.asarray(coating_transmittance(host, outside)[:, None] * mirrored)
    nodes, cos_i, leaving = _lobe(host, outside, alpha)
    colour = colours.reflected(number, nodes.cos_h, cos_i, nodes.cos_o)
    return np.asarray(np.einsum("nq,nqc->nc", leaving, colour))


def _of_base(stack: LayerStack, host: float, outside: Float64, colours: LayerColours) -> Float64:
    base, sent = stack.base, np.zeros((len(outside), 3))
    if base.is_black:
        return sent
    if base.diffuse.any():
        # Of cosines outside, c = t²: what is masked changes fastest towards grazing angles.
        t, weights = gauss_unit(_COSINES)
        weights = weights * 4.0 * t**3 * coating_transmittance(host, t * t) / float(stack.exit_ior) ** 2
        cos_i, cos_o = np.broadcast_arrays(
            cosine_in_host(host, outside)[:, None], cosine_in_host(host, t * t)
        )
        sent += base.diffuse * np.einsum("q,nqc->nc", weights, colours.passed(cos_i, cos_o))
    if base.metal_share.any():
        nodes, cos_i, leaving = _lobe(host, outside, float(base.metal_alpha))
        colour = colours.passed(cos_i, nodes.cos_o) * f_schlick(base.metal_f0, nodes.cos_h[..., None])
        sent += base.metal_share[..., None] * np.einsum("nq,nqc->nc", leaving, colour)
    return sent


def _lobe(host: float, outside: Float64, alpha: float) -> tuple[LobeNodes, Float64, Float64]:
    """Return what a lobe's light is sent to, cosines (n, q) of the light in the host, and what leaves it."""
    nodes = lobe_nodes(outside, alpha, host, angles=_STACK_ANGLES, turns=_STACK_TURNS)
    cos_i = np.broadcast_to(cosine_in_host(host, outside)[:, None], nodes.cos_h.shape)
    return nodes, cos_i, nodes.weights * coating_transmittance(host, nodes.cos_outside)
