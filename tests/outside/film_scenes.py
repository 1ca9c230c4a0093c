"""Three scenes with a film, each told twice: as a glTF file and as Mitsuba's dictionaries.

Film and base are told by their indices; glTF's metal by the grey that its index reflects. All light has D65's
colour: what a coloured light and a coloured reflection make together depends on their spectra, not on RGB.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, Final

import numpy as np
from matrix_film import base_ior_of
from mitsuba_scene import View, environment_emitter, mitsuba_scene, write_ply
from numpy.typing import NDArray

from gltf_iri.planning.decide import plan_materials
from gltf_iri.reference.render import ReferenceFrame, render_reference
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.shapes import Shape, sheet
from gltf_iri.samples.sphere import sphere
from gltf_iri.scene.load import load
from gltf_iri.scene.model import Environment

__all__ = ["SCENES", "FilmScene", "grey_radiance", "matched_pixels", "mitsuba_twin", "our_picture"]

Float64 = NDArray[np.float64]

MAP_HEIGHT: Final = 256
VIEW: Final = View(eye=(1.0, 0.8, 3.5), target=(0.0, 0.1, 0.0), yfov_rad=0.5, size=(16, 16))
STEEP_VIEW: Final = View(eye=(0.4, 2.0, 1.6), target=(0.0, 0.0, 0.0), yfov_rad=0.6, size=(10, 10))
IMAGE_SAMPLES: Final = 1024
PATHS: Final = 8192
METAL_F0: Final = 0.6
GLASS_IOR: Final = 1.5


@dataclass(frozen=True, slots=True)
class FilmScene:
    """What both renderers are told; lengths in metres."""

    name: str
    bsdf: str  # the Mitsuba plug-in
    shape: Shape
    view: View
    film_ior: float
    thickness_nm: float
    is_metal: bool
    roughness: float = 0.0  # perceptual
    samples: int = 8  # in each of Mitsuba's batches
    sun_lux: float = 0.0  # light that travels along SUN

    @property
    def reference_freedom(self) -> int:
        """Degrees of freedom of the reference's error: 8 integrals over the sky, or PATHS paths."""
        return 7 if self.is_metal else PATHS - 1


SUN: Final = (-0.6, -0.7, -0.5)


def grey_radiance(direction: Float64) -> Float64:
    """Return the environment's radiance (...) along unit directions (..., 3), without any symmetry."""
    x, y, z = np.moveaxis(direction, -1, 0)
    return np.asarray(1.0 + 0.2 * x + 0.7 * y - 0.25 * z + 0.15 * x * y)


def _dome(x: Float64, z: Float64) -> tuple[Float64, ...]:
    """Return a shallow dome's height and slopes: light that passes it does not meet it again."""
    return -0.15 * (x * x + z * z), -0.3 * x, -0.3 * z


SCENES: Final = (
    FilmScene("film on a mirror", "film_mirror", sphere(1.0, rings=64, segments=96), VIEW, 1.45, 420.0, True),
    FilmScene(
        "film on rough metal",
        "rough_film",
        sphere(1.0, rings=64, segments=96),
        VIEW,
        1.45,
        600.0,
        True,
        roughness=0.5,
        sun_lux=4.0,
    ),
    FilmScene(
        "film on a pane", "film_pane", sheet(2.0, 2.0, 32, _dome), STEEP_VIEW, 2.4, 380.0, False, samples=16
    ),
)


def _write_gltf(scene: FilmScene, thickness_nm: float, folder: Path) -> Path:
    builder = GLTFBuilder("scene")
    extensions: dict[str, dict[str, Any]] = {
        "KHR_materials_iridescence": {
            "iridescenceFactor": 1.0,
            "iridescenceIor": scene.film_ior,
            "iridescenceThicknessMaximum": thickness_nm,
        }
    }
    if not scene.is_metal:
        extensions["KHR_materials_transmission"] = {"transmissionFactor": 1.0}
        extensions["KHR_materials_ior"] = {"ior": GLASS_IOR}
    material = builder.material(
        "film",
        base_color=[METAL_F0 if scene.is_metal else 1.0] * 3,
        metallic=float(scene.is_metal),
        roughness=scene.roughness,
        extensions=extensions,
    )
    builder.mesh("shape", scene.shape, material)
    builder.perspective_camera(scene.view.eye, scene.view.target, scene.view.yfov_rad)
    if scene.sun_lux:
        builder.directional_light(SUN, scene.sun_lux)
    for name, content in builder.to_gltf().items():
        (folder / name).write_bytes(content)
    return folder / "scene.gltf"


def our_picture(scene: FilmScene, folder: Path, *, thickness_nm: float | None = None) -> ReferenceFrame:
    """Return the CPU reference's picture by the method `spectral`.

    thickness_nm : in place of the scene's own.
    """
    model = load(_write_gltf(scene, scene.thickness_nm if thickness_nm is None else thickness_nm, folder))
    shown = model.scene()
    return render_reference(
        model,
        shown,
        plan_materials(model.materials),
        shown.cameras[0],
        _environment(),
        size=scene.view.size,
        film_method="spectral",
        image_samples=IMAGE_SAMPLES,
        paths=PATHS,
        processes=1,
    )


def _environment() -> Environment:
    polar = np.pi * (np.arange(MAP_HEIGHT) + 0.5) / MAP_HEIGHT
    azimuth = np.pi * ((np.arange(2 * MAP_HEIGHT) + 0.5) / MAP_HEIGHT - 1.0)
    polar, azimuth = np.meshgrid(polar, azimuth, indexing="ij")
    out = np.sin(polar)
    grey = grey_radiance(np.stack([out * np.cos(azimuth), np.cos(polar), out * np.sin(azimuth)], axis=-1))
    return Environment("grey", np.repeat(grey[..., None], 3, axis=-1).astype(np.float32))


def mitsuba_twin(mi: ModuleType, scene: FilmScene, folder: Path) -> Any:
    """Return Mitsuba's scene, from the vertices as the glTF file holds them."""
    primitive = load(_write_gltf(scene, scene.thickness_nm, folder)).scene().primitives[0]
    mesh = folder / "shape.ply"
    write_ply(mesh, primitive.positions, primitive.normals, primitive.triangles)
    bsdf = {
        "type": scene.bsdf,
        "film_ior": scene.film_ior,
        "thickness_nm": scene.thickness_nm,
        "base_ior": base_ior_of(METAL_F0) if scene.is_metal else GLASS_IOR,
    }
    if scene.roughness:
        bsdf["alpha"] = scene.roughness**2
    emitters = [environment_emitter(mi, grey_radiance, MAP_HEIGHT)]
    if scene.sun_lux:
        irradiance = {"type": "d65", "scale": scene.sun_lux}
        emitters.append({"type": "directional", "direction": list(SUN), "irradiance": irradiance})
    return mitsuba_scene(mi, mesh, bsdf, emitters, scene.view, scene.samples)


def matched_pixels(frame: ReferenceFrame) -> NDArray[np.bool_]:
    """Return which pixels (height, width) lie inside of the shape's outline, with their four neighbours."""
    hit = np.pad(frame.material == 0, 1)
    return hit[1:-1, 1:-1] & hit[:-2, 1:-1] & hit[2:, 1:-1] & hit[1:-1, :-2] & hit[1:-1, 2:]
