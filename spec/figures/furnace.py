"""Draws furnace.png, what is lost of a white sky's light: `python spec/figures/furnace.py` in a checkout."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_materials
from gltf_iri.rendering.context import create_context
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import white
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Primitive, Scene

__all__ = ["main"]

SIZE = 96  # pixels
ROUGHNESSES = np.linspace(0.0, 1.0, 17)
FILM = Iridescence(factor=1.0, film_ior=1.8, thickness_max_nm=400.0)
FIBRES = Sheen(color_factor=(1.0, 1.0, 1.0), roughness_factor=0.5)

# Panel → curve → metalness and layers; everything white and lossless.
PANELS: dict[str, dict[str, tuple[float, dict[str, Any]]]] = {
    "metal": {
        "bare": (1.0, {}),
        "film": (1.0, {"iridescence": FILM}),
        "coat": (1.0, {"clearcoat": Clearcoat(factor=1.0)}),
        "sheen": (1.0, {"sheen": FIBRES}),
        "stretched": (1.0, {"anisotropy": Anisotropy(strength=1.0)}),
    },
    "dielectric": {
        "bare": (0.0, {}),
        "film": (0.0, {"iridescence": FILM}),
        "coat": (0.0, {"clearcoat": Clearcoat(factor=1.0)}),
        "sheen": (0.0, {"sheen": FIBRES}),
    },
    "glass": {
        "thin": (0.0, {"transmission": Transmission(factor=1.0)}),
        "thin, film": (0.0, {"transmission": Transmission(factor=1.0), "iridescence": FILM}),
        "thick": (0.0, {"transmission": Transmission(factor=1.0), "volume": Volume(thickness_factor_m=1.0)}),
    },
}


def sphere() -> Primitive:
    """Return the unit sphere, 64 by 128 quads."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, 65), np.linspace(0, 2 * np.pi, 129), indexing="ij")
    points = np.stack([np.sin(polar) * np.sin(turn), np.cos(polar), np.sin(polar) * np.cos(turn)], axis=-1)
    points = points.reshape(-1, 3).astype(np.float32)
    i = (np.arange(64)[:, None] * 129 + np.arange(128)).ravel()
    triangles = np.concatenate([np.stack([i, i + 129, i + 130], -1), np.stack([i, i + 130, i + 1], -1)])
    return Primitive("", "sphere", 0, points, points, triangles.astype(np.uint32), np.eye(4))


def losses(renderer: Renderer, material: Material) -> tuple[float, float]:
    """Return the mean over the sphere's disc, parallel rays, of 1 − radiance, and the highest radiance."""
    view = np.eye(4)
    view[2, 3] = -4.0
    camera = Camera("", "orthographic", view, 0.1, 100.0, xmag_m=1.0, ymag_m=1.0)
    model = Model(Path(), None, (material,), ())  # type: ignore[arg-type]
    scene = Scene("", (sphere(),), (), ())
    plans = plan_materials([material])
    frame = renderer.render(model, scene, plans, camera, SKY, size=(SIZE, SIZE), samples=0)
    seen = frame.rgba[frame.rgba[..., 3] > 0.0][:, :3]
    return float(1.0 - seen.mean()), float(seen.max())


SKY = white()


def measured() -> tuple[dict[str, dict[str, NDArray[np.float64]]], float]:
    """Return panel → curve → losses over ROUGHNESSES, and the highest radiance of all."""
    renderer = Renderer(create_context())
    brightest = 0.0
    panels: dict[str, dict[str, NDArray[np.float64]]] = {}
    for panel, curves in PANELS.items():
        panels[panel] = {}
        for name, (metallic, layers) in curves.items():
            found = []
            for roughness in ROUGHNESSES:
                pbr = MetallicRoughness(metallic_factor=metallic, roughness_factor=float(roughness))
                loss, highest = losses(renderer, Material(pbr=pbr, **layers))
                found.append(loss)
                brightest = max(brightest, highest)
            panels[panel][name] = np.array(found)
    renderer.release()
    return panels, brightest


def main() -> None:
    """Draw furnace.png beside this file."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    panels, brightest = measured()
    figure, axes = pyplot.subplots(1, len(panels), figsize=(9.0, 3.0), sharey=True, constrained_layout=True)
    for axis, (panel, curves) in zip(axes, panels.items(), strict=True):
        for name, loss in curves.items():
            axis.plot(ROUGHNESSES, 100.0 * loss, label=name)
        axis.set_title(panel)
        axis.set_xlabel("roughness")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set_ylabel("light lost (%)")
    figure.suptitle(f"A white sphere under a white sky; brightest pixel {brightest:.6f}", fontsize=10)
    figure.savefig(Path(__file__).with_name("furnace.png"), dpi=80)


if __name__ == "__main__":
    main()
