"""Prefiltered environments and the lobes' tables, made when first needed and kept."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from gltf_iri.rendering.environment_light import EnvironmentLight, prepare_environment, prepare_sheen
from gltf_iri.rendering.lobe_tables import compute_dfg_table, compute_sheen_table
from gltf_iri.scene.model import Environment

if TYPE_CHECKING:
    import moderngl

__all__ = ["ImageLightStore"]

# A map of 8192 × 4096 takes 0.7 GB; a loop over many maps must not fill the memory.
_MOST_KEPT: Final = 4


@dataclass(slots=True)
class _Prepared:
    # The environment is kept beside its textures: its identity is the key only while it lives.
    environment: Environment
    light: EnvironmentLight
    sheen: moderngl.Texture | None = None

    def release(self) -> None:
        self.light.release()
        if self.sheen is not None:
            self.sheen.release()


class ImageLightStore:
    """The image lights of one context; of the environments those used last."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._prepared: dict[int, _Prepared] = {}
        self._dfg: moderngl.Texture | None = None
        self._sheen_albedo: moderngl.Texture | None = None

    def tables(self, *, with_sheen: bool = False) -> dict[str, moderngl.Texture]:
        """Return what is read without an environment too: u_dfg, and u_sheen_albedo if asked for."""
        if self._dfg is None:
            self._dfg = compute_dfg_table(self._context)
        tables = {"u_dfg": self._dfg}
        if with_sheen:
            if self._sheen_albedo is None:
                self._sheen_albedo = compute_sheen_table(self._context)
            tables["u_sheen_albedo"] = self._sheen_albedo
        return tables

    def textures(self, environment: Environment, *, with_sheen: bool = False) -> dict[str, moderngl.Texture]:
        """Return the tables and what the samplers of shaders/lighting/environment.glsl read."""
        prepared = self._prepared.pop(id(environment), None)
        if prepared is None:
            if len(self._prepared) == _MOST_KEPT:
                self._prepared.pop(next(iter(self._prepared))).release()
            prepared = _Prepared(environment, prepare_environment(self._context, environment))
        self._prepared[id(environment)] = prepared
        light = prepared.light
        textures = self.tables(with_sheen=with_sheen) | {
            "u_environment": light.sharp,
            "u_environment_rest": light.rest,
            "u_environment_lamps": light.lamps,
            "u_environment_layers": light.layers,
        }
        if with_sheen:
            if prepared.sheen is None:
                prepared.sheen = prepare_sheen(self._context, environment)
            textures["u_environment_sheen"] = prepared.sheen
        return textures

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for prepared in self._prepared.values():
            prepared.release()
        self._prepared.clear()
        for table in filter(None, (self._dfg, self._sheen_albedo)):
            table.release()
        self._dfg = self._sheen_albedo = None
