"""The property rows of extensions that no dataclass states, and on which objects each extension stands.

The road passes most of these over; the validator reads them. Materials' own extensions stand in
`gltf_iri.material`, lights in `gltf_iri.scene.light`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from gltf_iri.asset.tables import Kind, Row, Shape

__all__ = ["EXTENSIONS", "EXTENSION_OBJECTS", "PARTS", "Extension"]


@dataclass(frozen=True, slots=True)
class Extension:
    """Where an extension's objects stand, and how it goes with others.

    objects : name of the object that carries it to the table of what it carries.
    is_required : it means nothing to a reader that does not know it, so it must stand in extensionsRequired.
    stands_alone : it replaces the shading that other extensions of the same object would change.
    widens : values that it allows beside those of the core, as (table, property, value).
    """

    objects: Mapping[str, str]
    is_required: bool = False
    stands_alone: bool = False
    widens: tuple[tuple[str, str, str], ...] = ()


def _factor(key: str) -> Row:
    return Row(key, Kind.NUMBER, default=1.0, low=0.0, high=1.0)


def _color(key: str, *default: float) -> Row:
    count = len(default)
    return Row(
        key,
        Kind.NUMBER,
        Shape.ARRAY,
        default=default,
        low=0.0,
        high=1.0,
        min_items=count,
        max_items=count,
    )


EXTENSION_OBJECTS: Final[Mapping[str, tuple[Row, ...]]] = {
    "EXT_texture_webp": (Row("source", Kind.INDEX, low=0, refers_to="images"),),
    "KHR_animation_pointer": (Row("pointer", Kind.TEXT, required=True, pattern=r"(/([^~/]++|~0|~1)*+)*+"),),
    "KHR_lights_punctual": (
        Row("lights", Kind.OBJECT, Shape.ARRAY, required=True, table="KHR_lights_punctual.light"),
    ),
    "KHR_lights_punctual.node": (
        Row("light", Kind.INDEX, required=True, low=0, refers_to="KHR_lights_punctual.lights"),
    ),
    "KHR_materials_pbrSpecularGlossiness": (
        _color("diffuseFactor", 1.0, 1.0, 1.0, 1.0),
        Row("diffuseTexture", Kind.OBJECT, table="textureInfo", colour_space="srgb"),
        _color("specularFactor", 1.0, 1.0, 1.0),
        _factor("glossinessFactor"),
        Row("specularGlossinessTexture", Kind.OBJECT, table="textureInfo", colour_space="srgb"),
    ),
    "KHR_materials_variants": (
        Row("variants", Kind.OBJECT, Shape.ARRAY, required=True, table="KHR_materials_variants.variant"),
    ),
    "KHR_materials_variants.variant": (Row("name", Kind.TEXT, required=True),),
    "KHR_materials_variants.primitive": (
        Row("mappings", Kind.OBJECT, Shape.ARRAY, required=True, table="KHR_materials_variants.mapping"),
    ),
    "KHR_materials_variants.mapping": (
        Row("name", Kind.TEXT),
        Row(
            "variants",
            Kind.INDEX,
            Shape.ARRAY,
            required=True,
            low=0,
            refers_to="KHR_materials_variants.variants",
            is_unique=True,
        ),
        Row("material", Kind.INDEX, required=True, low=0, refers_to="materials"),
    ),
    "KHR_mesh_quantization": (),
    "KHR_node_visibility": (Row("visible", Kind.FLAG, default=True),),
}

# Properties that are read only of an object whose "type" names them.
PARTS: Final[Mapping[str, tuple[str, ...]]] = {"KHR_lights_punctual.light": ("spot",)}

EXTENSIONS: Final[Mapping[str, Extension]] = {
    "EXT_texture_webp": Extension(
        {"texture": "EXT_texture_webp"}, widens=(("image", "mimeType", "image/webp"),)
    ),
    "KHR_animation_pointer": Extension(
        {"animation.channel.target": "KHR_animation_pointer"},
        widens=(("animation.channel.target", "path", "pointer"),),
    ),
    "KHR_lights_punctual": Extension({"glTF": "KHR_lights_punctual", "node": "KHR_lights_punctual.node"}),
    "KHR_materials_pbrSpecularGlossiness": Extension(
        {"material": "KHR_materials_pbrSpecularGlossiness"}, stands_alone=True
    ),
    "KHR_materials_unlit": Extension({"material": "KHR_materials_unlit"}, stands_alone=True),
    "KHR_materials_variants": Extension(
        {"glTF": "KHR_materials_variants", "mesh.primitive": "KHR_materials_variants.primitive"}
    ),
    "KHR_mesh_quantization": Extension({}, is_required=True),
    "KHR_node_visibility": Extension({"node": "KHR_node_visibility"}),
}
