"""KHR_materials_variants: which variant gives a primitive which material."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.schema.values import BROKEN, typed

__all__ = ["RULES"]

_EXTENSION = "KHR_materials_variants"


def variant_has_one_material(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Each variant stands once in all mappings of a primitive; one that does not exist counts too."""
    seen: set[int] = set()
    for mapping in entry.get("mappings", ()):
        if mapping is None or "variants" not in mapping:
            continue
        for position, value in enumerate(mapping.raw["variants"]):
            index = typed("INDEX", value)
            if index is BROKEN or index < 0:
                continue
            if index in seen:
                yield issue("KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", mapping.at("variants", position))
            seen.add(index)


def mapping_needs_the_list_of_variants(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Mappings name variants of a list that stands at the root."""
    if _EXTENSION not in asset.root.extensions:
        yield issue("UNSATISFIED_DEPENDENCY", entry.pointer, property=f"/extensions/{_EXTENSION}")


RULES: Rules = {
    "KHR_materials_variants.mapping": (mapping_needs_the_list_of_variants,),
    "KHR_materials_variants.primitive": (variant_has_one_material,),
}
