"""What the images of a file hold: the least and the greatest value of each channel, looked up once an image.

Filtering and mipmaps interpolate between texels, wrapping repeats them, and a transform chooses among them: a
sampled value lies within these bounds whatever the sampler.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final
from weakref import WeakKeyDictionary

from gltf_iri.errors import AssetError
from gltf_iri.material.fields import ColourSpace
from gltf_iri.material.interface import SAMPLERS
from gltf_iri.material.material import Material
from gltf_iri.material.texture import TextureInfo
from gltf_iri.planning.reach import Span
from gltf_iri.planning.texel_spread import Spread, texel_spread
from gltf_iri.planning.verdict import UV_SETS_READ

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gltf_iri.asset.document import Document

__all__ = ["TextureSpans", "texture_spans", "texture_spread", "unread_images"]

_ANYTHING: Final = Span(0.0, 1.0)
_NOTHING: Final = Span.at(1.0)

# Texels that are looked at together: what is held besides the image stays small.
_STRIP_TEXELS: Final = 2**18


@dataclass(frozen=True, slots=True)
class TextureSpans:
    """What one of a material's textures can be sampled as, linear, in [0, 1].

    channels : those that the property reads, in the order in which it reads them.
    is_grey : True where R = G = B in every texel.
    """

    channels: tuple[Span, ...]
    is_grey: bool


@dataclass(frozen=True, slots=True)
class _Stored:
    """The least and greatest bytes of an image's four channels."""

    low: tuple[int, ...]
    high: tuple[int, ...]
    is_grey: bool


_SAMPLERS: Final = {sampler.slot: sampler for sampler in SAMPLERS}

_Looked = dict[int, _Stored | str]

# By image: what it holds, or the sentence that says why it cannot be read.
_SEEN: Final[WeakKeyDictionary[Document, _Looked]] = WeakKeyDictionary()

# By image and channel.
_SPREADS: Final[WeakKeyDictionary[Document, dict[tuple[int, int], Spread]]] = WeakKeyDictionary()


def texture_spans(slot: str, material: Material, document: Document | None) -> TextureSpans:
    """Return the spans of the texture in `slot` of material.interface.SAMPLERS, such as "base_color".

    They are 1 where there is no texture, or its UV set does not reach the shader, and [0, 1] where it cannot
    be read: its image is broken, or there is no `document`.
    """
    sampler = _SAMPLERS[slot]
    count, info = len(sampler.row.channels), sampler.read(material)
    if info is None or info.uv_set >= UV_SETS_READ:
        return TextureSpans((_NOTHING,) * count, is_grey=True)
    stored = None if document is None else _look(info, document)
    if stored is None:
        return TextureSpans((_ANYTHING,) * count, is_grey=False)
    channels = []
    for letter in sampler.row.channels:
        place = "rgba".index(letter)
        space = sampler.row.colour_space if letter != "a" else "linear"  # alpha is linear in every space
        channels.append(Span(_decoded(stored.low[place], space), _decoded(stored.high[place], space)))
    return TextureSpans(tuple(channels), stored.is_grey)


def texture_spread(slot: str, material: Material, document: Document | None) -> Spread:
    """Return how far the texture in `slot` varies within a pixel, by the first channel that it is read for.

    It is 0 where `texture_spans` is one value, and half of what bytes can hold where nobody knows.
    """
    (span, *_) = texture_spans(slot, material, document).channels
    sampler = _SAMPLERS[slot]
    info = sampler.read(material)
    if info is None or span.is_point:
        return Spread(0.0, 0.0)
    if document is None or _look(info, document) is None:
        # No distribution on a span has a greater standard deviation than half of it (Popoviciu).
        return Spread(0.5, 0.5)
    image, place = document.texture(info.texture).image, "rgba".index(sampler.row.channels[0])
    known = _SPREADS.setdefault(document, {})
    if (image, place) not in known:
        known[image, place] = texel_spread(document.image(image).pixels[..., place])
    return known[image, place]


def unread_images(document: Document) -> tuple[str, ...]:
    """Return a sentence for each image that was asked for and could not be read."""
    return tuple(told for told in _SEEN.get(document, {}).values() if isinstance(told, str))


def _look(info: TextureInfo, document: Document) -> _Stored | None:
    seen = _SEEN.setdefault(document, {})
    try:
        image = document.texture(info.texture).image
    except AssetError as error:
        seen[-1 - info.texture] = f"{error}"  # beside the images, which count from 0
        return None
    if image not in seen:
        try:
            seen[image] = _bounds(document.image(image).pixels)
        except AssetError as error:
            seen[image] = f"{error}"
    found = seen[image]
    return None if isinstance(found, str) else found


def _bounds(pixels: NDArray[np.uint8]) -> _Stored:
    """Return the bounds of (height, width, 4), strip by strip."""
    import numpy as np

    height, width = pixels.shape[:2]
    rows = max(1, _STRIP_TEXELS // max(width, 1))
    low, high, is_grey = np.full(4, 255, np.uint8), np.zeros(4, np.uint8), True
    for top in range(0, height, rows):
        strip = pixels[top : top + rows]
        # Down the rows first: there the bytes of all columns lie side by side.
        low = np.minimum(low, strip.min(axis=0).min(axis=0))
        high = np.maximum(high, strip.max(axis=0).max(axis=0))
        red, green, blue = (strip[..., channel] for channel in range(3))
        is_grey = is_grey and np.array_equal(red, green) and np.array_equal(green, blue)
    return _Stored(tuple(low.tolist()), tuple(high.tolist()), is_grey)


def _decoded(byte: int, space: ColourSpace) -> float:
    value = byte / 255.0
    if space != "srgb":
        return value
    from gltf_iri.colour.transfer import srgb_decode

    return float(srgb_decode(value))
