"""glTF textures: which image, and how it is wrapped and filtered."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.asset.words import kind_of, shown
from gltf_iri.errors import AssetError

__all__ = ["Texture", "read_texture"]

_WEBP: Final = "EXT_texture_webp"

# §5.26: without a filter the renderer chooses; trilinear is what OpenGL gives the fewest artefacts with.
_LINEAR: Final = 9729
_LINEAR_MIPMAP_LINEAR: Final = 9987
_REPEAT: Final = 10497


@dataclass(frozen=True, slots=True)
class Texture:
    """An image and its sampler, as OpenGL enums with glTF's defaults filled in."""

    image: int
    wrap_s: int = _REPEAT
    wrap_t: int = _REPEAT
    mag_filter: int = _LINEAR
    min_filter: int = _LINEAR_MIPMAP_LINEAR


def read_texture(root: Mapping[str, Any], index: int) -> Texture:
    """Read a texture of checked JSON; AssetError if the only image it offers is in a format that is not read.

    EXT_texture_webp takes precedence over the core source, which is its fallback.
    """
    pointer = f"/textures/{index}"
    texture = root["textures"][index]
    sampler = root["samplers"][texture["sampler"]] if "sampler" in texture else {}
    return Texture(
        image=_source(root, texture, pointer),
        wrap_s=sampler.get("wrapS", _REPEAT),
        wrap_t=sampler.get("wrapT", _REPEAT),
        mag_filter=sampler.get("magFilter", _LINEAR),
        min_filter=sampler.get("minFilter", _LINEAR_MIPMAP_LINEAR),
    )


def _source(root: Mapping[str, Any], texture: Mapping[str, Any], pointer: str) -> int:
    extensions = texture.get("extensions", {})
    if "source" in extensions.get(_WEBP, {}):
        source = extensions[_WEBP]["source"]
        place = f"{pointer}/extensions/{_WEBP}/source"
        if isinstance(source, bool) or not isinstance(source, int | float) or source != int(source):
            found = kind_of(source) if isinstance(source, dict | list) else shown(source)
            raise AssetError(f"{found} stands where an index is wanted", pointer=place)
        if not 0 <= source < len(root.get("images", [])):
            raise AssetError(f"the index {shown(source)} points beyond the images", pointer=place)
        return int(source)
    if "source" in texture:
        return int(texture["source"])
    others = " and ".join(map(shown, extensions))
    raise AssetError(
        f"the texture has an image only through {others}, which is not read; add a PNG, JPEG or WebP"
        if others
        else "the texture has no image; give it a 'source'",
        pointer=pointer,
    )
