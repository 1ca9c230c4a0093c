"""Method `layers-mc`: rough Bragg layers by position-free Monte-Carlo, all reflections among them included.

Fourneau et al. 2024, §4.2, both as their plain reference (`transmission="facets"`) and with tabulated
transmissivities ("table"); `layers_walk` says how. With one wavelength a path ("single") or all of them on
every path ("multiplexed"). `max_reflections=1` is the model of `layers-single`: reflections are those at
layers and base, and not the coating's own, inside. The same seed gives the same result.

What is not simulated: polarisation along a path, scattering from facet to facet of one layer, and behind
layers whose n1 is not the host's the directions inside, which a diffuse base forgets (total reflection there
sends all of the light back to the base).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layers import LayerStack, Pose, coating_reflectance
from gltf_iri.reference.layers_facets import StackFacets
from gltf_iri.reference.layers_tally import Bins, DirectionTally, Moments, Sampled, ViewerTally
from gltf_iri.reference.layers_walk import FATES, Transmission, Walk

__all__ = ["EVEN_BINS", "LayersEstimate", "Spectrum", "simulate", "simulate_brdf"]

Float64 = NDArray[np.float64]
Spectrum = Literal["multiplexed", "single"]

# Numbers that a block of paths holds at once in its largest array.
_VALUES_AT_ONCE: Final = 1 << 21

EVEN_BINS: Final = Bins()


@dataclass(frozen=True, slots=True)
class LayersEstimate:
    """What `paths` paths found; C is 3 where weights made colours, else the number of wavelengths.

    values : shares of the light's power that leave into each bin (cosines, turns, C), or f_r (M, C), 1/sr.
    balance : (C,) of where the light's power goes: "mirrored" by the coating outside, not a part of `values`;
        "reflected" by layers and base; absorbed by the "base" (all that passes through layers over a black
        one); "masked" by facets; "cut" at max_reflections; "lost" with paths given up. Sums to 1.
    """

    values: Sampled
    balance: Mapping[str, Sampled]
    paths: int


def simulate(
    stack: LayerStack,
    cos_theta_i: float,
    *,
    paths: int,
    rng: np.random.Generator,
    wavelength_nm: ArrayLike,
    weights: ArrayLike | None = None,
    bins: Bins = EVEN_BINS,
    transmission: Transmission = "table",
    spectrum: Spectrum = "multiplexed",
    max_reflections: int | None = None,
) -> LayersEstimate:
    """Return how light from cos_theta_i spreads over outgoing directions; no BRDF's formula is used.

    stack : one stack; UsageError for stacks of arrays.
    wavelength_nm : (W,); weights : (W, 3) whose columns sum to 1, of a colour rule; without them each
        wavelength is reported, and UsageError where the base is coloured.
    paths : in all; with "single" every wavelength gets its share, one at least.
    """
    pose = Pose.of(cos_theta_i, 1.0)
    setting = _Setting.of(stack, pose, paths, wavelength_nm, weights, transmission, max_reflections)
    runs = [
        (part, setting.run(part, DirectionTally(bins, part.sensor.shape[1]), rng))
        for part in setting.parts(spectrum)
    ]
    return setting.joined(runs)


def simulate_brdf(
    stack: LayerStack,
    pose: Pose,
    *,
    paths: int,
    rng: np.random.Generator,
    wavelength_nm: ArrayLike,
    weights: ArrayLike | None = None,
    transmission: Transmission = "table",
    spectrum: Spectrum = "multiplexed",
    max_reflections: int | None = None,
) -> LayersEstimate:
    """Return f_r at poses of one light and M viewers, by next-event estimation at every reflection.

    What reflects first and is not covered comes without noise. Arguments as for `simulate`; UsageError where
    the pose has more than one light.
    """
    setting = _Setting.of(stack, pose, paths, wavelength_nm, weights, transmission, max_reflections)
    runs = [
        (part, setting.run(part, ViewerTally(part.facets, pose, part.channels, transmission), rng))
        for part in setting.parts(spectrum)
    ]
    return setting.joined(runs)


@dataclass(frozen=True, slots=True)
class _Part:
    """Paths that carry the same wavelengths. `sensor` (W, C); `into` (C or 1, channels of the result)."""

    facets: StackFacets
    paths: int
    sensor: Float64
    shares: Float64
    channels: NDArray[np.intp]
    into: Float64


@dataclass(frozen=True, slots=True)
class _Setting:
    facets: StackFacets
    cos_theta_i: float
    paths: int
    weights: Float64 | None
    transmission: Transmission
    max_reflections: int | None

    @classmethod
    def of(
        cls,
        stack: LayerStack,
        pose: Pose,
        paths: int,
        wavelength_nm: ArrayLike,
        weights: ArrayLike | None,
        transmission: Transmission,
        max_reflections: int | None,
    ) -> _Setting:
        wavelengths = np.atleast_1d(np.asarray(wavelength_nm, np.float64))
        if wavelengths.ndim != 1 or not np.all(wavelengths > 0.0):
            raise UsageError("The wavelengths of a simulation are a list of positive numbers, in nanometres.")
        if np.size(pose.cos_theta_i) != 1:
            raise UsageError("One light is simulated at a time: give one number for cos_theta_i.")
        if paths < 1 or (max_reflections is not None and max_reflections < 1):
            raise UsageError("A simulation wants at least one path, and at least one reflection.")
        colour = None if weights is None else np.asarray(weights, np.float64)
        if colour is not None and colour.shape != (len(wavelengths), 3):
            raise UsageError(
                f"The weights of {len(wavelengths)} wavelengths have the shape ({len(wavelengths)}, 3)."
            )
        facets = StackFacets(stack, wavelengths)
        base = stack.base
        if colour is None and (np.ptp(base.diffuse) > 0.0 or np.ptp(base.metal_f0) > 0.0):
            raise UsageError("A coloured base has no spectrum: give the weights of a colour rule.")
        light = float(np.ravel(pose.cos_theta_i)[0])
        return cls(facets, light, paths, colour, transmission, max_reflections)

    def parts(self, spectrum: Spectrum) -> list[_Part]:
        """Return the sets of paths to run, by what they carry."""
        count = len(self.facets.wavelength_nm)
        weights, channels = self.weights, np.arange(3)
        if spectrum == "multiplexed":
            even = np.full(count, 1.0 / count)
            if weights is None:
                return [
                    _Part(
                        self.facets, self.paths, np.eye(count), even, np.zeros(count, np.intp), np.eye(count)
                    )
                ]
            # Half of the mean goes by what the colours see, half evenly: no wavelength is forgotten.
            seen = np.abs(weights).sum(axis=1)
            shares = 0.5 * even + 0.5 * seen / seen.sum()
            return [_Part(self.facets, self.paths, weights, shares, channels, np.eye(3))]
        each = max(1, self.paths // count)
        made = []
        for number in range(count):
            into = np.eye(count)[number : number + 1] if weights is None else np.diag(weights[number])
            of = channels[: len(into)]
            made.append(_Part(self.facets.at(number), each, np.ones((1, len(into))), np.ones(1), of, into))
        return made

    def run(self, part: _Part, tally: DirectionTally | ViewerTally, rng: np.random.Generator) -> _Run:
        """Walk `part.paths` paths in blocks."""
        width = max(part.sensor.shape[0], part.sensor.shape[1])
        if isinstance(tally, ViewerTally):
            width *= tally.viewers
        at_once = max(1, _VALUES_AT_ONCE // width)
        fates = {fate: Moments((part.sensor.shape[1],)) for fate in FATES}
        for start in range(0, part.paths, at_once):
            count = min(at_once, part.paths - start)
            walk = Walk(
                *(part.facets, self.cos_theta_i, count, rng),
                sensor=part.sensor,
                shares=part.shares,
                base_channels=part.channels,
                transmission=self.transmission,
                max_reflections=self.max_reflections,
            )
            tally.begin(count)
            walk.run([tally])
            tally.end(count)
            for fate, moments in fates.items():
                spent = walk.spent[fate]
                moments.add(spent.sum(axis=0), (spent * spent).sum(axis=0), count)
        return _Run(tally.moments.sampled(), {fate: moments.sampled() for fate, moments in fates.items()})

    def joined(self, runs: list[tuple[_Part, _Run]]) -> LayersEstimate:
        """Return the sum of all parts: independent, so that squared errors add."""
        values = _summed([(part.into, run.values) for part, run in runs])
        balance = {fate: _summed([(part.into, run.fates[fate]) for part, run in runs]) for fate in FATES}
        mirrored = float(coating_reflectance(self.facets.stack.host_ior, self.cos_theta_i))
        channels = values.mean.shape[-1]
        balance["mirrored"] = Sampled(np.full(channels, mirrored), np.zeros(channels))
        return LayersEstimate(values, balance, sum(part.paths for part, _ in runs))


@dataclass(frozen=True, slots=True)
class _Run:
    values: Sampled
    fates: Mapping[str, Sampled]


def _summed(terms: list[tuple[Float64, Sampled]]) -> Sampled:
    mean = sum(term.mean @ into for into, term in terms)
    squared = sum(term.error**2 @ (into * into) for into, term in terms)
    return Sampled(np.asarray(mean), np.sqrt(np.asarray(squared)))
