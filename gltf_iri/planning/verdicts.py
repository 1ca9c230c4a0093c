"""Every verdict on one material, gathered from the files that judge its parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.planning.bragg import bragg_verdicts, verdicts_below
from gltf_iri.planning.core import core_verdicts
from gltf_iri.planning.effects import MATERIAL_EFFECTS, Effect
from gltf_iri.planning.extensions import extension_verdicts
from gltf_iri.planning.film import film_verdicts
from gltf_iri.planning.method import Method
from gltf_iri.planning.reach import Reach
from gltf_iri.planning.transmission import transmission_verdicts
from gltf_iri.planning.verdict import Skip, Verdict
from gltf_iri.planning.way import Way

__all__ = ["material_verdicts"]

# What an unlit material still does.
_SEEN_UNLIT: Final = frozenset(
    {
        Effect.UNLIT,
        Effect.BASE_COLOR_TEXTURE,
        Effect.ALPHA_MASK,
        Effect.ALPHA_BLEND,
        Effect.DOUBLE_SIDED,
    }
)


def material_verdicts(
    material: Material, method: Method, reach: Reach | None, way: Way | None, folded: Mapping[Effect, str]
) -> dict[Effect, Verdict]:
    """Return the verdict on each of MATERIAL_EFFECTS, in their order; see `plan_material`."""
    judged = dict(_judged(material, method, reach, way, folded))
    judged |= dict(verdicts_below(material, judged))
    return {effect: judged[effect] for effect in MATERIAL_EFFECTS}


def _judged(
    material: Material, method: Method, reach: Reach | None, way: Way | None, folded: Mapping[Effect, str]
) -> Iterator[tuple[Effect, Verdict]]:
    for verdicts in (
        core_verdicts(material, folded),
        extension_verdicts(material, folded),
        film_verdicts(material, method, reach, way, folded),
        bragg_verdicts(material, folded),
        transmission_verdicts(material, folded),
    ):
        for effect, verdict in verdicts:
            yield effect, _under_unlit(effect, verdict) if material.unlit is not None else verdict


def _under_unlit(effect: Effect, verdict: Verdict) -> Verdict:
    if effect in _SEEN_UNLIT or (isinstance(verdict, Skip) and verdict.is_absent):
        return verdict
    if effect is Effect.IRIDESCENCE:
        return Skip(f"the material is unlit, which {Iridescence.EXTENSION} excludes")
    return Skip("the material is unlit")
