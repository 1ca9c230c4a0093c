"""Where the data lies that ships with the program: inside the wheel, else in the checkout's own folders."""

from __future__ import annotations

from pathlib import Path

from gltf_iri.errors import MissingCapabilityError

__all__ = ["shader_root", "spec_root"]


def shader_root() -> Path:
    """Return the folder of GLSL files; raises MissingCapabilityError where the installation lost it."""
    return _shipped("shaders")


def spec_root() -> Path:
    """Return the folder of schemas and notes; raises MissingCapabilityError where it is missing."""
    return _shipped("spec")


def _shipped(name: str) -> Path:
    package = Path(__file__).resolve().parent
    for folder in (package / "_shipped" / name, package.parent / name):
        if folder.is_dir():
            return folder
    raise MissingCapabilityError(
        f"The installation at {package} lacks its folder '{name}'; reinstall gltf-iri."
    )
