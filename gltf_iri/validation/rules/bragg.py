"""EXT_materials_bragg, what the text says MUST of: exclusions, first indices, limits; and where it stands."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.words import shown
from gltf_iri.material.bragg_limits import (
    BRAGG_CELLS_MAX,
    BRAGG_IOR_ACCEPTED,
    BRAGG_IOR_MAX,
    BRAGG_LAYERS_MAX,
    BRAGG_PERIOD_ACCEPTED_NM,
    BRAGG_PERIOD_MAX_NM,
)
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.bragg_codes import BRAGG_CODES
from gltf_iri.validation.bragg_stack import EXTENSION, Layer, Stack, stacks
from gltf_iri.validation.codes import add_codes, issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.bragg_effects import effects
from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

_EXCLUDED = ("KHR_materials_iridescence", "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness")

# Extensions by which a material lets light through, and the factor that says how much.
_TRANSMISSION = {
    "KHR_materials_transmission": "transmissionFactor",
    "KHR_materials_diffuse_transmission": "diffuseTransmissionFactor",
}

# Of a layer: property, what every reader accepts, what this one draws.
_LIMITS = (
    ("ior1", BRAGG_IOR_ACCEPTED, BRAGG_IOR_MAX),
    ("ior2", BRAGG_IOR_ACCEPTED, BRAGG_IOR_MAX),
    ("periodMinimum", BRAGG_PERIOD_ACCEPTED_NM, BRAGG_PERIOD_MAX_NM),
    ("periodMaximum", BRAGG_PERIOD_ACCEPTED_NM, BRAGG_PERIOD_MAX_NM),
    ("cells", BRAGG_CELLS_MAX, BRAGG_CELLS_MAX),
)


def _layers(root: Entry, asset: Asset) -> Iterator[Issue]:
    is_used = False
    for stack in stacks(asset):
        is_used = True
        yield from _exclusions(stack)
        yield from _first_indices(stack)
        yield from _limits(stack)
        yield from effects(stack)
    yield from _declarations(root, is_used=is_used)


def _exclusions(stack: Stack) -> Iterator[Issue]:
    others = stack.material.raw["extensions"]
    for other in _EXCLUDED:
        if other in others:
            yield issue("IRI_BRAGG_EXCLUDED", stack.entry.pointer, other=other)


def _first_indices(stack: Stack) -> Iterator[Issue]:
    """Tell of films that bend light which goes on to something that does not forget its direction."""
    host = stack.host_ior
    for layer in stack.layers:
        if layer.ior1 is None or host is None or layer.ior1 == host:
            continue  # what is broken is told of already
        if layer.position < stack.count - 1:
            reason = "only the last layer may have another"
        else:
            reason = _below(stack.material)
        if reason:
            yield issue(
                "IRI_BRAGG_FIRST_INDEX", layer.entry.at("ior1"), ior1=layer.ior1, host=host, reason=reason
            )


def _below(material: Entry) -> str:
    """Return what of the material does not let a bending layer lie over it; "" where nothing is known to."""
    pbr = material.raw.get("pbrMetallicRoughness", {})
    if isinstance(pbr, dict) and _is_above_zero(pbr.get("metallicFactor", 1.0)):
        stated = "" if "metallicFactor" in pbr else " (its default is 1)"
        return f"metallicFactor is not 0{stated}"
    for name, key in _TRANSMISSION.items():
        carried = material.raw["extensions"].get(name)
        if isinstance(carried, dict) and _is_above_zero(carried.get(key, 0.0)):
            return f"{key} is not 0"
    return ""


def _is_above_zero(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and value > 0.0


def _limits(stack: Stack) -> Iterator[Issue]:
    entry, host = stack.entry, stack.host_ior
    if host is not None and host > BRAGG_IOR_ACCEPTED:
        yield _beyond(entry, "hostIor", host, BRAGG_IOR_ACCEPTED, BRAGG_IOR_MAX)
    if stack.count > BRAGG_LAYERS_MAX:
        yield _beyond(entry, "layers", stack.count, BRAGG_LAYERS_MAX, BRAGG_LAYERS_MAX)
    for layer in stack.layers:
        yield from _limits_of_layer(layer, has_texture=stack.has_period_texture)


def _limits_of_layer(layer: Layer, *, has_texture: bool) -> Iterator[Issue]:
    for key, accepted, drawn in _LIMITS:
        is_read = key != "periodMinimum" or has_texture
        if is_read and layer.entry.get(key, 0.0) > accepted:
            yield _beyond(layer.entry, key, layer.entry[key], accepted, drawn)


def _beyond(entry: Entry, key: str, value: float, accepted: float, drawn: float) -> Issue:
    return issue(
        "IRI_BRAGG_BEYOND_LIMITS",
        entry.at(key),
        value=shown(value),
        accepted=f"{accepted:g}",
        drawn=f"{drawn:g}",
    )


def _declarations(root: Entry, *, is_used: bool) -> Iterator[Issue]:
    required, used = root.get("extensionsRequired", ()), root.get("extensionsUsed", ())
    if EXTENSION in required:
        yield issue("IRI_BRAGG_REQUIRED", root.at("extensionsRequired", required.index(EXTENSION)))
    if EXTENSION in used and not is_used:
        yield issue("IRI_BRAGG_UNUSED", root.at("extensionsUsed", used.index(EXTENSION)))


add_codes(BRAGG_CODES)
RULES: Rules = {"glTF": (_layers,)}
