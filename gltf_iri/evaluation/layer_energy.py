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
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import BraggLayer, LayerColours, LayerStack, coating_reflectance
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.optics.facet_mean import facet_directions
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.quadrature import gauss_unit

__all__ = ["LayerShares", "StackEnergy", "layer_shares", "sent_facets", "stack_energy"]

Float64 = NDArray[np.float64]

# Gauss points over the facets' slopes (each of two panels) and turns: 2e-9 of their sum for α ≥ 0.1, 1e-8 at
# 0.05, 2e-7 at 0.01; for stacks, where every point costs a spectrum, fewer, and 1e-5. Under a coating, whose
# transmittance begins as a square root at the angle of total reflection, 4e-3 of white.
_SLOPES: Final = 48
_TURNS: Final = 16
_STACK_SLOPES: Final = 20
_STACK_TURNS: Final = 8

_COSINES: Final = 32  # of what a Lambertian base sends


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


def sent_facets(
    cos_theta: ArrayLike, alpha: ArrayLike, *, slopes: int = _SLOPES, turns: int = _TURNS
) -> tuple[Float64, Float64, Float64]:
    """Return cosines i·h and θ_o, and weights (..., q) of ∫ D_v G₁(o) f dω_m, facets that send light up.

    cos_theta : of the light at the layer, in (0, 1]; alpha : in (0, 1].
    """
    c, a = np.broadcast_arrays(np.asarray(cos_theta, np.float64), np.asarray(alpha, np.float64))
    cos_h, cos_o, share = facet_directions(c, a, slopes=slopes, turns=turns)
    c, a = c[..., None], a[..., None]
    seen = (c + np.sqrt(a * a + (1.0 - a * a) * c * c)) * (
        cos_o + np.sqrt(a * a + (1.0 - a * a) * cos_o * cos_o)
    )
    return np.minimum(cos_h, 1.0), cos_o, share / seen


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
        cos_h, _, weights = sent_facets(np.maximum(cosine, 1e-9), spectra.alpha)
        of_facets = spectra.reflectance(cos_h.reshape(-1), wavelength).reshape(*cos_h.shape, -1)
        sent = np.einsum("nq,nqk->nk", weights, of_facets)
    return LayerShares(sent, passed, 1.0 - sent - passed)


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
    inside = np.maximum(cosine_in_host(host, outside), 1e-9)
    enters = coating_transmittance(host, outside)[:, None]
    sent = np.zeros((len(outside), 3))
    for number, layer in enumerate(stack.layers):
        sent += _of_facets(host, inside, float(layer.alpha), number, colours)
    from_base = enters * _of_base(stack, host, inside, colours)
    mirrored = coating_reflectance(host, outside)[:, None]
    transmitted = enters * LayersSingle(stack, white).entering(inside)
    of_layers = mirrored + enters * sent
    return StackEnergy(of_layers + from_base, from_base, transmitted, 1.0 - of_layers - transmitted)


def _of_facets(host: float, inside: Float64, alpha: float, number: int, colours: LayerColours) -> Float64:
    if alpha == 0.0:
        mirrored = colours.reflected(number, inside, inside, inside)
        return np.asarray(_leaving(host, inside)[:, None] * mirrored)
    cos_h, cos_o, weights = sent_facets(inside, alpha, slopes=_STACK_SLOPES, turns=_STACK_TURNS)
    cos_i = np.broadcast_to(inside[:, None], cos_h.shape)
    colour = colours.reflected(number, cos_h, cos_i, cos_o)
    return np.asarray(np.einsum("nq,nqc->nc", weights * _leaving(host, cos_o), colour))


def _of_base(stack: LayerStack, host: float, inside: Float64, colours: LayerColours) -> Float64:
    base, sent = stack.base, np.zeros((len(inside), 3))
    if base.is_black:
        return sent
    if base.diffuse.any():
        # Of cosines outside, c = t²: what is masked changes fastest towards grazing angles.
        t, weights = gauss_unit(_COSINES)
        outside = t * t
        weights = weights * 4.0 * t**3 * coating_transmittance(host, outside) / float(stack.exit_ior) ** 2
        cos_i, cos_o = np.broadcast_arrays(inside[:, None], cosine_in_host(host, outside))
        sent += base.diffuse * np.einsum("q,nqc->nc", weights, colours.passed(cos_i, cos_o))
    if base.metal_share.any():
        alpha = float(base.metal_alpha)
        cos_h, cos_o, weights = sent_facets(inside, alpha, slopes=_STACK_SLOPES, turns=_STACK_TURNS)
        cos_i = np.broadcast_to(inside[:, None], cos_h.shape)
        colour = colours.passed(cos_i, cos_o) * f_schlick(base.metal_f0, cos_h[..., None])
        sent += base.metal_share[..., None] * np.einsum("nq,nqc->nc", weights * _leaving(host, cos_o), colour)
    return sent


def _leaving(host: float, inside: Float64) -> Float64:
    """Return what the coating lets out of light at `inside` in the host: nothing beyond total reflection."""
    squared = 1.0 - host * host * (1.0 - inside) * (1.0 + inside)
    passed = coating_transmittance(host, np.sqrt(np.maximum(squared, 0.0)))
    return np.asarray(np.where(squared > 0.0, passed, 0.0) if host > 1.0 else np.ones(np.shape(inside)))
