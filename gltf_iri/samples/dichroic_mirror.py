"""Three dichroic glasses before a white wall: each mirrors one third of the spectrum and lets the rest by."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.bragg_layer import bragg_layer, bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import Shape, grid

__all__ = ["CELLS", "FALLBACK_F0", "GLASSES", "HOST_IOR", "build", "mirror"]

Float64 = NDArray[np.float64]

HOST_IOR, FILM_IOR = 1.46, 2.35  # silica and titania
CELLS: Final = 5
QUARTER_NM: Final = (94.2, 58.5)  # of silica and titania, for 550 nm

# Glass → the wavelength that its films are quarter waves of, as a multiple of 550 nm.
GLASSES: Final = {"blue mirror": 0.76, "green mirror": 1.0, "red mirror": 1.25}

# Half of what each mirrors face on, linear Rec.709 under D65, cut off at 0 and 1.
FALLBACK_F0: Final = {
    "blue mirror": (0.018, 0.128, 0.5),
    "green mirror": (0.428, 0.5, 0.167),
    "red mirror": (0.5, 0.095, 0.012),
}

_RADIUS_M, _HEIGHT_M, _ARC_RAD, _APART_M = 0.055, 0.11, 1.5, 0.092
_WALL_M, _WALL_AT, _FIELDS = (0.46, 0.26), (0.0, 0.0, -0.035), (23, 13)


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("dichroic-mirror")
    checker = np.array([[60, 235], [235, 60]], dtype=np.uint8)  # sRGB
    wall = builder.material(
        "wall",
        base_color=(1.0, 1.0, 1.0),
        metallic=0.0,
        roughness=0.9,
        base_color_texture=builder.texture("checker", encode_png(checker), nearest=True, repeat=True),
        extensions={},
    )
    builder.mesh("wall", _wall(), wall, translation_m=_WALL_AT)
    pane = _pane()
    for place, (glass, scale) in enumerate(GLASSES.items()):
        material = builder.material(
            glass,
            base_color=(1.0, 1.0, 1.0),
            metallic=0.0,
            roughness=0.0,
            double_sided=True,
            extensions={
                **tinted_surface(FALLBACK_F0[glass]),
                "KHR_materials_transmission": {"transmissionFactor": 1.0},
                "EXT_materials_bragg": bragg_stack(mirror(scale), host_ior=HOST_IOR),
            },
        )
        builder.mesh(glass, pane, material, translation_m=((place - 1) * _APART_M, 0.0, -_RADIUS_M * 0.5))
    builder.perspective_camera((0.0, 0.03, 0.53), (0.0, 0.0, 0.0), 0.39)
    builder.directional_light((-0.3, -0.4, -1.0), 1.0)
    return Sample(
        name="dichroic-mirror",
        title="Dichroic mirror",
        shows="Three bent glasses before a checker: a colour in the mirror, its complement through it.",
        look_for=(
            "Over the wall's dark fields one sees what a glass mirrors, over the light ones what it "
            "lets by: blue and yellow, green and violet, red and cyan. The two add up to the light that "
            "came, since the films absorb nothing. Each glass is bent: towards its sides the light "
            "meets it aslant, the mirrored band slides to shorter waves, and both colours turn, the one "
            "into the next and the other along with it.\n\n"
            "The films lie in silica, whose smooth surface towards air gives a second, colourless image "
            "of the lights. Light from behind crosses the films once (KHR_materials_transmission, "
            "thin-walled)."
        ),
        fallback=(
            "Clear glass whose specular colour is half of what the films mirror face on, so that "
            "something still comes through: the mirrored colour is there, its complement only faint, "
            "and neither turns with the angle. The base colour stays white, because it also filters "
            "what comes through the films."
        ),
        sources=(
            "Five cells of silica, 1.46 and 94.2 nm, and titania, 2.35 and 58.5 nm, quarter waves at "
            "550 nm: multilayer.app, tutorial on Bragg mirrors. That is the middle glass; the others' "
            "films are 0.76 and 1.25 times as thick. Neither index varies with the wavelength here. The "
            "glasses are 11 cm high."
        ),
        files=builder.to_gltf(),
    )


def mirror(scale: float) -> dict[str, Any]:
    """Return the layer whose films are quarter waves at `scale` × 550 nm."""
    silica_nm, titania_nm = (round(scale * film, 3) for film in QUARTER_NM)
    return bragg_layer(silica_nm, titania_nm, FILM_IOR, CELLS, 0.0)


def _wall() -> Shape:
    u, v = np.meshgrid((0.0, 1.0), (0.0, 1.0))
    width, height = _WALL_M
    positions = np.stack([(u - 0.5) * width, (0.5 - v) * height, np.zeros_like(u)], axis=-1)
    normals = np.broadcast_to((0.0, 0.0, 1.0), positions.shape)
    along = np.broadcast_to((1.0, 0.0, 0.0), positions.shape)
    uvs = np.stack([u * _FIELDS[0] / 2.0, v * _FIELDS[1] / 2.0], axis=-1)
    return grid(positions, normals, along, uvs)


def _pane() -> Shape:
    """Return a part of an upright tube's wall, bulging towards +Z."""
    azimuth, height = np.meshgrid(np.linspace(-_ARC_RAD / 2, _ARC_RAD / 2, 33), (0.5, -0.5))
    normals = np.stack([np.sin(azimuth), np.zeros_like(azimuth), np.cos(azimuth)], axis=-1)
    positions = _RADIUS_M * normals + _HEIGHT_M * height[..., None] * np.array([0.0, 1.0, 0.0])
    along = np.stack([np.cos(azimuth), np.zeros_like(azimuth), -np.sin(azimuth)], axis=-1)
    return grid(positions, normals, along, np.stack([azimuth / _ARC_RAD + 0.5, 0.5 - height], axis=-1))
