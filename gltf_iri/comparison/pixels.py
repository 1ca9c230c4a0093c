"""What one material's pixels were shaded with, in float64: the surface, and image light that reaches it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.bragg_limits import BRAGG_LAYERS_MAX
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.surface import Surface
from gltf_iri.rendering.frame import ShadingInputs
from gltf_iri.scene.model import Camera
from gltf_iri.tolerances import GLSL_PIXEL_ROUGHNESS_MIN

__all__ = ["ImageLight", "image_light_of_pixels", "is_rough", "surface_of_pixels"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class ImageLight:
    """Image light as it reached n pixels, occlusion included; colours (n, 3), everything else (n,)."""

    reflected_radiance: Float64  # prefiltered, along the mirror direction
    irradiance: Float64  # divided by π
    transmitted_radiance: Float64  # along the refracted direction, what the inside absorbs taken off
    clearcoat_radiance: Float64  # prefiltered, along the coat's mirror direction
    sheen_radiance: Float64  # prefiltered with the fibres' lobe
    dfg_a: Float64  # a rough mirror reflects F0·A + B
    dfg_b: Float64
    clearcoat_a: Float64  # the same at the coat's roughness
    clearcoat_b: Float64
    sheen_albedo: Float64  # what white fibres reflect
    facet_cosine: Float64  # the mean V·H of the facets that send it; 0 where no film asks for it
    layer_radiance: tuple[Float64, ...]  # prefiltered for each Bragg layer's lobe, outermost first
    layer_metal_radiance: Float64  # for that of a metal below them
    layer_coating_radiance: Float64  # along the mirror direction of their host's surface

    @property
    def is_there(self) -> Mask:
        """Where (n,) what the base's interface reflects of image light matters."""
        colours = (self.reflected_radiance, self.irradiance, self.transmitted_radiance, *self.layer_radiance)
        return np.asarray(np.any(np.concatenate(colours, axis=1) != 0.0, axis=1))


def surface_of_pixels(inputs: ShadingInputs, mask: Mask, camera: Camera) -> Surface:
    """Return the pixels of `inputs` where `mask` (height, width) is set, with the camera's view of them.

    The thickness of a volume is 0 here: what it absorbs has been taken off `ImageLight.transmitted_radiance`.
    """
    take = _Taker(inputs, mask)
    position, normal = take("position"), take("normal")
    view = _towards_viewer(camera, position)
    roughness = take("perceptual_roughness")
    return Surface(
        position=position,
        normal=normal,
        view=view,
        # The lower clamp keeps the masking finite, the upper takes back the rounding of a unit vector.
        n_dot_v=np.clip(np.sum(normal * view, axis=-1), N_DOT_V_MIN, 1.0),
        # Interpolated vertex colours may overshoot by a float32 rounding; no reflectance exceeds 1.
        base_color=np.clip(take("base_color"), 0.0, 1.0),
        metallic=take("metallic"),
        perceptual_roughness=roughness,
        alpha_roughness=alpha_ggx(roughness),
        emission=take("emission"),
        occlusion=np.ones_like(roughness),
        dielectric_f0=np.clip(take("dielectric_f0"), 0.0, 1.0),
        specular_weight=take("specular_weight"),
        iridescence_factor=take("iridescence_factor"),
        # Filtering may round below 0.
        iridescence_thickness_nm=np.maximum(take("iridescence_thickness_nm"), 0.0),
        iridescence_thickness_std_nm=take("iridescence_thickness_std_nm"),
        bragg_factor=np.clip(take("bragg_factor"), 0.0, 1.0),  # filtering may round past 1
        bragg_period_texel=take("bragg_period_texel"),
        anisotropy_strength=take("anisotropy_strength"),
        anisotropy_tangent=take("anisotropy_tangent"),
        transmission=take("transmission"),
        volume_thickness_m=np.zeros_like(roughness),
        sheen_color=take("sheen_color"),
        sheen_roughness=take("sheen_roughness"),
        clearcoat=take("clearcoat"),
        clearcoat_roughness=take("clearcoat_roughness"),
        clearcoat_normal=take("clearcoat_normal"),
    )


def image_light_of_pixels(inputs: ShadingInputs, mask: Mask) -> ImageLight:
    """Return the image light of the pixels of `inputs` where `mask` (height, width) is set."""
    take = _Taker(inputs, mask)
    albedos = take("layer_albedos")
    return ImageLight(
        reflected_radiance=take("reflected_radiance"),
        irradiance=take("irradiance"),
        transmitted_radiance=take("transmitted_radiance"),
        clearcoat_radiance=take("clearcoat_radiance"),
        sheen_radiance=take("sheen_radiance"),
        dfg_a=take("dfg_a"),
        dfg_b=take("dfg_b"),
        clearcoat_a=albedos[:, 0],
        clearcoat_b=albedos[:, 1],
        sheen_albedo=albedos[:, 2],
        facet_cosine=take("facet_cosine"),
        layer_radiance=tuple(take(f"bragg_radiance_{layer}") for layer in range(BRAGG_LAYERS_MAX)),
        layer_metal_radiance=take("bragg_metal_radiance"),
        layer_coating_radiance=take("bragg_coating_radiance"),
    )


def is_rough(inputs: ShadingInputs, plans: Sequence[MaterialPlan]) -> Mask:
    """Return where (height, width) every lobe of facets is rough enough to be judged.

    The coat's lobe counts, and those of Bragg layers, whose host is as smooth as can be where it is not air.
    """
    least = np.float32(GLSL_PIXEL_ROUGHNESS_MIN)
    coat = (inputs.clearcoat_roughness >= least) | (inputs.clearcoat == 0.0)
    smooth = [
        slot
        for slot, plan in enumerate(plans)
        if plan.layers is not None
        and (
            plan.layers.host_ior != 1.0
            or min(layer.alpha for layer in plan.layers.layers) < GLSL_PIXEL_ROUGHNESS_MIN**2
        )
    ]
    return np.asarray((inputs.perceptual_roughness >= least) & coat & ~np.isin(inputs.material, smooth))


@dataclass(frozen=True, slots=True)
class _Taker:
    inputs: ShadingInputs
    mask: Mask

    def __call__(self, name: str) -> Float64:
        return np.asarray(getattr(self.inputs, name)[self.mask], dtype=np.float64)


def _towards_viewer(camera: Camera, position: Float64) -> Float64:
    if camera.kind == "orthographic":
        # Every ray runs along the camera's own −Z; the viewer lies along its +Z, the third row of `view`.
        axis = camera.view[2, :3] / np.linalg.norm(camera.view[2, :3])
        return np.broadcast_to(axis, position.shape)
    towards = camera.position - position
    return np.asarray(towards / np.linalg.norm(towards, axis=-1, keepdims=True))
