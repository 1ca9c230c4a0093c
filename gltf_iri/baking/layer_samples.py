"""Colours of a plan's layers at random poses: the truth, and what bands and colours make of it.

All come from the same spectra. Where the texture of periods varies, some of its values are drawn, and for
each some poses: a layer's spectra at one period give what passes it in every direction. Light and viewer
stand at cosines of one even, jittered pool, so that the filter is integrated once for each of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, to_coefficients
from gltf_iri.baking.layer_factors import passing_moments
from gltf_iri.baking.layer_spectra import Weighing, layer_rule, layer_spectra, weighing_of
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quadrature import ColourRule
from gltf_iri.colour.quantile import bounds
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.optics.layer_stack import cosine_in_host, sight_of
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer
from gltf_iri.planning.method import truth_of

__all__ = ["COLOURS", "LayerSamples", "doubt_of", "p95_below", "p95_guess", "sampled_layers"]

Float64 = NDArray[np.float64]

# Stands among numbers of bands for colours that are multiplied.
COLOURS: Final = 0

_DOUBTED: Final = 8
_TERMS: Final = 384  # of the series over the cosine: resonances beside band gaps are narrow
_POOL: Final = 256  # cosines that light and viewer stand at
_POSES_AT_ONCE: Final = 256  # bounds memory: each has some spectra of up to 8192 values

# Of 1024 samples so many lie below what surely lies above 0.95 of all.
_BOUND_SHARE: Final = 0.97

# Colours (n, 3): each layer's reflection, outermost first; then, over a base, what passes all both ways, and,
# where light from behind crosses the layers, what passes all once, towards the viewer.
Terms = tuple[Float64, ...]


@dataclass(frozen=True, slots=True)
class LayerSamples:
    """n poses, with cosines in the host and values of the texture of periods.

    truth : of single reflections; by_bands : what so many bands make of it without any table; is_crossed :
    whether what passes all layers once is among both.
    """

    texel: Float64
    cos_h: Float64
    cos_i: Float64
    cos_o: Float64
    truth: Terms
    by_bands: dict[int, Terms]
    is_crossed: bool = False


def p95_below(found: Terms, truth: Terms) -> float:
    """Return what the p95 of CIEDE2000 surely lies below (`colour.quantile`), the greatest of the terms'."""
    return max(bounds(delta_e_2000(a, b))[1] for a, b in zip(found, truth, strict=True))


def p95_guess(found: Terms, truth: Terms) -> float:
    """Return about what `p95_below` will be at more samples, the greatest of the terms'."""
    errors = (delta_e_2000(a, b) for a, b in zip(found, truth, strict=True))
    return max(float(np.quantile(each, _BOUND_SHARE)) for each in errors)


def doubt_of(plan: LayersPlan, samples: LayerSamples, white: White) -> float:
    """Return the most, in CIEDE2000, that `samples.truth` is off `layers-single` itself at a few of them."""
    last = len(samples.texel) - 1
    if plan.varies:
        # Of the first period drawn and the last: the truth integrates the filter anew for every other one.
        ends = (np.flatnonzero(samples.texel == samples.texel[end]) for end in (0, last))
        some = np.concatenate([end[:: max(1, 2 * len(end) // _DOUBTED)][: _DOUBTED // 2] for end in ends])
    else:
        some = np.linspace(0, last, _DOUBTED).astype(np.intp)
    texel = samples.texel[some] if plan.varies else plan.texel.high
    exact = layer_colours(truth_of("layers"), planned_stack(plan, texel), white=white)
    cosines = [c[some] for c in (samples.cos_h, samples.cos_i, samples.cos_o)]
    terms = [exact.reflected(number, *cosines) for number in range(len(plan.layers))]
    if plan.under == "base":
        terms.append(exact.passed(*cosines[1:]))
    if samples.is_crossed:
        terms.append(exact.entering(cosines[2]))
    errors = (delta_e_2000(a, b[some]) for a, b in zip(terms, samples.truth, strict=True))
    return max(float(each.max()) for each in errors)


def sampled_layers(
    plan: LayersPlan,
    white: White,
    *,
    texels: int,
    poses: int,
    seed: int,
    bands: Sequence[int],
    is_crossed: bool = False,
) -> LayerSamples:
    """Return `texels` · `poses` samples, poses alone where no period varies.

    Cosines outside are uniform in [0, 1], the turn between light and viewer in [0, π], the texture uniform
    over its span.

    bands : numbers of them that are wanted, COLOURS among them.
    is_crossed : light from behind is wanted too.
    """
    g = np.random.default_rng(seed)
    groups, each = (texels, poses) if plan.varies else (1, texels * poses)
    at = plan.texel.low + (plan.texel.high - plan.texel.low) * g.uniform(size=groups)
    pool = (np.arange(_POOL) + g.uniform(size=_POOL)) / _POOL
    # Each way takes the whole pool again and again, in orders that do not know of each other.
    turns = -(-groups * each // _POOL)
    stand = [
        np.concatenate([g.permutation(_POOL) for _ in range(turns)])[: groups * each].reshape(groups, each)
        for _ in range(2)
    ]
    turn = np.cos(np.pi * g.uniform(size=(groups, each)))
    sight = sight_of(plan.host_ior, pool[stand[0]], pool[stand[1]], turn)
    in_host = cosine_in_host(plan.host_ior, pool)
    filters = [
        None if layer.alpha <= ALPHA_MIN else passing_moments(in_host, layer.alpha, _TERMS)
        for layer in plan.layers
    ]
    weighings = {b: weighing_of(plan, max(b, 3), white, is_colour=b == COLOURS) for b in bands}
    parts = []
    for group in range(groups):
        facets = [
            _Facets.of(plan, layer, at[group], white, moments)
            for layer, moments in zip(plan.layers, filters, strict=True)
        ]
        for start in range(0, each, _POSES_AT_ONCE):
            some = slice(start, start + _POSES_AT_ONCE)
            ways = [
                (where[group, some], cosine[group, some])
                for where, cosine in zip(stand, (sight.cos_i, sight.cos_o), strict=True)
            ]
            parts.append(
                _colours(
                    facets,
                    sight.cos_h[group, some],
                    ways,
                    weighings,
                    has_base=plan.under == "base",
                    is_crossed=is_crossed,
                )
            )
    return LayerSamples(
        np.repeat(at, each),
        sight.cos_h.reshape(-1),
        sight.cos_i.reshape(-1),
        sight.cos_o.reshape(-1),
        _joined([truth for truth, _ in parts]),
        {b: _joined([found[b] for _, found in parts]) for b in bands},
        is_crossed,
    )


@dataclass(frozen=True, slots=True)
class _Facets:
    """One layer at one period.

    values : (terms, k) of R at `chebyshev_cosines`, by `rule`; filters : (pool, terms) from them to ∫ R F_α,
    and g1 : (pool, 1) of ∫ F_α, at the cosines of the pool; None of smooth layers.
    """

    plan: LayersPlan
    layer: PlannedLayer
    texel: Float64
    rule: ColourRule
    values: Float64
    filters: Float64 | None
    g1: Float64 | None

    @classmethod
    def of(
        cls, plan: LayersPlan, layer: PlannedLayer, texel: Float64, white: White, moments: Float64 | None
    ) -> _Facets:
        rule = layer_rule(plan, white)
        if moments is None:
            return cls(plan, layer, texel, rule, np.zeros((0, len(rule.wavelength_nm))), None, None)
        values = layer_spectra(plan, layer, texel, chebyshev_cosines(_TERMS), rule)
        return cls(plan, layer, texel, rule, values, moments @ to_coefficients(_TERMS), moments[:, :1])

    def reflected(self, cosine: Float64) -> Float64:
        """Return R (n, k)."""
        return layer_spectra(self.plan, self.layer, self.texel, cosine, self.rule)

    def passed(self, where: NDArray[np.intp], cosine: Float64) -> Float64:
        """Return T (n, k) at `cosine` (n,), those numbered `where` of the pool."""
        if self.filters is None or self.g1 is None:
            return 1.0 - self.reflected(cosine)
        return np.asarray(self.g1[where] - self.filters[where] @ self.values)


def _colours(
    facets: Sequence[_Facets],
    cos_h: Float64,
    ways: Sequence[tuple[NDArray[np.intp], Float64]],
    weighings: Mapping[int, Weighing],
    *,
    has_base: bool,
    is_crossed: bool,
) -> tuple[Terms, dict[int, Terms]]:
    """Return the truth, and what each weighing makes of it; `ways` : of light and viewer, for `passed`."""
    count = len(cos_h)
    # Those of all weighings side by side.
    shares = np.concatenate(
        [np.zeros((len(facets[0].rule.weights), 0)), *(w.shares for w in weighings.values())], 1
    )
    ends = np.cumsum([w.shares.shape[1] for w in weighings.values()])
    truth: list[Float64] = []
    found: dict[int, list[Float64]] = {b: [] for b in weighings}

    def put(spectra: Float64, means: Float64) -> None:
        truth.append(spectra @ facets[0].rule.weights)
        for (b, weighing), part in zip(weighings.items(), np.split(means, ends[:-1], axis=1), strict=False):
            found[b].append(part @ weighing.weights)

    through, means_through = np.ones((count, 1)), np.ones((count, shares.shape[1]))
    once, means_once = through, means_through
    for number, each in enumerate(facets):
        reflected = each.reflected(cos_h)
        put(reflected * through, (reflected @ shares) * means_through)
        if number == len(facets) - 1 and not (has_base or is_crossed):
            break
        for way, (where, cosine) in enumerate(ways):
            passed = each.passed(where, cosine)
            means = passed @ shares
            through, means_through = through * passed, means_through * means
            if way == 1 and is_crossed:
                once, means_once = once * passed, means_once * means
    if has_base:
        put(through, means_through)
    if is_crossed:
        put(once, means_once)
    # Nothing attenuates the first layer's reflection, whose colour is kept.
    return tuple(truth), {b: (truth[0], *terms[1:]) for b, terms in found.items()}


def _joined(parts: Sequence[Terms]) -> Terms:
    return tuple(np.concatenate(each) for each in zip(*parts, strict=True))
