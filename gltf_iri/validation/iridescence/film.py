"""The film of a material as the file states it, and what it lies on: what the rules and the optics ask.

The renderer's plan asks the same questions of decoded assets (`gltf_iri.planning.film`); here textures are
not looked into, so whatever a texture multiplies is unknown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gltf_iri.asset.limits import GREATEST_NUMBER
from gltf_iri.validation.iridescence.codes import NAME
from gltf_iri.validation.tables import TABLES, value_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gltf_iri.validation.entry import Entry

    Colour = tuple[float, float, float]

__all__ = ["Base", "Film", "film_of", "index_of"]

_PBR = "material.pbrMetallicRoughness"
_IOR = "KHR_materials_ior"
_SPECULAR = "KHR_materials_specular"

# What moves the base under the film.
_OF_THE_BASE = {"pbrMetallicRoughness", _IOR, _SPECULAR}

_NUMBERS = (
    "iridescenceFactor",
    "iridescenceIor",
    "iridescenceThicknessMinimum",
    "iridescenceThicknessMaximum",
)

# Indices that single precision cannot tell apart are one: exporters write 1.33 as 1.3300000429153442.
_SAME_INDEX = 1e-6


class Base:
    """What the film lies on: the dielectric or the metallic lobe of its material.

    f0 : (R, G, B) of the reflectance straight on, under air.
    is_known : no texture, vertex colour or animation changes it; else `f0` is what they start from.
    pointer : where the value stands that decides.
    """

    __slots__ = ("f0", "is_known", "lobe", "pointer")

    def __init__(self, lobe: str, f0: Colour, pointer: str, *, is_known: bool) -> None:
        self.lobe = lobe
        self.f0 = f0
        self.pointer = pointer
        self.is_known = is_known

    def has_index(self, ior: float) -> bool:
        """Return whether a medium of the index `ior` reflects as this base does."""
        amplitude = (ior - 1.0) / (ior + 1.0)
        return self.is_known and all(abs(f0**0.5 - amplitude) < _SAME_INDEX for f0 in self.f0)


class Film:
    """KHR_materials_iridescence on one material.

    extension, material : the entries; none of the extension's numbers is broken.
    strength, thickness : the textureInfo objects, None where there is none.
    least_nm, greatest_nm : what the thickness lies between; without a texture both are the maximum.
    moved : the keys of its own numbers that animations change.
    bases : what it lies on; empty where the file is broken there.
    """

    __slots__ = (
        *("bases", "extension", "factor", "greatest_nm", "ior", "least_nm", "material", "maximum_nm"),
        *("minimum_nm", "moved", "strength", "thickness"),
    )

    def __init__(self, extension: Entry, material: Entry, moved: set[str], bases: tuple[Base, ...]) -> None:
        self.extension = extension
        self.material = material
        self.moved = moved
        self.bases = bases
        self.factor, self.ior, self.minimum_nm, self.maximum_nm = (
            min(value_of(extension, key), GREATEST_NUMBER) for key in _NUMBERS
        )
        self.strength: Entry | None = extension.get("iridescenceTexture")
        self.thickness: Entry | None = extension.get("iridescenceThicknessTexture")
        # A broken texture is one that will be mended.
        has_texture = "iridescenceThicknessTexture" in extension.raw
        ends = (self.minimum_nm if has_texture else self.maximum_nm, self.maximum_nm)
        self.least_nm, self.greatest_nm = min(ends), max(ends)

    def at(self, key: str) -> str:
        """Return the pointer of a property, or of the extension where the file leaves it out."""
        return self.extension.at(key) if key in self.extension.raw else self.extension.pointer

    @property
    def is_active(self) -> bool:
        """Whether there is a film at any time."""
        return self.factor > 0.0 or "iridescenceFactor" in self.moved

    @property
    def has_steady_thickness(self) -> bool:
        """Whether no animation changes it."""
        return self.moved.isdisjoint(_NUMBERS[2:])

    @property
    def is_under_air(self) -> bool:
        """Whether its index is the outside's."""
        return self.ior - 1.0 < _SAME_INDEX and "iridescenceIor" not in self.moved


def film_of(
    extension: Entry, material: Entry, moved: Iterable[tuple[str, ...]], *, is_painted: bool
) -> Film | None:
    """Return the film that `extension` puts on `material`, or None where its numbers are broken.

    moved : paths below the material that animations change.
    is_painted : vertices that bring colours of their own show this material.
    """
    if any(key in extension.raw and key not in extension for key in _NUMBERS):
        return None
    own = {path[-1] for path in moved if path[:2] == ("extensions", NAME)}
    is_still = not any(_OF_THE_BASE.intersection(path) for path in moved)
    return Film(extension, material, own, _bases(material, extension, is_still, is_painted=is_painted))


def index_of(f0: float) -> float:
    """Return the real index of a half-space with this reflectance under air."""
    root = f0**0.5
    return (1.0 + root) / (1.0 - root) if root < 1.0 else float("inf")


def _bases(material: Entry, film: Entry, is_still: bool, *, is_painted: bool) -> tuple[Base, ...]:
    pbr = material.get("pbrMetallicRoughness")
    parts = [pbr, *(material.extensions.get(name) for name in (_IOR, _SPECULAR))]
    if (pbr is None and "pbrMetallicRoughness" in material.raw) or any(map(_is_broken, parts)):
        return ()
    metallic, colour = (_value(pbr, _PBR, key) for key in ("metallicFactor", "baseColorFactor"))
    bases = []
    if metallic < 1.0 or not is_still or (pbr is not None and "metallicRoughnessTexture" in pbr.raw):
        bases.append(_dielectric(material, film, is_still))
    if metallic > 0.0 or not is_still:
        is_known = is_still and not is_painted and (pbr is None or "baseColorTexture" not in pbr.raw)
        pointer = pbr.at("baseColorFactor") if pbr is not None and "baseColorFactor" in pbr else film.pointer
        bases.append(Base("a metal", _colour(1.0, 1.0, colour), pointer, is_known=is_known))
    return tuple(bases)


def _dielectric(material: Entry, film: Entry, is_still: bool) -> Base:
    ior, specular = material.extensions.get(_IOR), material.extensions.get(_SPECULAR)
    index = min(_value(ior, _IOR, "ior"), GREATEST_NUMBER)
    f0 = 1.0 if index == 0.0 else ((index - 1.0) / (index + 1.0)) ** 2
    pointer = ior.at("ior") if ior is not None and "ior" in ior else film.pointer
    if specular is None:
        return Base("a dielectric", (f0, f0, f0), pointer, is_known=is_still)
    weight, tint = value_of(specular, "specularFactor"), value_of(specular, "specularColorFactor")
    is_known = is_still and specular.raw.keys().isdisjoint(("specularTexture", "specularColorTexture"))
    return Base("a dielectric", _colour(weight, f0, tint), pointer, is_known=is_known)


def _colour(weight: float, f0: float, tint: list[Any]) -> Colour:
    """Return weight · min(f0 · tint, 1), as KHR_materials_specular combines them."""
    red, green, blue = (weight * min(f0 * min(channel, GREATEST_NUMBER), 1.0) for channel in tint[:3])
    return red, green, blue


def _value(entry: Entry | None, table: str, key: str) -> Any:
    return TABLES[table].fields[key].default if entry is None else value_of(entry, key)


def _is_broken(entry: Entry | None) -> bool:
    """Return whether the file has a value there that cannot be used."""
    if entry is None:
        return False
    fields = TABLES[entry.table].fields
    return any(key in fields and key not in entry for key in entry.raw)
