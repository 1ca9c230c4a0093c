"""What the arguments of `gltf_iri.evaluate` describe: a film, a mirror, or a stack of layers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import (
    Base,
    Dispersion,
    Film,
    base_from_dispersion,
    base_from_edge_tint,
    base_from_f0,
    base_from_ior,
)
from gltf_iri.evaluation.layers import LayerStack
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.stack_evaluation import stack_of
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence

__all__ = ["SeenStack", "described"]


@dataclass(frozen=True, slots=True)
class SeenStack:
    """A stack at `cos_theta` (...) outside, lit from all around or by one `light`: see `evaluate_stack`."""

    stack: LayerStack
    cos_theta: ArrayLike
    light: Sequence[ArrayLike] | None


def described(
    cos_theta_1: ArrayLike,
    *,
    thickness_nm: ArrayLike | None,
    film_ior: ArrayLike | Dispersion | None,
    outside_ior: ArrayLike | None,
    base_f0: ArrayLike | None,
    base_ior: ArrayLike | Dispersion | None,
    base_nk: ArrayLike | None,
    base_edge_tint: ArrayLike | None,
    bragg: Sequence[ArrayLike] | None,
    host_ior: ArrayLike | None,
    layers: Sequence[Sequence[ArrayLike]] | None,
    base_diffuse: ArrayLike | None,
    base_metal: ArrayLike | None,
    base_alpha: ArrayLike | None,
    light: Sequence[ArrayLike] | None,
) -> Film | Mirror | SeenStack:
    """Return what is described; the arguments are those of `gltf_iri.evaluate`.

    Raises UsageError where some of them do not go together, and as the subjects' own checks do.
    """
    of_films = (thickness_nm, film_ior, outside_ior, base_f0, base_ior, base_nk, base_edge_tint)
    is_film_told = any(given is not None for given in of_films)
    if layers is not None:
        if is_film_told or bragg is not None:
            raise UsageError(
                "Layers have no film and no mirror beside them: base_diffuse and base_metal lie below them."
            )
        return SeenStack(stack_of(layers, host_ior, base_diffuse, base_metal, base_alpha), cos_theta_1, light)
    if any(given is not None for given in (base_diffuse, base_metal, base_alpha, light)):
        raise UsageError("base_diffuse, base_metal, base_alpha and light go with layers.")
    if bragg is not None:
        if is_film_told:
            raise UsageError("A Bragg mirror has no film and no base, and host_ior for what is outside.")
        cell = tuple(bragg) if isinstance(bragg, Iterable) else ()
        if len(cell) != 5:
            raise UsageError("bragg wants five: n1, n2, d1_nm, d2_nm and the number of cells.")
        return Mirror.of(cos_theta_1, *cell, host_ior)
    if thickness_nm is None:
        raise UsageError("A film wants thickness_nm, a mirror bragg, and a stack layers.")
    if host_ior is not None:
        raise UsageError("A film has outside_ior for what is outside, not host_ior.")
    index = Iridescence().film_ior if film_ior is None else film_ior
    base = _base(base_f0, base_ior, base_nk, base_edge_tint)
    return Film.of(cos_theta_1, thickness_nm, index, base, 1.0 if outside_ior is None else outside_ior)


def _base(
    f0: ArrayLike | None,
    ior: ArrayLike | Dispersion | None,
    nk: ArrayLike | None,
    edge_tint: ArrayLike | None,
) -> Base:
    if sum(given is not None for given in (f0, ior, nk)) > 1:
        raise UsageError("There is one base only: give base_f0, base_ior or base_nk.")
    if edge_tint is not None and f0 is None:
        raise UsageError("An edge tint wants base_f0, the metal's colour straight on.")
    if f0 is not None:
        colour = np.asarray(f0, dtype=np.float64)
        colour = np.repeat(colour, 3) if colour.ndim == 0 else colour
        return base_from_f0(colour) if edge_tint is None else base_from_edge_tint(colour, edge_tint)
    if nk is not None:
        pairs = np.asarray(nk, dtype=np.float64)
        if pairs.shape[-1:] != (2,):
            raise UsageError("base_nk wants n and k in its last axis.")
        return base_from_ior(pairs[..., 0] + 1j * pairs[..., 1])
    if callable(ior):
        return base_from_dispersion(ior)
    return base_from_ior(Ior().ior if ior is None else ior)
