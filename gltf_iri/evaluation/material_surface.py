"""The surface of a glTF material without film and layers, as numbers: its BRDF and what it sends back.

Metal and dielectric of glTF 2.0 Appendix B with KHR_materials_ior and _specular, less what
KHR_materials_transmission lets through, by factors alone; facets are isotropic, and nothing lies above.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.evaluation.layers import Pose
from gltf_iri.evaluation.material_film import UnderFilm, under_film
from gltf_iri.material.material import Material
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layer_lobe import lobe_nodes
from gltf_iri.optics.layer_stack import half_vector, sight_of
from gltf_iri.optics.layering import Layer, rgb_mix
from gltf_iri.optics.microfacet import alpha_ggx, d_ggx, v_smith_ggx_correlated
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["surface_albedo", "surface_brdf", "transmitting_share"]

Float64 = NDArray[np.float64]

# Gauss points over cosines and turns of what a diffuse base sends: 1e-6 of it.
_COSINES = 48
_TURNS = 48


def transmitting_share(material: Material, plan: MaterialPlan) -> float:
    """Return the transmission factor of `material`; 0 where the plan lets nothing through."""
    if material.transmission is None or not plan.calls_for(Effect.TRANSMISSION):
        return 0.0
    return material.transmission.factor


def surface_brdf(material: Material, plan: MaterialPlan, pose: Pose) -> Float64:
    """Return f_r (..., 3), 1/sr, of light from the front.

    f = (1 − m)((1 − t) w c/π + F V D) + m F_m V D, w = 1 − max F (glTF 2.0 Appendix B.3.4; the texts of
    KHR_materials_specular and _transmission), F at the facets' own angle.
    """
    sight = sight_of(1.0, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)
    alpha = alpha_ggx(material.pbr.roughness_factor)
    facets = d_ggx(sight.n_cross_h_squared, alpha)
    # Both grazing, light and viewer meet no facet: 0/0 there.
    is_met = sight.cos_i + sight.cos_o > 0.0
    cos_i = np.where(is_met, sight.cos_i, 1.0)
    seen = np.where(is_met, facets * v_smith_ggx_correlated(cos_i, sight.cos_o, alpha), 0.0)
    layer, metal = _reflectances(under_film(material, plan), sight.cos_h)
    m = material.pbr.metallic_factor
    specular = (1.0 - m) * layer.specular + m * metal
    diffuse = _below(material, plan) / np.pi
    return np.asarray(layer.base_weight[..., None] * diffuse + specular * seen[..., None])


def surface_albedo(material: Material, plan: MaterialPlan, cos_theta: ArrayLike) -> Float64:
    """Return ∫ f_r cosθ_o dω_o (..., 3) of light at `cos_theta` (...), in [0, 1].

    The lobe's nodes are those of facets that mask light and viewer apart; the correlated masking is
    1/(G₁(i) + G₁(o) − G₁(i)G₁(o)) of that, since G₁ = 1/(1 + Λ).
    """
    cosine, m = np.asarray(cos_theta, np.float64), material.pbr.metallic_factor
    alpha, under = alpha_ggx(material.pbr.roughness_factor), under_film(material, plan)
    nodes = lobe_nodes(cosine, alpha)
    g_i, g_o = g1_smith(cosine, alpha)[..., None], g1_smith(nodes.cos_o, alpha)
    weights = nodes.weights / (g_i + g_o - g_i * g_o)
    layer, metal = _reflectances(under, nodes.cos_h)
    sent = np.einsum("...q,...qc->...c", weights, (1.0 - m) * layer.specular + m * metal)
    diffuse = _below(material, plan)
    if diffuse.any():
        t, over_t = gauss_unit(_COSINES)
        turn, over_turn = gauss_unit(_TURNS)
        # c = t² of cosines, and the turn between light and viewer over half its circle.
        cos_o, share = (t * t)[:, None], (4.0 * t**3 * over_t)[:, None] * over_turn
        cos_h, _ = half_vector(cosine[..., None, None], cos_o, 1.0 + np.cos(np.pi * turn))
        weight = _reflectances(under, cos_h)[0].base_weight
        sent = sent + diffuse * np.einsum("ot,...ot->...", share, weight)[..., None]
    return np.asarray(sent)


def _reflectances(under: UnderFilm, cosine: Float64) -> tuple[Layer, Float64]:
    """Return the dielectric's layer over its base and the metal's reflectance, met at `cosine` (...)."""
    plain = under.weight * f_schlick(under.dielectric_f0, cosine[..., None])
    return rgb_mix(plain), np.asarray(f_schlick(under.metal_f0, cosine[..., None]))


def _below(material: Material, plan: MaterialPlan) -> Float64:
    """Return the colour (3,) of the Lambertian base below the dielectric's surface."""
    pbr = material.pbr
    share = (1.0 - pbr.metallic_factor) * (1.0 - transmitting_share(material, plan))
    return share * np.array(pbr.base_color_factor[:3])
