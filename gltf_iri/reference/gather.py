"""From points on triangles to what the material is there: `gather_surface` of the shader, in float64.

Twin: shaders/material/surface.glsl. glTF 2.0 §3.9 and the extensions say how factors and textures combine.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx
from gltf_iri.planning.effects import Effect
from gltf_iri.reference.normal import mapped_normal, tangent_frame
from gltf_iri.reference.points import Points, unit
from gltf_iri.reference.slots import sample_slot, texture_of
from gltf_iri.reference.stage import Stage
from gltf_iri.reference.surface import Surface

__all__ = ["gather_surface"]

Float64 = NDArray[np.float64]


def gather_surface(stage: Stage, slot: int, points: Points, view: Float64) -> Surface:
    """Return what the material at `slot` of the stage's plans is at `points`, seen along −`view`.

    view : (n, 3), unit, towards the viewer. Normals are turned as the rays met the triangles, not to `view`.
    """
    reader = _Reader(stage, slot, points)
    plan, m = stage.plans[slot], stage.materials[slot]
    is_lit, is_dielectric = not plan.calls_for(Effect.UNLIT), plan.calls_for(Effect.DIELECTRIC)
    facing = np.where(points.is_front, 1.0, -1.0)[:, None]
    normal = facing * mapped_normal(stage, slot, "normal", points)
    base = np.asarray(m.pbr.base_color_factor) * points.colour * reader.texture("base_color", 4)
    roughness_metallic = reader.texture("metallic_roughness", 2)
    roughness = (m.pbr.roughness_factor if is_lit else 1.0) * roughness_metallic[:, 0]
    specular_weight, dielectric_f0 = (
        _specular(reader, m) if is_dielectric else (reader.fill(1.0), reader.zero3)
    )
    iridescence, thickness_nm = _iridescence(reader, m.iridescence)
    bragg, period_texel = _bragg(reader, m.bragg)
    strength, tangent = _anisotropy(reader, m.anisotropy, normal)
    transmission, depth_m = _transmission(reader, m)
    sheen_color, sheen_roughness = _sheen(reader, m.sheen)
    clearcoat, clearcoat_roughness = _clearcoat(reader, m.clearcoat)
    return Surface(
        position=points.position,
        normal=normal,
        view=view,
        # The lower clamp keeps the masking finite past the silhouette, the upper takes back rounding.
        n_dot_v=np.clip(np.sum(normal * view, axis=1), N_DOT_V_MIN, 1.0),
        base_color=np.clip(base[:, :3], 0.0, 1.0),  # vertex colours above 1 would reflect more than arrives
        metallic=(m.pbr.metallic_factor if is_lit else 0.0) * roughness_metallic[:, 1],
        perceptual_roughness=roughness,
        alpha_roughness=alpha_ggx(roughness),
        emission=_emission(reader, m),
        occlusion=_occlusion(reader, m),
        dielectric_f0=dielectric_f0,
        specular_weight=specular_weight,
        iridescence_factor=iridescence,
        iridescence_thickness_nm=thickness_nm,
        iridescence_thickness_std_nm=reader.fill(0.0),  # a ray meets the film in one point
        bragg_factor=bragg,
        bragg_period_texel=period_texel,
        anisotropy_strength=strength,
        anisotropy_tangent=tangent,
        transmission=transmission,
        volume_thickness_m=depth_m,
        sheen_color=sheen_color,
        sheen_roughness=sheen_roughness,
        clearcoat=clearcoat,
        clearcoat_roughness=clearcoat_roughness,
        clearcoat_normal=facing * mapped_normal(stage, slot, "clearcoat_normal", points),
    )


class _Reader:
    """Reads one material's textures at given points; 1 where the plan does not call for a texture."""

    def __init__(self, stage: Stage, slot: int, points: Points) -> None:
        self.stage, self.slot, self.points = stage, slot, points
        self.zero3 = np.zeros((len(points.position), 3))

    def calls_for(self, effect: Effect) -> bool:
        return self.stage.plans[self.slot].calls_for(effect)

    def fill(self, value: float) -> Float64:
        return np.full(len(self.points.position), value)

    def texture(self, name: str, channels: int) -> Float64:
        """Return (n, channels)."""
        texel = sample_slot(self.stage, self.slot, name, self.points.uv)
        return np.ones((len(self.points.position), channels)) if texel is None else texel

    def scalar(self, name: str) -> Float64:
        return np.asarray(self.texture(name, 1)[:, 0])


def _emission(reader: _Reader, m: Material) -> Float64:
    if not reader.calls_for(Effect.EMISSION):
        return reader.zero3
    strength = (m.emissive_strength or EmissiveStrength()).strength
    return np.asarray(strength * np.asarray(m.emissive_factor) * reader.texture("emissive", 3))


def _occlusion(reader: _Reader, m: Material) -> Float64:
    strength = 0.0 if m.occlusion_texture is None else m.occlusion_texture.strength
    return np.asarray(1.0 + strength * (reader.scalar("occlusion") - 1.0))


def _specular(reader: _Reader, m: Material) -> tuple[Float64, Float64]:
    specular = (m.specular if reader.calls_for(Effect.SPECULAR) else None) or Specular()
    tint = np.asarray(specular.color_factor) * reader.texture("specular_color", 3)
    # The tint may exceed 1, a reflectance may not.
    f0 = np.minimum((m.ior or Ior()).f0 * tint, 1.0)
    return specular.factor * reader.scalar("specular"), f0


def _iridescence(reader: _Reader, film: Iridescence | None) -> tuple[Float64, Float64]:
    if film is None or not reader.calls_for(Effect.IRIDESCENCE):
        return reader.fill(0.0), reader.fill(0.0)
    share = reader.scalar("iridescence_thickness")
    thickness_nm = film.thickness_min_nm * (1.0 - share) + film.thickness_max_nm * share
    return film.factor * reader.scalar("iridescence"), thickness_nm


def _bragg(reader: _Reader, stack: Bragg | None) -> tuple[Float64, Float64]:
    """Return the layers' share (n,) and the value (n,) along which their periods run."""
    if stack is None or not reader.calls_for(Effect.BRAGG):
        return reader.fill(0.0), reader.fill(1.0)
    return stack.factor * reader.scalar("bragg"), reader.scalar("bragg_period")


def _anisotropy(reader: _Reader, stated: Anisotropy | None, normal: Float64) -> tuple[Float64, Float64]:
    """Return strength (n,) and the direction (n, 3) along which the highlight is drawn out."""
    if stated is None or not reader.calls_for(Effect.ANISOTROPY):
        return reader.fill(0.0), reader.zero3
    strength, painted = reader.fill(stated.strength), np.zeros((len(normal), 2))
    info = texture_of(reader.stage, reader.slot, "anisotropy")
    if info is not None:
        texel = reader.texture("anisotropy", 3)
        strength, painted = strength * texel[:, 2], 2.0 * texel[:, :2] - 1.0
    # Where opposite directions are filtered into none, the tangent stands in.
    painted[np.all(painted == 0.0, axis=1)] = (1.0, 0.0)
    cos_turn, sin_turn = np.cos(stated.rotation_rad), np.sin(stated.rotation_rad)
    turned = unit(painted) @ np.array([[cos_turn, sin_turn], [-sin_turn, cos_turn]])
    frame = tangent_frame(reader.points, info or TextureInfo(texture=0))
    tangent = np.einsum("nk,nkc->nc", turned, frame[:, :2])
    return strength, unit(tangent - normal * np.sum(normal * tangent, axis=1, keepdims=True))


def _transmission(reader: _Reader, m: Material) -> tuple[Float64, Float64]:
    """Return the share (n,) that is transmitted and the depth (n,) under the surface, in mesh metres."""
    if m.transmission is None or not reader.calls_for(Effect.TRANSMISSION):
        return reader.fill(0.0), reader.fill(0.0)
    depth_m = (m.volume or Volume()).thickness_factor_m if reader.calls_for(Effect.VOLUME) else 0.0
    share = (m.transmission or Transmission()).factor * reader.scalar("transmission")
    return share, depth_m * reader.scalar("volume_thickness")


def _sheen(reader: _Reader, stated: Sheen | None) -> tuple[Float64, Float64]:
    if stated is None or not reader.calls_for(Effect.SHEEN):
        return reader.zero3, reader.fill(0.0)
    colour = np.asarray(stated.color_factor) * reader.texture("sheen_color", 3)
    return colour, stated.roughness_factor * reader.scalar("sheen_roughness")


def _clearcoat(reader: _Reader, stated: Clearcoat | None) -> tuple[Float64, Float64]:
    if stated is None or not reader.calls_for(Effect.CLEARCOAT):
        return reader.fill(0.0), reader.fill(0.0)
    roughness = stated.roughness_factor * reader.scalar("clearcoat_roughness")
    return stated.factor * reader.scalar("clearcoat"), roughness
