"""The input that every method of layered mirrors shares, and the one sum that makes a BRDF of their colours.

Rough Bragg layers lie in a host on a base (Fourneau et al. 2024, §4). Each kept path reflects once, on one of
the layers or on the base, and crosses those above it twice, unbent (Eq. 34):

    f_r = T(i) T(o)/n_h² Σ_l w_l(h) · C_l(h, i, o) + base,   C_l = colour of R_l(h) Π_{k<l} T_k(i) T_k(o).

Methods differ in the colours C_l, and in that of Π T_k(i) T_k(o) over the base; nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Final, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import Sight, coating_transmittance, sight_of
from gltf_iri.optics.rough_bragg import facet_weight

__all__ = ["ALPHA_MAX", "LAYERS_MAX", "BraggLayer", "LayerBase", "LayerColours", "LayerStack", "Pose"]
__all__ += [
    "LayeredSurface",
    "MirroredColours",
    "brdf",
    "coating_reflectance",
    "evaluate_layered",
    "layer_terms",
]

Float64 = NDArray[np.float64]

LAYERS_MAX: Final = 8
ALPHA_MAX: Final = 1.0


@dataclass(frozen=True, slots=True)
class BraggLayer:
    """`cells` equal cells of n1 (met first) and n2 on facets of roughness α; arrays broadcast.

    n1, n2 : real indices; d1_nm, d2_nm : thicknesses; cells : whole numbers ≥ 1; alpha : perceptual roughness
    squared, in [0, 1].
    """

    n1: Float64
    n2: Float64
    d1_nm: Float64
    d2_nm: Float64
    cells: NDArray[np.int64]
    alpha: Float64

    @classmethod
    def of(
        cls,
        n1: ArrayLike,
        n2: ArrayLike,
        d1_nm: ArrayLike,
        d2_nm: ArrayLike,
        cells: ArrayLike,
        alpha: ArrayLike = 0.0,
    ) -> BraggLayer:
        """Check ranges and return the layer; UsageError for values out of range and for cells that absorb."""
        rough = np.asarray(alpha, np.float64)
        if not np.all((rough >= 0.0) & (rough <= ALPHA_MAX)):
            raise UsageError(f"The roughness α of a layer must lie in [0, {ALPHA_MAX:g}].")
        mirror = Mirror.of(1.0, n1, n2, d1_nm, d2_nm, cells)
        if not mirror.is_lossless:
            raise UsageError("The films of a layer among others must not absorb: give real indices.")
        return cls(mirror.n1.real, mirror.n2.real, mirror.d1_nm, mirror.d2_nm, mirror.cells, rough)

    def mirror(self, cos_theta: ArrayLike, host_ior: ArrayLike) -> Mirror:
        """Return the mirror that each facet is, met at `cos_theta` in the host."""
        return Mirror.of(cos_theta, self.n1, self.n2, self.d1_nm, self.d2_nm, self.cells, host_ior)

    @property
    def shape(self) -> tuple[int, ...]:
        """Broadcast shape of all fields."""
        return np.broadcast_shapes(*(np.shape(getattr(self, f.name)) for f in fields(self)))


@dataclass(frozen=True, slots=True)
class LayerBase:
    """What lies under the layers, linear Rec.709; a black base is all zero. Waves do not change what it is.

    diffuse : (..., 3) of a Lambertian share, f = ρ/π.
    metal_f0 : (..., 3) and metal_share (...): of a GGX metal, metal_share·Schlick(metal_f0), seen from where
        it lies; metal_alpha : its roughness, in (0, 1].
    """

    diffuse: Float64
    metal_f0: Float64
    metal_share: Float64
    metal_alpha: Float64

    @classmethod
    def of(
        cls,
        diffuse: ArrayLike = 0.0,
        metal_f0: ArrayLike = 0.0,
        metal_share: ArrayLike = 0.0,
        metal_alpha: ArrayLike = 1.0,
    ) -> LayerBase:
        """Check ranges and return the base; UsageError for reflectances outside [0, 1]."""
        rho, f0 = (np.asarray(x, np.float64) * np.ones(3) for x in (diffuse, metal_f0))
        share, alpha = np.asarray(metal_share, np.float64), np.asarray(metal_alpha, np.float64)
        for values in (rho, f0, share):
            if not np.all((values >= 0.0) & (values <= 1.0)):
                raise UsageError("The reflectances of a base under layers must lie in [0, 1].")
        if not np.all((alpha > 0.0) & (alpha <= ALPHA_MAX)):
            raise UsageError(f"The roughness α of a base must lie in (0, {ALPHA_MAX:g}].")
        return cls(rho, f0, share, alpha)

    @property
    def is_black(self) -> bool:
        """True where no layer's light needs to come back from below."""
        return not (self.diffuse.any() or self.metal_share.any())


@dataclass(frozen=True, slots=True)
class LayerStack:
    """Layers, outermost first, in a host on a base; arrays broadcast, a number for one stack.

    host_ior : real, ≥ 1. Layers whose n1 is the host's lie in it freely. Only the last may have another n1,
    and then what lies below it lies in that n1, and is not a metal: beyond such facets light is bent.
    """

    layers: tuple[BraggLayer, ...]
    host_ior: Float64
    base: LayerBase

    @classmethod
    def of(
        cls, layers: tuple[BraggLayer, ...], host_ior: ArrayLike = 1.0, base: LayerBase | None = None
    ) -> LayerStack:
        """Check the stack and return it; UsageError where a rule of `LayerStack` is broken."""
        host, under = np.asarray(host_ior, np.float64), base or LayerBase.of()
        if len(layers) > LAYERS_MAX:
            raise UsageError(f"A stack holds at most {LAYERS_MAX} layers; this one has {len(layers)}.")
        if not np.all((host >= 1.0) & (host <= 1e3)):
            raise UsageError("The host's index must lie in [1, 1000].")
        bends = [bool(np.any(layer.n1 != host)) for layer in layers]
        if any(bends[:-1]) or (bends and bends[-1] and np.any(under.metal_share > 0.0)):
            raise UsageError(
                "Light is bent behind a layer whose first index is not the host's:"
                " such a layer must be the last, on a black or diffuse base."
            )
        return cls(layers, host, under)

    @property
    def exit_ior(self) -> Float64:
        """Index of the medium that the base lies in."""
        return self.layers[-1].n1 if self.layers else self.host_ior


@dataclass(frozen=True, slots=True)
class Pose:
    """Light and viewer outside: cosines in [0, 1], and cos φ between them about the normal; they broadcast.

    At φ = π (cos_phi −1) the viewer stands in the plane and on the side of the mirrored light.
    """

    cos_theta_i: Float64
    cos_theta_o: Float64
    cos_phi: Float64

    @classmethod
    def of(cls, cos_theta_i: ArrayLike, cos_theta_o: ArrayLike, cos_phi: ArrayLike = -1.0) -> Pose:
        """Check ranges and return the pose; UsageError for cosines out of range."""
        i, o, phi = (np.asarray(x, np.float64) for x in (cos_theta_i, cos_theta_o, cos_phi))
        if not (np.all((i >= 0.0) & (i <= 1.0)) and np.all((o >= 0.0) & (o <= 1.0))):
            raise UsageError("The cosines of light and viewer must lie in [0, 1].")
        if not np.all(np.abs(phi) <= 1.0):
            raise UsageError("The cosine of the turn between light and viewer must lie in [−1, 1].")
        return cls(i, o, phi)


@dataclass(frozen=True, slots=True)
class LayeredSurface:
    """A stack as it is seen; the arrays of both broadcast."""

    stack: LayerStack
    pose: Pose

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the BRDF without its channel axis; UsageError where stack and pose do not broadcast."""
        stack, pose, base = self.stack, self.pose, self.stack.base
        of_base = (np.shape(base.diffuse)[:-1], np.shape(base.metal_f0)[:-1], np.shape(base.metal_share))
        try:
            return np.broadcast_shapes(
                *(np.shape(a) for a in (pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi, stack.host_ior)),
                *(layer.shape for layer in stack.layers),
                *of_base,
                np.shape(base.metal_alpha),
            )
        except ValueError:
            raise UsageError("The layers, their base, light and viewer do not broadcast.") from None


class MirroredColours(Protocol):
    """What a BRDF asks of a method: colours, white 1; cosines are those in the host, and broadcast."""

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        ...

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers; 1 where there is none."""
        ...


class LayerColours(MirroredColours, Protocol):
    """All that a method computes of one stack: for surfaces that let light through, of one crossing too."""

    def entering(self, cos_i: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        ...


def layer_terms(stack: LayerStack, sight: Sight, colours: MirroredColours) -> list[Float64]:
    """Return each layer's BRDF (..., 3), outermost first, and the base's at the end, below the coating."""
    terms = []
    for number, layer in enumerate(stack.layers):
        weight = _lobe(sight, layer.alpha)
        colour = colours.reflected(number, sight.cos_h, sight.cos_i, sight.cos_o)
        terms.append(np.asarray(weight[..., None] * colour))
    base = stack.base
    if base.is_black:
        terms.append(np.zeros((*np.shape(sight.cos_h), 3)))
        return terms
    weight = facet_weight(sight.n_cross_h_squared, sight.cos_i, sight.cos_o, base.metal_alpha)
    metal = base.metal_share[..., None] * f_schlick(base.metal_f0, sight.cos_h[..., None])
    bent = (stack.host_ior / stack.exit_ior) ** 2
    sent = base.diffuse * (bent / np.pi)[..., None] + weight[..., None] * metal
    terms.append(np.asarray(colours.passed(sight.cos_i, sight.cos_o) * sent))
    return terms


def _lobe(sight: Sight, alpha: Float64) -> Float64:
    """`facet_weight`, and 0 for smooth layers: they send nothing but their mirror image."""
    is_rough = alpha > 0.0
    rough = np.where(is_rough, alpha, 1.0)
    weight = facet_weight(sight.n_cross_h_squared, sight.cos_i, sight.cos_o, rough)
    return np.asarray(np.where(is_rough, weight, 0.0))


def brdf(stack: LayerStack, pose: Pose, colours: MirroredColours) -> Float64:
    """Return f_r (..., 3), 1/sr, without the coating's mirror image of a light (`coating_reflectance`).

    Fourneau et al. 2024, Eq. 34; below a coating 1/n_h² is what bending leaves of a radiance, T(i) T(o) what
    passes. Layers of α = 0 mirror light like the coating and have no BRDF: infinite at the mirror direction.
    """
    sight = sight_of(stack.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)
    # Not np.sum: terms of arrays broadcast, each in a shape of its own.
    sent = sum(layer_terms(stack, sight, colours), start=np.zeros(3))
    return np.asarray(sight.passage[..., None] * sent)


def coating_reflectance(host_ior: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """Return what the smooth surface of the host mirrors of light outside at `cos_theta`: f_r,0's weight."""
    return np.asarray(1.0 - coating_transmittance(host_ior, cos_theta))


def evaluate_layered(surface: LayeredSurface, colours: LayerColours, method: str, white: White) -> Evaluation:
    """Return the BRDF (*surface.shape, 3), 1/sr, as an evaluation of `method`.

    A smooth layer has none; where it mirrors the light straight into the viewer that is told as undefined.
    """
    shape, stack, pose = surface.shape, surface.stack, surface.pose
    rgb = np.broadcast_to(brdf(stack, pose, colours), (*shape, 3))
    sight = sight_of(stack.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)
    is_mirrored = np.zeros(shape, dtype=np.bool_)
    for layer in stack.layers:
        is_mirrored |= (layer.alpha == 0.0) & (sight.n_cross_h_squared == 0.0)
    undefined = {"the mirror image of a smooth layer": is_mirrored} if is_mirrored.any() else {}
    return Evaluation(rgb, method, str(white), undefined=undefined)
