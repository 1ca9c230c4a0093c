"""The shading inputs of one material's pixels, in float64, as flat arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN
from gltf_iri.rendering.frame import ShadingInputs
from gltf_iri.scene.model import Camera

__all__ = ["Pixels", "gather"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pixels:
    """What n pixels were shaded with; colours and vectors (n, 3), everything else (n,)."""

    position: Float64  # world, metres
    normal: Float64  # unit, turned towards the viewer
    view: Float64  # unit, towards the viewer
    n_dot_v: Float64
    alpha: Float64
    metallic: Float64
    base_color: Float64
    dielectric_f0: Float64
    specular_weight: Float64
    iridescence_factor: Float64
    thickness_nm: Float64
    reflected_radiance: Float64
    irradiance: Float64
    dfg_a: Float64
    dfg_b: Float64
    emission: Float64


def gather(inputs: ShadingInputs, mask: NDArray[np.bool_], camera: Camera) -> Pixels:
    """Return the pixels of `inputs` where `mask` (height, width) is set, with the camera's view of them."""

    def take(name: str) -> Float64:
        return np.asarray(getattr(inputs, name)[mask], dtype=np.float64)

    position, normal = take("position"), take("normal")
    view = _towards_viewer(camera, position)
    n_dot_v = np.sum(normal * view, axis=-1)
    return Pixels(
        position=position,
        normal=normal,
        view=view,
        # The lower clamp keeps the masking finite, the upper takes back the rounding of a unit vector.
        n_dot_v=np.clip(n_dot_v, N_DOT_V_MIN, 1.0),
        alpha=np.maximum(take("perceptual_roughness") ** 2, ALPHA_MIN),
        metallic=take("metallic"),
        # Interpolated vertex colours may overshoot by a float32 rounding; no reflectance exceeds 1.
        base_color=np.clip(take("base_color"), 0.0, 1.0),
        dielectric_f0=np.clip(take("dielectric_f0"), 0.0, 1.0),
        specular_weight=take("specular_weight"),
        iridescence_factor=take("iridescence_factor"),
        thickness_nm=np.maximum(take("iridescence_thickness_nm"), 0.0),  # filtering may round below 0
        reflected_radiance=take("reflected_radiance"),
        irradiance=take("irradiance"),
        dfg_a=take("dfg_a"),
        dfg_b=take("dfg_b"),
        emission=take("emission"),
    )


def _towards_viewer(camera: Camera, position: Float64) -> Float64:
    if camera.kind == "orthographic":
        # Every ray runs along the camera's own −Z; the viewer lies along its +Z, the third row of `view`.
        axis = camera.view[2, :3] / np.linalg.norm(camera.view[2, :3])
        return np.broadcast_to(axis, position.shape)
    towards = camera.position - position
    return np.asarray(towards / np.linalg.norm(towards, axis=-1, keepdims=True))
