"""Rows of KHR_materials_iridescence: films as inputs, and by the text, by the guarded text and in truth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.conformance.bragg_draw import drawn_number
from gltf_iri.conformance.bragg_truth import WAVELENGTHS_NM
from gltf_iri.conformance.spectral_sum import colour_sum
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.khr import evaluate_khr, khr_branch_distance_ulp
from gltf_iri.evaluation.khr_guarded import evaluate_khr_guarded
from gltf_iri.evaluation.spectral import film_spectrum

__all__ = ["KHR_CASES", "draw_khr", "khr_film", "khr_outputs"]

Float64 = NDArray[np.float64]
Inputs = dict[str, Any]

# No float32 reading of a row falls on the other side of a branch of the text.
_BRANCH_ULP: Final = 1e4

_GOLD: Final = {"base_f0": [1.0, 0.71, 0.29]}
_GLASS: Final = {"base_ior": 1.5}

# Words, and what is fixed; the rest is drawn.
KHR_CASES: Final[tuple[tuple[str, Inputs], ...]] = (
    ("thickness 0: the bare base", {"thickness_nm": 0.0, **_GLASS}),
    ("thickness 0 on a metal", {"thickness_nm": 0.0, "base_f0": [0.9, 0.7, 0.4]}),
    ("a nanometre", {"thickness_nm": 1.0, **_GLASS}),
    ("the film has the base's index: it is not seen", {"film_ior": 1.5, **_GLASS}),
    ("the film has the outside's index: it is not seen", {"film_ior": 1.0, **_GLASS}),
    ("the film has the outside's index, on a metal", {"film_ior": 1.0, "base_f0": [0.9, 0.7, 0.4]}),
    ("film, base and outside have one index: nothing is mirrored", {"film_ior": 1.0, "base_ior": 1.0}),
    ("F0 = 1 in red: the text divides by zero or turns negative", _GOLD),
    ("F0 = 1 in all channels: a perfect mirror", {"base_f0": [1.0, 1.0, 1.0]}),
    ("F0 = 0.9999: the text's pole", {"base_f0": [0.9999, 0.5, 0.5]}),
    ("F0 = 0.99", {"base_f0": [0.99, 0.99, 0.99]}),
    ("F0 = 0: the base has the outside's index", {"base_f0": [0.0, 0.0, 0.0]}),
    ("one channel of F0 is 0", {"base_f0": [0.0, 0.3, 0.6]}),
    ("grazing light, cosine 0", {"cos_theta_1": 0.0, **_GLASS}),
    ("grazing light, cosine 0, on a metal", {"cos_theta_1": 0.0, "base_f0": [0.9, 0.7, 0.4]}),
    ("nearly grazing light", {"cos_theta_1": 0.01, **_GLASS}),
    ("along the normal", {"cos_theta_1": 1.0, **_GLASS}),
    ("along the normal, on a metal", {"cos_theta_1": 1.0, "base_f0": [0.9, 0.7, 0.4]}),
    ("the defaults of glTF: 1.3 and 400 nm on glass", {"film_ior": 1.3, "thickness_nm": 400.0, **_GLASS}),
    ("a thin film, 100 nm", {"thickness_nm": 100.0, **_GLASS}),
    ("a thick film, 5 µm", {"thickness_nm": 5000.0, **_GLASS}),
    ("a thick film, 5 µm, on a metal", {"thickness_nm": 5000.0, "base_f0": [0.9, 0.7, 0.4]}),
    ("a soap bubble: air behind the film", {"film_ior": 1.33, "base_ior": 1.0}),
    ("a film denser than its base", {"film_ior": 2.2, **_GLASS}),
    ("a film lighter than its base", {"film_ior": 1.3, "base_ior": 2.4}),
    ("oil on water", {"film_ior": 1.47, "base_ior": 1.33}),
)


def draw_khr(number: int, g: np.random.Generator) -> tuple[str | None, Inputs, Mapping[str, Any]]:
    """Return the case in words, inputs and outputs of row `number`."""
    case, fixed = KHR_CASES[number] if number < len(KHR_CASES) else (None, {})
    while True:
        inputs = {**_random(number, g), **fixed}
        if "base_f0" in fixed:
            inputs.pop("base_ior", None)
        if "base_ior" in fixed:
            inputs.pop("base_f0", None)
        distance = khr_branch_distance_ulp(khr_film(inputs))
        # Equal indices are equal in every precision.
        if "film_ior" in fixed or distance >= _BRANCH_ULP:
            return case, inputs, khr_outputs(inputs)


def _random(number: int, g: np.random.Generator) -> Inputs:
    inputs: Inputs = {
        "outside_ior": 1.0,
        "film_ior": drawn_number(g, 1.1, 2.2),
        "thickness_nm": drawn_number(g, 100.0, 800.0, 1) if number % 4 else drawn_number(g, 0.0, 2000.0, 1),
        "cos_theta_1": drawn_number(g, 0.05, 1.0),
    }
    if number % 2:
        return inputs | {"base_ior": drawn_number(g, 1.2, 2.5)}
    return inputs | {"base_f0": [drawn_number(g, 0.02, 0.98) for _ in range(3)]}


def khr_film(inputs: Mapping[str, Any]) -> Film:
    """Return the film of a row's inputs; a base of F0 has a real index for each channel."""
    base = base_from_f0(inputs["base_f0"]) if "base_f0" in inputs else base_from_ior(inputs["base_ior"])
    cosine, thickness_nm, film_ior = (inputs[name] for name in ("cos_theta_1", "thickness_nm", "film_ior"))
    return Film.of(cosine, thickness_nm, film_ior, base, inputs["outside_ior"])


def khr_outputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return the outputs of a row, unrounded; "khr" is None where the text gives no number.

    Raises NotSettledError where the truth does not converge.
    """
    film = khr_film(inputs)
    text = evaluate_khr(film, "D65")
    # x·x stands for pow(x, 2.0): where that is all that is undefined, the text has a number.
    poles = [reason for reason in text.undefined if reason.startswith("Fresnel0ToIor")]

    def channels(wavelength_nm: Float64) -> Float64:
        return film_spectrum(film, wavelength_nm)

    truth = np.diagonal(colour_sum(channels))
    khr = None if poles else text.rgb.tolist()
    undefined = {"undefined": "; ".join(poles)} if poles else {}
    difference = None if poles else float(delta_e_2000(text.rgb, truth))
    return {
        "reflectance": film_spectrum(film, np.array(WAVELENGTHS_NM)).T.tolist(),
        "truth": truth.tolist(),
        "khr": khr,
        "khr_guarded": evaluate_khr_guarded(film, "D65").rgb.tolist(),
        "khr_delta_e": difference,
        **undefined,
    }
