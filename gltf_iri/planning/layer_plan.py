"""What the plan says about the Bragg layers of a material: which are left, over what, and by which method."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Final, Literal

from gltf_iri.planning.film_table import Texel, texel_bytes
from gltf_iri.planning.method import ParameterValue
from gltf_iri.planning.reach import Span

__all__ = ["LayerTables", "LayersPlan", "PlannedLayer", "Under"]

# What the light that passes all layers meets; "nothing" needs no transmission below the last layer.
Under = Literal["nothing", "base"]

# Over the roughnesses that a texture reads.
_METAL_NODES: Final = 9


@dataclass(frozen=True, slots=True)
class PlannedLayer:
    """One layer that is simulated.

    source : its place in the material's own list.
    period_nm : d1 + d2 at the two ends of the plan's `texel`, one number twice where nothing varies; linear
        between them. fill : d1/(d1 + d2).
    alpha : perceptual roughness squared, ALPHA_MIN at least.
    """

    source: int
    n1: float
    n2: float
    period_nm: tuple[float, float]
    fill: float
    cells: int
    alpha: float


@dataclass(frozen=True, slots=True)
class LayerTables:
    """The shape of a stack's tables: each layer's factors over the cosine in the host, and over its period.

    Spectra are held as their means over `bands` bands of wavelengths, and multiplied band by band; the first
    layer's reflection, which nothing attenuates, as a colour. With is_colour every factor is a colour, and
    colours are multiplied. Axes are even: cosines from 0 to 1, and the period texture's values over the
    plan's `texel` (one node where it does not vary), which all layers share; linear between nodes, as OpenGL
    filters.

    delta_e : measured; p95 of CIEDE2000 of the stack's colours against the truth over the material's reach.
    """

    bands: int
    is_colour: bool
    cos_nodes: int
    period_nodes: int
    texel: Texel
    delta_e: float

    def bytes(self, plan: LayersPlan) -> int:
        """Memory of the tables of `plan`, four bands or one colour to a texel."""
        quads, layers, has_base = -(-self.bands // 4), len(plan.layers), plan.under == "base"
        # The first's reflection; the others', and what each passes, where something lies below.
        factors = 1 + quads * (layers - 1) + quads * (layers if has_base else layers - 1)
        sky = layers + (1 if has_base else 0) + 2 * plan.metal_nodes
        return (factors + sky) * self.cos_nodes * self.period_nodes * texel_bytes(self.texel)


@dataclass(frozen=True, slots=True)
class LayersPlan:
    """Layers, outermost first, in a host of index host_ior, and how their colours are computed.

    texel : the values that the period texture (channel G) takes, which every layer's period runs along; a
        point without one.
    method : of the domain "layers"; with tables, what fills them. parameters : its own.
    metal_roughness : perceptual, of the metal that light below may meet; None where there is none.
    delta_e : measured p95 of CIEDE2000 over the material's reach; None without a budget.
    reason : why this method; simpler : what was left out and why, for people.
    """

    layers: tuple[PlannedLayer, ...]
    host_ior: float
    under: Under
    texel: Span
    method: str
    parameters: Mapping[str, ParameterValue] = field(default_factory=lambda: MappingProxyType({}))
    tables: LayerTables | None = None
    metal_roughness: Span | None = None
    delta_e: float | None = None
    ns_per_colour: float = 0.0
    reason: str = ""
    simpler: tuple[str, ...] = ()

    @property
    def varies(self) -> bool:
        """True where a period comes out of a texture."""
        return not self.texel.is_point

    @property
    def metal_nodes(self) -> int:
        """How many roughnesses of the metal tables for image light hold, linear between them."""
        span = self.metal_roughness
        return 0 if span is None else 1 if span.is_point else _METAL_NODES

    def to_json(self) -> dict[str, Any]:
        """Return how `plan --json` tells it."""
        tables, metal = self.tables, self.metal_roughness
        return {
            "layers": [
                {
                    "source": layer.source,
                    "n1": layer.n1,
                    "n2": layer.n2,
                    "period_nm": list(layer.period_nm),
                    "fill": layer.fill,
                    "cells": layer.cells,
                    "alpha": layer.alpha,
                }
                for layer in self.layers
            ],
            "host_ior": self.host_ior,
            "under": self.under,
            "texel": [self.texel.low, self.texel.high],
            "metal_roughness": None if metal is None else [metal.low, metal.high],
            "method": self.method,
            "parameters": dict(self.parameters),
            "tables": None
            if tables is None
            else {
                "bands": tables.bands,
                "is_colour": tables.is_colour,
                "nodes": [tables.cos_nodes, tables.period_nodes],
                "texel": tables.texel,
                "bytes": tables.bytes(self),
                "delta_e": tables.delta_e,
            },
            "delta_e": self.delta_e,
            "ns_per_colour": self.ns_per_colour,
            "reason": self.reason,
            "simpler": list(self.simpler),
        }
