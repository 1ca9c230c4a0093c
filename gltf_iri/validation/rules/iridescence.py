"""KHR_materials_iridescence: films that do nothing, cannot be seen, or look different everywhere.

One rule for the whole file: animations, vertex colours and what else reads an image are gathered once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import add_codes, issue
from gltf_iri.validation.iridescence_codes import IRIDESCENCE_CODES
from gltf_iri.validation.rules.iridescence_effect import effect_of
from gltf_iri.validation.rules.iridescence_film import NAME, film_of
from gltf_iri.validation.rules.iridescence_images import Steps, images_of
from gltf_iri.validation.rules.iridescence_readers import readers_of
from gltf_iri.validation.rules.iridescence_textures import colour_images, textures_of
from gltf_iri.validation.rules.pointers import animated_properties

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.iridescence_film import Film
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["DATA_RULES", "RULES"]

# Extensions that the text excludes on the same material.
_EXCLUDED = ("KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit")


def _films(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell what the file's numbers say of its films."""
    if NAME not in asset.declared:
        return
    if not any(_names_it(material.raw) for material in asset.array("materials") if material is not None):
        names = root.raw.get("extensionsUsed", ())
        yield issue("IRI_IRIDESCENCE_UNUSED", root.at("extensionsUsed", names.index(NAME)))
        return
    colours = colour_images(asset)
    for film in _films_of(asset):
        excluded = [name for name in _EXCLUDED if name in film.material.extensions]
        for name in excluded:
            yield from _told(
                film, [issue("IRI_IRIDESCENCE_EXCLUDED", film.extension.pointer, other=name)], asset
            )
        if not excluded:
            yield from _told(film, effect_of(film), asset)
            if film.is_active:
                yield from _told(film, readers_of(film), asset)
                yield from _told(film, textures_of(film, asset, colours), asset)


def _pictures(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell what the files of the textures make of the films."""
    if NAME not in asset.declared:
        return
    steps = Steps()
    for film in _films_of(asset):
        if film.is_active and not any(name in film.material.extensions for name in _EXCLUDED):
            yield from _told(film, images_of(film, asset, steps), asset)


def _films_of(asset: Asset) -> Iterator[Film]:
    moved: dict[str, list[tuple[str, ...]]] = {}
    for tokens in animated_properties(asset):
        if tokens[0] == "materials":
            moved.setdefault(f"/materials/{tokens[1]}", []).append(tokens[2:])
    painted = _painted(asset)
    for position, material in enumerate(asset.array("materials")):
        if material is not None:
            film = film_of(material, moved.get(material.pointer, ()), is_painted=position in painted)
            if film is not None:
                yield film


def _painted(asset: Asset) -> set[int]:
    """Return the materials of primitives whose vertices have colours."""
    return {
        primitive["material"]
        for mesh in asset.array("meshes")
        if mesh is not None
        for primitive in mesh.get("primitives", ())
        if primitive is not None and "material" in primitive and "COLOR_0" in primitive.get("attributes", ())
    }


def _told(film: Film, remarks: Iterable[Issue], asset: Asset) -> Iterator[Issue]:
    """Yield the remarks, with what they mean in ΔE where the user wants to know."""
    if not asset.options.optics:
        yield from remarks
        return
    from gltf_iri.validation.optics.film_consequences import with_consequence

    for remark in remarks:
        yield with_consequence(remark, film)


def _names_it(material: dict[str, object]) -> bool:
    extensions = material.get("extensions")
    return isinstance(extensions, dict) and NAME in extensions


add_codes(IRIDESCENCE_CODES)
RULES: Rules = {"glTF": (_films,)}
DATA_RULES: Rules = {"glTF": (_pictures,)}
