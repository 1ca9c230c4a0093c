"""The film of a glTF material, evaluated without geometry, lights or textures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layering import (
    Layer,
    conductor_fresnel,
    iridescent_conductor_layer,
    iridescent_dielectric_layer,
    iridescent_dielectric_layer_specular,
)
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import ParameterValue

__all__ = ["MaterialFilm", "UnderFilm", "evaluate_material", "under_film"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class UnderFilm:
    """What lies under a material's film: F0 (3,) of its metal, and of its dielectric before its weight."""

    metal_f0: Float64
    dielectric_f0: Float64
    weight: float  # of the dielectric under the film: the specular factor where the layering puts it there


@dataclass(frozen=True, slots=True)
class MaterialFilm:
    """What a material's film reflects, and what it becomes in the material.

    film : the film's own reflectance at full strength; metal and dielectric mixed by metalness.
    layer : specular reflectance (..., 3) with the film's factor in it, and the base's weight (...) below it.
    thickness_nm : the thickness that was evaluated.
    thickness_range_nm : what the thickness texture's 0 and 1 stand for; without texture twice the maximum.
    factor : the film's strength in `layer`, which a texture may lower.
    """

    film: Evaluation
    layer: Layer
    thickness_nm: float
    thickness_range_nm: tuple[float, float]
    factor: float


def under_film(material: Material, plan: MaterialPlan) -> UnderFilm:
    """Return the bases under the film of `material` without its textures."""
    specular = material.specular or Specular()
    return UnderFilm(
        np.array(material.pbr.base_color_factor[:3]),
        np.minimum((material.ior or Ior()).f0 * np.array(specular.color_factor), 1.0),
        specular.factor if plan.layering == "specular" else 1.0,
    )


def evaluate_material(
    material: Material,
    plan: MaterialPlan,
    cos_theta: ArrayLike,
    *,
    thickness_nm: float | None = None,
    white: str = "D65",
    backend: str = "auto",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> MaterialFilm:
    """Evaluate the film of `material` by its plan's method, for light at V·H = `cos_theta` (...).

    Factors stand for their textures; the thickness is the maximum unless another is given. Raises UsageError
    where the plan has no film.
    """
    if material.iridescence is None or plan.method is None:
        raise UsageError(
            f"Material '{plan.name or plan.index}' has nothing to evaluate: {plan.method_reason}."
        )
    iridescence = material.iridescence
    thickness = iridescence.thickness_max_nm if thickness_nm is None else thickness_nm
    is_textured = plan.calls_for(Effect.IRIDESCENCE_THICKNESS_TEXTURE)
    at_zero_nm = iridescence.thickness_min_nm if is_textured else iridescence.thickness_max_nm
    metalness = material.pbr.metallic_factor
    cosine = np.asarray(cos_theta, dtype=np.float64)

    under = under_film(material, plan)
    dielectric_f0, metal_f0, weight = under.dielectric_f0, under.metal_f0, under.weight
    method, ior = plan.method, iridescence.film_ior
    over_dielectric, over_metal = (
        evaluate(
            method,
            Film.of(cosine, thickness, ior, base_from_f0(f0)),
            white=white,
            backend=backend,
            parameters=parameters,
        )
        for f0 in (weight * dielectric_f0, metal_f0)
    )

    plain = f_schlick(dielectric_f0, cosine[..., None])
    strength = np.full(cosine.shape, iridescence.factor)
    if plan.layering == "specular":
        layer = iridescent_dielectric_layer_specular(
            strength, np.full(cosine.shape, weight), plain, over_dielectric.rgb
        )
    else:
        layer = iridescent_dielectric_layer(strength, plain, over_dielectric.rgb)
    metal = iridescent_conductor_layer(strength, conductor_fresnel(metal_f0, cosine), over_metal.rgb)

    return MaterialFilm(
        film=_mixed(over_dielectric, over_metal, metalness),
        layer=Layer(_by_metalness(layer.specular, metal, metalness), (1.0 - metalness) * layer.base_weight),
        thickness_nm=thickness,
        thickness_range_nm=(at_zero_nm, iridescence.thickness_max_nm),
        factor=iridescence.factor,
    )


def _mixed(dielectric: Evaluation, metal: Evaluation, metalness: float) -> Evaluation:
    parts = [part for part, share in ((dielectric, 1.0 - metalness), (metal, metalness)) if share > 0.0]
    undefined: dict[str, NDArray[np.bool_]] = {}
    for part in parts:
        for case, mask in part.undefined.items():
            undefined[case] = undefined.get(case, np.zeros(mask.shape, dtype=np.bool_)) | mask
    rgb = _by_metalness(dielectric.rgb, metal.rgb, metalness)
    return replace(dielectric, rgb=rgb, undefined=undefined)


def _by_metalness(dielectric: Float64, metal: Float64, metalness: float) -> Float64:
    # A side without weight must not spread its undefined values: 0 · NaN is NaN.
    if metalness in (0.0, 1.0):
        return metal if metalness == 1.0 else dielectric
    return (1.0 - metalness) * dielectric + metalness * metal
