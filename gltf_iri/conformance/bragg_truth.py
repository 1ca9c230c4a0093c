"""What a row of EXT_materials_bragg must give: spectra, colours and BRDFs, converged."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.conformance.bragg_input import BraggInput
from gltf_iri.conformance.facet_sum import Passing
from gltf_iri.conformance.spectral_sum import NotSettledError, Spectra, colour_sum
from gltf_iri.material.ior import Ior
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_stack import Sight, coating_transmittance, sight_of
from gltf_iri.optics.microfacet import d_ggx, v_smith_ggx_correlated
from gltf_iri.optics.rough_bragg import facet_weight

__all__ = ["VALUES_MAX", "WAVELENGTHS_NM", "bragg_outputs"]

Float64 = NDArray[np.float64]

WAVELENGTHS_NM: Final = (450.0, 550.0, 650.0)

# Reflectances that one row may ask for: a second of them, compiled.
VALUES_MAX: Final = 5e7


def bragg_outputs(
    row: BraggInput, backend: Backend = "numpy", values_max: float = VALUES_MAX
) -> dict[str, Any]:
    """Return the outputs of a row, unrounded: numbers, lists of them, or None where there is no such number.

    values_max : reflectances of facets that may be asked for, before a row counts as not settled.
    Raises NotSettledError where wavelengths or angles do not converge.
    """
    # The core material's facets meet light and viewer outside, those of layers both as they are in the host.
    core = _core_brdf(row, sight_of(1.0, row.cos_theta_i, row.cos_theta_o, row.cos_phi))
    if not row.facets:
        nothing = ("base_colour", "entering", "transmitted", "coating_reflectance", "stack_brdf")
        lists: dict[str, Any] = {"reflectance": [], "transmittance": [], "layer_colours": []}
        return {**lists, **dict.fromkeys(nothing), "brdf": core.tolist()}
    sight = sight_of(row.host_ior, row.cos_theta_i, row.cos_theta_o, row.cos_phi)
    ways = np.array([sight.cos_i, sight.cos_o])
    passing = [Passing(facets, ways, backend) for facets in row.facets]
    fixed_nm = np.array(WAVELENGTHS_NM)
    reflectance = [facets.reflectance(fixed_nm, sight.cos_h[None])[0] for facets in row.facets]
    colours = _colours(row, passing, sight, backend, values_max)
    into = [float(coating_transmittance(row.host_ior, c)) for c in (row.cos_theta_i, row.cos_theta_o)]
    glass = (1.0 - row.metallic) * row.transmission * row.base_colour
    stack = None if row.is_smooth else _stack_brdf(row, sight, colours)
    mixed = stack if stack is None else (1.0 - row.bragg) * core + row.bragg * stack
    if row.bragg == 0.0:
        mixed = core
    return {
        "reflectance": [each.tolist() for each in reflectance],
        "transmittance": [each.transmittance(fixed_nm)[0].tolist() for each in passing],
        "layer_colours": colours[:-2].tolist(),
        "base_colour": colours[-2].tolist(),
        "entering": colours[-1].tolist(),
        "transmitted": (into[1] * glass * colours[-1]).tolist(),
        "coating_reflectance": 1.0 - into[0],
        "stack_brdf": None if stack is None else stack.tolist(),
        "brdf": None if mixed is None else mixed.tolist(),
    }


def _colours(
    row: BraggInput, passing: list[Passing], sight: Sight, backend: Backend, values_max: float
) -> Float64:
    """Return the colours (l + 2, 3): of each layer (C_l), of the base below them (C_b), of what enters."""
    cos_h = sight.cos_h[None]

    def first(wavelength_nm: Float64) -> Float64:
        return row.facets[0].reflectance(wavelength_nm, cos_h, backend)

    def others(wavelength_nm: Float64) -> Float64:
        spectra, both, out = [], np.ones(len(wavelength_nm)), np.ones(len(wavelength_nm))
        for facets, each in zip(row.facets, passing, strict=True):
            spectra.append(facets.reflectance(wavelength_nm, cos_h, backend)[0] * both)
            way_in, way_out = each.transmittance(wavelength_nm)
            both, out = both * way_in * way_out, out * way_out
        return np.stack([*spectra[1:], both, out])

    angles = sum(each.angles for each in passing)
    return np.concatenate([colour_sum(first), colour_sum(_within(others, angles, values_max))])


def _within(spectra: Spectra, angles: int, values_max: float) -> Spectra:
    """Return `spectra`, which give up where they are asked for too much."""
    asked = 0

    def counted(wavelength_nm: Float64) -> Float64:
        nonlocal asked
        asked += len(wavelength_nm) * angles
        if asked > values_max:
            raise NotSettledError("What passes the layers wants too many wavelengths and angles.")
        return spectra(wavelength_nm)

    return counted


def _stack_brdf(row: BraggInput, sight: Sight, colours: Float64) -> Float64:
    """f_r = T_c(i) T_c(o)/n_h² (Σ_l w_l(h) C_l + C_b f_b), Fourneau et al. 2024, Eq. 34."""
    sent = np.zeros(3)
    for facets, colour in zip(row.facets, colours[:-2], strict=True):
        sent += facet_weight(sight.n_cross_h_squared, sight.cos_i, sight.cos_o, facets.alpha) * colour
    bent = (row.host_ior / row.facets[-1].n1) ** 2
    diffuse = (1.0 - row.metallic) * (1.0 - row.transmission) * row.base_colour / np.pi * bent
    metal = np.zeros(3)
    if row.metallic > 0.0:
        lobe = facet_weight(sight.n_cross_h_squared, sight.cos_i, sight.cos_o, row.base_alpha)
        metal = row.metallic * lobe * f_schlick(row.base_colour, sight.cos_h)
    return np.asarray(sight.passage * (sent + colours[-2] * (diffuse + metal)))


def _core_brdf(row: BraggInput, sight: Sight) -> Float64:
    """The core material's own BRDF, glTF 2.0 Appendix B: fresnel_mix of index 1.5, mixed with the metal."""
    lobe = d_ggx(sight.n_cross_h_squared, row.base_alpha)
    lobe = lobe * v_smith_ggx_correlated(row.cos_theta_i, row.cos_theta_o, row.base_alpha)
    diffuse = (1.0 - row.transmission) * row.base_colour / np.pi
    fresnel = f_schlick(Ior().f0, sight.cos_h)
    dielectric = (1.0 - fresnel) * diffuse + fresnel * lobe
    metal = lobe * f_schlick(row.base_colour, sight.cos_h)
    return np.asarray((1.0 - row.metallic) * dielectric + row.metallic * metal)
