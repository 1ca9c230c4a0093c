"""A row's material as EXT_materials_bragg says it: defaults, textures, and what makes it be ignored.

Read here once more, and not by `gltf_iri.material`, so that the vectors also hold that reading to the text.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.conformance.facet_sum import Facets

__all__ = ["BraggInput", "read_bragg_input"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class BraggInput:
    """What a row says; `facets` is empty where the extension has no effect.

    bragg : braggFactor · braggTexture.r. base_alpha : roughnessFactor². Cosines outside; cos_phi as `Pose`.
    """

    bragg: float
    host_ior: float
    facets: tuple[Facets, ...]
    base_colour: Float64
    metallic: float
    base_alpha: float
    transmission: float
    cos_theta_i: float
    cos_theta_o: float
    cos_phi: float

    @property
    def is_smooth(self) -> bool:
        """True where a layer has no BRDF but its mirror image of a light."""
        return any(facets.alpha == 0.0 for facets in self.facets)


def read_bragg_input(row: Mapping[str, Any]) -> BraggInput:
    """Return what the inputs of a row say; KeyError where one is missing."""
    material = row["material"]
    pbr, extensions = material.get("pbrMetallicRoughness", {}), material.get("extensions", {})
    bragg = extensions.get("EXT_materials_bragg", {})
    metallic = float(pbr.get("metallicFactor", 1.0))
    transmission = float(extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0.0))
    host = float(bragg.get("hostIor", 1.0))
    facets = tuple(_facets(layer, host, row["period_texture"]) for layer in bragg.get("layers", ()))
    return BraggInput(
        float(bragg.get("braggFactor", 0.0)) * row["bragg_texture"],
        host,
        () if _is_ignored(facets, metallic, transmission) else facets,
        np.array(pbr.get("baseColorFactor", [1.0] * 4)[:3], np.float64),
        metallic,
        float(pbr.get("roughnessFactor", 1.0)) ** 2,
        transmission,
        row["cos_theta_i"],
        row["cos_theta_o"],
        row["cos_phi"],
    )


def _facets(layer: Mapping[str, Any], host_ior: float, period_texture: float) -> Facets:
    low, high = (float(layer.get(name, 250.0)) for name in ("periodMinimum", "periodMaximum"))
    period_nm = low * (1.0 - period_texture) + high * period_texture
    fill = float(layer.get("fill", 0.5))
    return Facets(
        host_ior,
        float(layer.get("ior1", host_ior)),
        float(layer.get("ior2", 1.5)),
        fill * period_nm,
        (1.0 - fill) * period_nm,
        int(layer.get("cells", 1)),
        float(layer.get("roughness", 0.0)) ** 2,
    )


def _is_ignored(facets: tuple[Facets, ...], metallic: float, transmission: float) -> bool:
    """Light bent behind a layer is defined behind the last only, over what is neither metal nor transmits."""
    bends = [each.n1 != each.host_ior for each in facets]
    return any(bends[:-1]) or (any(bends[-1:]) and (metallic > 0.0 or transmission > 0.0))
