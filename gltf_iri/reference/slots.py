"""A material's texture slots: which texture, where on it, in which colour space, which channels."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.interface import SAMPLERS
from gltf_iri.material.texture import TextureInfo
from gltf_iri.planning.effects import Effect
from gltf_iri.reference.stage import Stage
from gltf_iri.reference.texture import sample

__all__ = ["sample_slot", "texture_of", "uv_set_of"]

Float64 = NDArray[np.float64]

_SAMPLER_OF: Final = {sampler.slot: sampler for sampler in SAMPLERS}
_CHANNEL: Final = {channel: place for place, channel in enumerate("rgba")}


def texture_of(stage: Stage, slot: int, name: str) -> TextureInfo | None:
    """Return the texture `name` ("base_color", …) of a material; None where its plan does not call for it.

    `slot` is a place among the stage's plans.
    """
    if not stage.plans[slot].calls_for(Effect[f"{name.upper()}_TEXTURE"]):
        return None
    return _SAMPLER_OF[name].read(stage.materials[slot])


def uv_set_of(info: TextureInfo) -> int:
    """Return which of the two sets that are read a texture takes: as in the shader, 1 for all but 0."""
    return 0 if info.uv_set == 0 else 1


def sample_slot(stage: Stage, slot: int, name: str, uv: Float64) -> Float64 | None:
    """Return the channels (n, k) that the texture `name` is read for, or None as `texture_of` does.

    uv : (n, 2, 2), both sets. The coordinates of its UV set are transformed first (KHR_texture_transform).
    """
    info = texture_of(stage, slot, name)
    if info is None:
        return None
    row = _SAMPLER_OF[name].row
    matrix = np.asarray(info.uv_matrix)
    place = uv[:, uv_set_of(info)] @ matrix[:2, :2].T + matrix[:2, 2]
    texel = sample(stage.textures[info.texture], place, is_srgb=row.colour_space == "srgb")
    return np.asarray(texel[:, [_CHANNEL[channel] for channel in row.channels]])
