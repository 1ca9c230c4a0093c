"""Finds the camera that a caller names by its index, and the environment named by a word or a path."""

from __future__ import annotations

import os

from gltf_iri.errors import UsageError
from gltf_iri.scene.environment import read_environment, studio, white
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["choose_camera", "choose_environment"]


def choose_camera(scene: Scene, index: int | None, size: tuple[int, int]) -> Camera:
    """Return camera `index` of the scene; for None its first, or where it has none, one that frames it.

    size : of the picture in pixels. Raises UsageError where there is no such camera.
    """
    if index is None:
        # A side of 0 is refused where the picture is made; here it must only not divide.
        aspect = max(size[0], 1) / max(size[1], 1)
        return scene.cameras[0] if scene.cameras else frame_scene(scene, aspect=aspect)
    if not 0 <= index < len(scene.cameras):
        raise UsageError(f"There is no camera {index}: the scene has {len(scene.cameras)}.")
    return scene.cameras[index]


def choose_environment(name: str | os.PathLike[str]) -> Environment | None:
    """Return "studio" or "white" as made here, None for "none", and for anything else the map of that file.

    A file by one of these names is reached as "./studio". Raises UsageError where there is no such file, and
    what `read_environment` raises.
    """
    if str(name) == "none":
        return None
    made = {"studio": studio, "white": white}.get(str(name))
    if made is not None:
        return made()
    if not os.path.lexists(name):
        raise UsageError(
            f"There is no environment '{name}': name a .hdr or .exr file, studio, white or none."
        )
    return read_environment(name)
