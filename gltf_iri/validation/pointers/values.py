"""The values that an animation channel sets its property to, a block at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.data.access import blocks, elements_of
from gltf_iri.validation.data.normalised import columns_of
from gltf_iri.validation.tables import value_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.pointers.target import Target

__all__ = ["values_key", "values_of"]


def values_key(sampler: Entry, target: Target) -> tuple[object, ...]:
    """Return what `values_of` depends on: the same for two channels that take the same values."""
    return sampler.get("output"), value_of(sampler, "interpolation"), target.size


def values_of(sampler: Entry, target: Target, asset: Asset) -> Iterator[list[list[float]]]:
    """Yield blocks of the values for `target`, tangents left out, a list for each component.

    Nothing where they cannot be read, are of another size, or are arrays: those are weights of morph targets,
    which may be any numbers.
    """
    output = asset.get("accessors", sampler.get("output"))
    elements = elements_of(output, asset)
    if output is None or elements is None or elements.width != target.size or target.length:
        return
    # A spline's keyframe is an in-tangent, a value, and an out-tangent (glTF 2.0, appendix C), never cut by
    # the end of a block.
    start, step = (1, 3) if value_of(sampler, "interpolation") == "CUBICSPLINE" else (0, 1)
    for first in blocks(elements, asset, output.pointer):
        yield [column[start::step] for column in columns_of(elements, first)]
