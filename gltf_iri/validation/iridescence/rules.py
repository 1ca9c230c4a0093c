"""The films of a file, with what else counts: animations, vertex colours, other readers of images."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.iridescence.codes import NAME
from gltf_iri.validation.iridescence.effect import effect_of
from gltf_iri.validation.iridescence.film import film_of
from gltf_iri.validation.iridescence.images import Steps, images_of
from gltf_iri.validation.iridescence.readers import readers_of
from gltf_iri.validation.pointers.rules import animated_properties
from gltf_iri.validation.rules.data_textures import colour_images, conflicts_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.iridescence.film import Film
    from gltf_iri.validation.issue import Issue

__all__ = ["films", "pictures"]

# Extensions that the text excludes on the same material.
_EXCLUDED = ("KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit")

_CONFLICTS = {
    "overridden": "IRI_IRIDESCENCE_TEXCOORD_OVERRIDDEN",
    "decoded": "IRI_IRIDESCENCE_COLOUR_SPACE",
}


def films(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell what the file's numbers say of its films."""
    if not any(_names_it(material.raw) for material in asset.array("materials") if material is not None):
        names = root.raw.get("extensionsUsed", ())
        yield issue("IRI_IRIDESCENCE_UNUSED", root.at("extensionsUsed", names.index(NAME)))
        return
    colours = colour_images(asset)
    for material, film in _films_of(asset):
        excluded = [name for name in _EXCLUDED if name in material.extensions]
        for name in excluded:
            remark = issue("IRI_IRIDESCENCE_EXCLUDED", material.extensions[NAME].pointer, other=name)
            yield from [remark] if film is None else _told(film, [remark], asset)
        if film is not None and not excluded:
            yield from _told(film, effect_of(film), asset)
            if film.is_active:
                yield from _told(film, readers_of(film), asset)
                for info in (film.strength, film.thickness):
                    if info is not None:
                        yield from _told(film, conflicts_of(info, asset, colours, **_CONFLICTS), asset)


def pictures(asset: Asset) -> Iterator[Issue]:
    """Tell what the files of the textures make of the films."""
    if not asset.images:
        return
    steps = Steps()
    for material, film in _films_of(asset, needing="iridescenceThicknessTexture"):
        if film is not None and film.is_active and material.extensions.keys().isdisjoint(_EXCLUDED):
            yield from _told(film, images_of(film, asset, steps), asset)


def _films_of(asset: Asset, *, needing: str = "") -> Iterator[tuple[Entry, Film | None]]:
    """Yield materials with a film, and the film or None if it is broken; only those that state `needing`."""
    moved: dict[str, list[tuple[str, ...]]] = {}
    for tokens in animated_properties(asset):
        if tokens[0] == "materials":
            moved.setdefault(f"/materials/{tokens[1]}", []).append(tokens[2:])
    painted = _painted(asset)
    for position, material in enumerate(asset.array("materials")):
        extension = material.extensions.get(NAME) if material is not None else None
        if material is not None and extension is not None and (not needing or needing in extension):
            paths = moved.get(material.pointer, ())
            yield material, film_of(extension, material, paths, is_painted=position in painted)


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
