"""A sphere under a film whose thickness varies finely: what a picture of few pixels cannot resolve.

Belcour & Barla 2017, Fig. 15: a dielectric of index 2.0, α = 0.01, under a film of 1.68 whose path difference
at normal incidence, 2 n d, runs from 0 to 1470 nm. Their texture is not printed; this one is noise whose
octaves fade as they get finer, down to a period of four texels.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sphere import sphere
from gltf_iri.scene.load import Model, load
from gltf_iri.whole_files import write_whole

__all__ = ["FILM_IOR", "HALF_WIDTH", "THICKEST_NM", "fine_film"]

FILM_IOR: Final = 1.68
_BASE_IOR: Final = 2.0
_ROUGHNESS: Final = 0.1  # α = 0.01
THICKEST_NM: Final = 1470.0 / (2.0 * FILM_IOR)

# Half of what the camera sees; the sphere's radius is 1.
HALF_WIDTH: Final = 1.1

_WAVES: Final = 6  # an octave
_COARSEST: Final = 4.0  # radians of phase a radian of arc
_FADING: Final = 0.75  # of a wave's height, from octave to octave
_DEVIATION: Final = 0.22  # of the thickness, as a part of its range


@contextmanager
def fine_film(rows: int) -> Iterator[Model]:
    """Open the sphere whose thickness texture has 2·rows × rows texels; its file lives in the block."""
    builder = GLTFBuilder("fine-film")
    texture = builder.texture("thickness", encode_png(to_bytes(_noise(rows))), repeat=True)
    film = {
        "iridescenceFactor": 1.0,
        "iridescenceIor": FILM_IOR,
        "iridescenceThicknessMinimum": 0.0,
        "iridescenceThicknessMaximum": THICKEST_NM,
        "iridescenceThicknessTexture": {"index": texture},
    }
    material = builder.material(
        "fine film",
        base_color=(0.0, 0.0, 0.0),
        metallic=0.0,
        roughness=_ROUGHNESS,
        extensions={"KHR_materials_ior": {"ior": _BASE_IOR}, "KHR_materials_iridescence": film},
    )
    lean = np.radians(25.0) / 2.0  # one pole is seen
    builder.mesh(
        "sphere", sphere(1.0, rings=96, segments=192), material, (np.sin(lean), 0.0, 0.0, np.cos(lean))
    )
    builder.orthographic_camera((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), HALF_WIDTH, HALF_WIDTH)
    with tempfile.TemporaryDirectory() as folder:
        files = {Path(folder) / name: content for name, content in builder.to_glb().items()}
        write_whole(files)
        yield load(next(iter(files)))


def _noise(rows: int) -> NDArray[np.float64]:
    """Return a sum of sines in random directions of space, (rows, 2·rows) around 0.5."""
    u, v = texel_centres(rows, 2 * rows)
    around, down = 2.0 * np.pi * u, np.pi * v
    points = np.stack([np.sin(down) * np.sin(around), np.cos(down), np.sin(down) * np.cos(around)], axis=-1)
    points = points.astype(np.float32)
    finest = rows / 2.0  # of four texels a period
    octaves = int(np.log2(finest / _COARSEST)) + 1
    g = np.random.default_rng(2017)
    total = np.zeros(u.shape, np.float32)
    heights = _FADING ** np.arange(octaves)[::-1]
    for octave, wave in enumerate(heights):  # from the finest
        directions = g.normal(size=(3, _WAVES))
        directions *= finest * 0.5**octave / np.linalg.norm(directions, axis=0)
        shifts = g.uniform(0.0, 2.0 * np.pi, _WAVES)
        phases = points @ directions.astype(np.float32) + shifts.astype(np.float32)
        total += np.float32(wave) * np.sin(phases).sum(axis=-1)
    height = _DEVIATION / np.sqrt(0.5 * _WAVES * np.sum(heights**2))
    return np.asarray(0.5 + height * total, dtype=np.float64)
