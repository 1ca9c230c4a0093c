"""The single-reflection model at single wavelengths: its own sum, Eq. 34, of the truth's own spectra."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.reference.layers_tally import Bins

# Fourneau et al. 2024, Fig. 7.
A = BraggLayer.of(1.0, 1.5, 250.0, 250.0, 10, 0.1)
B = BraggLayer.of(1.0, 1.5, 494.0, 494.0, 10, 0.05)
COATED = BraggLayer.of(1.35, 1.5, 250.0, 250.0, 10, 0.1)
ROUGH = BraggLayer.of(1.0, 1.5, 150.0, 120.0, 3, 0.4)
BEETLE = BraggLayer.of(1.59, 1.67, 93.1, 96.9, 8, 0.05)  # Table 3, green

STACKS = {
    "A on B": LayerStack.of((A, B)),
    "A on grey": LayerStack.of((A,), 1.0, LayerBase.of(0.5)),
    "A under a coating on grey": LayerStack.of((COATED,), 1.35, LayerBase.of(0.5)),
    "rough on A on metal": LayerStack.of((ROUGH, A), 1.0, LayerBase.of(0.2, 0.8, 0.5, 0.3)),
    "beetle on white": LayerStack.of((BEETLE,), 1.0, LayerBase.of(0.9)),
}


def sidak_z(samples: int, family: float = 0.01) -> float:
    """Return the greatest |z| of `samples` independent normal samples at a family-wise error `family`."""
    return NormalDist().inv_cdf(1.0 - 0.5 * (1.0 - (1.0 - family) ** (1.0 / samples)))


@dataclass(frozen=True)
class ThreeWavelengths:
    """`LayerColours` whose three channels are three wavelengths; `passage` puts T off by a factor."""

    stack: LayerStack
    wavelength_nm: np.ndarray
    passage: float = 1.0

    def reflected(self, layer: int, cos_h: np.ndarray, cos_i: np.ndarray, cos_o: np.ndarray) -> np.ndarray:
        values = self._spectra(layer).reflectance(np.ravel(cos_h), self.wavelength_nm)
        return self._product(layer, cos_i, cos_o, values.reshape(*np.shape(cos_h), 3))

    def passed(self, cos_i: np.ndarray, cos_o: np.ndarray) -> np.ndarray:
        return self._product(len(self.stack.layers), cos_i, cos_o, np.ones(3))

    def _product(self, above: int, cos_i: np.ndarray, cos_o: np.ndarray, values: np.ndarray) -> np.ndarray:
        for layer in range(above):
            for cosine in (cos_i, cos_o):
                values = values * self.passage * self._passed(layer, np.asarray(cosine))
        return values

    def _passed(self, layer: int, cosine: np.ndarray) -> np.ndarray:
        key = (id(self.stack), layer, cosine.tobytes(), self.wavelength_nm.tobytes())
        if key not in PASSED:
            values = self._spectra(layer).transmissivity(cosine.ravel(), self.wavelength_nm)
            # The stack is kept too, so that no other takes its place.
            PASSED[key] = self.stack, values.reshape(*cosine.shape, 3)
        return PASSED[key][1]

    def _spectra(self, layer: int) -> LayerSpectra:
        return LayerSpectra(self.stack.layers[layer], float(self.stack.host_ior))


PASSED: dict[object, tuple[LayerStack, np.ndarray]] = {}


def binned_model(
    stack: LayerStack,
    cos_i: float,
    wavelength_nm: np.ndarray,
    bins: Bins,
    *,
    passage: float = 1.0,
    gauss: int = 24,
) -> np.ndarray:
    """Return ∫ f_r cosθ_o dω_o (cosines, turns, 3) over each bin of outgoing directions, by quadrature."""
    nodes, weights = gauss_unit(gauss)
    cosine = ((np.arange(bins.cosines)[:, None] + nodes) / bins.cosines)[:, None, :, None]
    turn = ((np.arange(bins.turns)[:, None] + nodes) / bins.turns * np.pi)[None, :, None, :]
    pose = Pose.of(cos_i, cosine, np.cos(turn))
    sent = brdf(stack, pose, ThreeWavelengths(stack, wavelength_nm, passage)) * cosine[..., None]
    # Both senses of the turn are one bin.
    area = 2.0 * np.pi / (bins.cosines * bins.turns)
    return area * np.einsum("stabc,a,b->stc", sent, weights, weights)
