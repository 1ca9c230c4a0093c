"""KHR_lights_punctual: what a light states belongs to its type."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of

__all__ = ["RULES"]

_EXTENSION = "KHR_lights_punctual"


def light_states_what_its_type_reads(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A spot light has a cone and no other light has; parallel light has no range."""
    if entry.get("type") == "spot":
        if entry.raw.get("spot") is None:
            yield issue("UNDEFINED_PROPERTY", entry.pointer, property="spot")
    elif "spot" in entry.raw:
        yield issue("EXTRA_PROPERTY", entry.at("spot"))
    if entry.get("type") == "directional" and "range" in entry:
        yield issue("EXTRA_PROPERTY", entry.at("range"))


def cone_widens(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A spot fades from the inner angle to the outer; an angle that is broken is told of already."""
    inner, outer = sound_value_of(entry, "innerConeAngle"), sound_value_of(entry, "outerConeAngle")
    is_spot = entry.parent is not None and entry.parent.get("type") == "spot"
    if is_spot and inner is not None and outer is not None and outer <= inner:
        pointer = entry.at("outerConeAngle")
        yield issue("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", pointer, inner=inner, outer=outer)


def node_needs_the_list_of_lights(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """Nodes name lights of a list that stands at the root."""
    if _EXTENSION not in asset.root.extensions:
        yield issue("UNSATISFIED_DEPENDENCY", entry.pointer, property=f"/extensions/{_EXTENSION}")


RULES: Rules = {
    "KHR_lights_punctual.node": (node_needs_the_list_of_lights,),
    "KHR_lights_punctual.light": (light_states_what_its_type_reads,),
    "KHR_lights_punctual.light.spot": (cone_widens,),
}
