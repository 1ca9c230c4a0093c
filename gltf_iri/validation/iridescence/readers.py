"""Films that the extension's text leaves undefined, or that renderers draw apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.iridescence.film import index_of
from gltf_iri.validation.tables import value_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.iridescence.film import Base, Film
    from gltf_iri.validation.issue import Issue

__all__ = ["readers_of"]

# The text adds 0.0001 before it divides by 1 − √F0; single precision rounds a little less up to it.
_UNDEFINED_F0 = 0.9999 - 2.0**-23

_CHANNELS = ("red", "green", "blue")

_CLEARCOAT = "KHR_materials_clearcoat"

# Babylon.js' index of a coat (9.34, pbrBlockIridescence and pbrClearCoatConfiguration).
_COAT_IOR = 1.5


def readers_of(film: Film) -> Iterator[Issue]:
    """Yield what readers make different films of."""
    for base in film.bases:
        yield from _mirror(base, film)
    if not film.is_under_air and "iridescenceIor" not in film.moved:
        yield from _order(film)
    yield from _clearcoat(film)


def _mirror(base: Base, film: Film) -> Iterator[Issue]:
    channels = [name for name, f0 in zip(_CHANNELS, base.f0, strict=True) if f0 >= _UNDEFINED_F0]
    if not channels or not base.is_known:
        return
    if len(channels) == len(_CHANNELS) and len(film.bases) == 1:
        yield issue("IRI_IRIDESCENCE_BASE_REFLECTS_ALL", base.pointer, lobe=base.lobe)
    else:
        told = " and ".join(channels)
        yield issue("IRI_IRIDESCENCE_BASE_F0_UNDEFINED", base.pointer, lobe=base.lobe, channels=told)


def _order(film: Film) -> Iterator[Issue]:
    for base in film.bases:
        is_below = not base.has_index(film.ior) and any(index_of(f0) < film.ior for f0 in base.f0)
        if base.is_known and is_below:
            place = film.at("iridescenceIor")
            yield issue("IRI_IRIDESCENCE_INDEX_ORDER", place, ior=film.ior, lobe=base.lobe)
            return


def _clearcoat(film: Film) -> Iterator[Issue]:
    coat = film.material.extensions.get(_CLEARCOAT)
    if coat is None or value_of(coat, "clearcoatFactor") == 0.0:
        return
    reflected = ""
    if film.ior < _COAT_IOR and "iridescenceIor" not in film.moved:
        reflected = f", above the film's {film.ior:g}, and reflects all grazing light"
    yield issue("IRI_IRIDESCENCE_UNDER_CLEARCOAT", film.extension.pointer, reflected=reflected)
