"""Prefiltered environments and the DFG table, made when first needed and kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.rendering.environment_light import EnvironmentLight, prepare_environment
from gltf_iri.rendering.lobe_tables import compute_dfg_table
from gltf_iri.scene.model import Environment

if TYPE_CHECKING:
    import moderngl

__all__ = ["ImageLightStore"]


class ImageLightStore:
    """The image lights of one context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        # The environment is kept beside its textures: its identity is the key only while it lives.
        self._environments: dict[int, tuple[Environment, EnvironmentLight]] = {}
        self._dfg: moderngl.Texture | None = None

    def textures(self, environment: Environment) -> dict[str, moderngl.Texture]:
        """Return what the samplers of shaders/lighting/environment.glsl read."""
        if self._dfg is None:
            self._dfg = compute_dfg_table(self._context)
        if id(environment) not in self._environments:
            self._environments[id(environment)] = (
                environment,
                prepare_environment(self._context, environment),
            )
        light = self._environments[id(environment)][1]
        return {
            "u_environment": light.sharp,
            "u_environment_rest": light.rest,
            "u_environment_lamps": light.lamps,
            "u_environment_layers": light.layers,
            "u_dfg": self._dfg,
        }

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for _, light in self._environments.values():
            light.release()
        self._environments.clear()
        if self._dfg is not None:
            self._dfg.release()
            self._dfg = None
