"""Which glTF extensions the picture honours, which are noted, and which refuse the file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError
from gltf_iri.material.fields import Kind, properties
from gltf_iri.material.material import Material
from gltf_iri.scene.light import PunctualLight

__all__ = ["check_extensions", "supported_extensions"]

# What the asset folder decodes without a property row of its own.
_DECODED: Final = ("EXT_texture_webp", "KHR_mesh_quantization")

# Known and harmless to pass over, with what the picture then shows.
_PASSED_OVER: Final[Mapping[str, str]] = {
    "KHR_animation_pointer": "KHR_animation_pointer animates; animations are not played.",
    "KHR_materials_variants": "KHR_materials_variants offers other materials; the default ones are drawn.",
}

# What to do about the extensions that a file can be exported without.
_REMEDIES: Final[Mapping[str, str]] = {
    "KHR_draco_mesh_compression": "export it without mesh compression",
    "EXT_meshopt_compression": "export it without mesh compression",
    "KHR_meshopt_compression": "export it without mesh compression",
    "KHR_texture_basisu": "export its textures as PNG, JPEG or WebP instead of KTX2",
}

# More names than this make no sentence.
_NAMED: Final = 5


def supported_extensions() -> tuple[str, ...]:
    """Return the names of the extensions that may be required, sorted."""
    return tuple(sorted({*_stated(Material), PunctualLight.EXTENSION, *_DECODED, *_PASSED_OVER}))


def check_extensions(document: Mapping[str, Any], notes: list[str]) -> None:
    """Raise AssetError for a required extension that is not supported, and note the optional ones."""
    supported = supported_extensions()
    required: Sequence[str] = document.get("extensionsRequired", ())
    missing = [name for name in required if name not in supported]
    if missing:
        remedies = dict.fromkeys(_REMEDIES[name] for name in missing if name in _REMEDIES)
        advice = " and ".join(remedies) or "export it without"
        named = [shown(name) for name in missing[:_NAMED]]
        if len(missing) > _NAMED:
            named.append(f"and {len(missing) - _NAMED} more")
        raise AssetError(
            f"the file requires {', '.join(named)}, which this program does not read; {advice}",
            pointer=f"/extensionsRequired/{required.index(missing[0])}",
        )
    for name in document.get("extensionsUsed", ()):
        if name in _PASSED_OVER:
            notes.append(_PASSED_OVER[name])
        elif name not in supported:
            notes.append(f"Drawn without {shown(name)}, which this program does not read.")


def _stated(cls: type) -> Iterator[str]:
    """Yield the name of every extension that the rows of `cls` state, at any depth."""
    for _, row in properties(cls):
        if row.cls is None:
            continue
        if row.kind is Kind.EXTENSION:
            yield row.key
        yield from _stated(row.cls)
