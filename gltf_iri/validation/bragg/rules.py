"""EXT_materials_bragg, all of it: what the text says MUST of, what has no effect, pictures, animations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from gltf_iri.asset.limits import GREATEST_NUMBER
from gltf_iri.material.bragg_limits import (
    BRAGG_CELLS_MAX,
    BRAGG_IOR_ACCEPTED,
    BRAGG_IOR_MAX,
    BRAGG_LAYERS_MAX,
    BRAGG_PERIOD_ACCEPTED_NM,
    BRAGG_PERIOD_MAX_NM,
)
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.bragg.animation import animated_indices
from gltf_iri.validation.bragg.effects import effects
from gltf_iri.validation.bragg.stack import EXTENSION, Layer, Stack, stacks
from gltf_iri.validation.bragg.textures import Steps, conflicts, pictures
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.data_textures import colour_images

__all__ = ["data", "layers"]

_EXCLUDED = ("KHR_materials_iridescence", "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness")

# Of a layer: property, what every reader accepts, what this one draws.
_LIMITS = (
    ("ior1", BRAGG_IOR_ACCEPTED, BRAGG_IOR_MAX),
    ("ior2", BRAGG_IOR_ACCEPTED, BRAGG_IOR_MAX),
    ("periodMinimum", BRAGG_PERIOD_ACCEPTED_NM, BRAGG_PERIOD_MAX_NM),
    ("periodMaximum", BRAGG_PERIOD_ACCEPTED_NM, BRAGG_PERIOD_MAX_NM),
    ("cells", BRAGG_CELLS_MAX, BRAGG_CELLS_MAX),
)


def layers(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell what the file's numbers say of its layers."""
    found = list(stacks(asset))
    colours = colour_images(asset) if found else {}
    yield from _told(((stack, _of_stack(stack, asset, colours)) for stack in found), asset)
    yield from _declarations(root, is_used=bool(found))


def _of_stack(stack: Stack, asset: Asset, colours: dict[int, str]) -> Iterator[Issue]:
    yield from _exclusions(stack)
    yield from _first_indices(stack)
    if not _excluded_by(stack):
        yield from _limits(stack)
        yield from effects(stack)
        if stack.is_active:
            yield from conflicts(stack, asset, colours)


def data(asset: Asset) -> Iterator[Issue]:
    """Tell what pictures and animations make of the layers."""
    if asset.images or asset.array("animations"):
        steps = Steps()
        found = list(stacks(asset))
        drawn = (stack for stack in found if stack.is_active and not _excluded_by(stack))
        yield from _told(((stack, pictures(stack, asset, steps)) for stack in drawn), asset)
        yield from animated_indices(found, asset)


def _told(remarks: Iterable[tuple[Stack, Iterable[Issue]]], asset: Asset) -> Iterator[Issue]:
    """Yield the remarks on each stack, with what they mean in ΔE where the user wants to know."""
    if not asset.options.optics:
        for _, of_stack in remarks:
            yield from of_stack
        return
    from gltf_iri.validation.optics.layer_consequences import Consequences

    consequences = Consequences()
    for stack, of_stack in remarks:
        for remark in of_stack:
            yield consequences.added_to(remark, stack)


def _exclusions(stack: Stack) -> Iterator[Issue]:
    for other in _excluded_by(stack):
        yield issue("IRI_BRAGG_EXCLUDED", stack.entry.pointer, other=other)


def _excluded_by(stack: Stack) -> tuple[str, ...]:
    others = stack.material.raw["extensions"]
    return tuple(name for name in _EXCLUDED if name in others)


def _first_indices(stack: Stack) -> Iterator[Issue]:
    """Tell of films that bend light which goes on to something that does not forget its direction."""
    host = stack.host_ior
    for layer in stack.layers:
        # What is broken is told of already.
        if layer.ior1 is not None and host is not None and layer.ior1 != host:
            reason = stack.why_unbent(layer)
            if reason:
                place = layer.entry.at("ior1")
                yield issue("IRI_BRAGG_FIRST_INDEX", place, ior1=layer.ior1, host=host, reason=reason)


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
        value=f"{min(value, GREATEST_NUMBER):.6g}",
        accepted=f"{accepted:g}",
        drawn=f"{drawn:g}",
    )


def _declarations(root: Entry, *, is_used: bool) -> Iterator[Issue]:
    required, used = root.get("extensionsRequired", ()), root.get("extensionsUsed", ())
    if EXTENSION in required:
        yield issue("IRI_BRAGG_REQUIRED", root.at("extensionsRequired", required.index(EXTENSION)))
    if EXTENSION in used and not is_used:
        yield issue("IRI_BRAGG_UNUSED", root.at("extensionsUsed", used.index(EXTENSION)))
