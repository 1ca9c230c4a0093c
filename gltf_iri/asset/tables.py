"""The property tables of core glTF 2.0 as rows: what objects may hold, defaults, ranges, references.

The structural check and the validator read these rows. Materials are missing on purpose: their rows stand in
`gltf_iri.material`, beside the code that reads them. Numbers are those of the glTF 2.0 specification,
chapter 5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import Any, Final

from gltf_iri.asset.formats import COMPONENT_BYTES, TYPE_SHAPE

__all__ = ["EXCLUSIVE", "NAMED_BY_TYPE", "OBJECTS", "ONE_OF", "Kind", "Row", "Shape"]


class Kind(Enum):
    """What one value is."""

    INTEGER = auto()
    NUMBER = auto()
    FLAG = auto()
    TEXT = auto()
    INDEX = auto()  # into the array `refers_to`
    OBJECT = auto()  # with the table `table`


class Shape(Enum):
    """How many values a property holds."""

    ONE = auto()
    ARRAY = auto()
    MAP = auto()  # an object whose keys are free: the attributes of a primitive
    ARRAY_OF_MAPS = auto()  # morph targets


@dataclass(frozen=True, slots=True)
class Row:
    """One property of one object."""

    key: str
    kind: Kind
    shape: Shape = Shape.ONE
    required: bool = False
    default: Any = None
    low: float | None = None
    high: float | None = None
    low_is_excluded: bool = False
    multiple_of: int | None = None
    choices: tuple[int | str, ...] = ()
    is_open: bool = False  # extensions may add choices
    refers_to: str = ""  # a top-level array, or "animation.samplers" for the animation's own
    table: str = ""  # of an OBJECT, or "" where the core checks the type only
    min_items: int = 1
    max_items: int | None = None
    is_unique: bool = False
    needs: str = ""  # a sibling without which the property means nothing
    also_allowed: float | None = None  # one legal number outside [low, high]
    pattern: str = ""  # the whole of a TEXT matches this regular expression
    colour_space: str = ""  # of a texture: "srgb" where its colours are stored so
    counts_as_use: bool = True  # of an index: what it refers to is used by it
    is_per_component: bool = False  # an array as long as the accessor's elements have components


def _text(
    key: str, *choices: str, required: bool = False, default: str | None = None, is_open: bool = False
) -> Row:
    return Row(key, Kind.TEXT, required=required, default=default, choices=choices, is_open=is_open)


def _integer(key: str, low: int | None = None, *, required: bool = False, default: int | None = None) -> Row:
    return Row(key, Kind.INTEGER, required=required, default=default, low=low)


def _enum(key: str, *choices: int, required: bool = False, default: int | None = None) -> Row:
    return Row(key, Kind.INTEGER, required=required, default=default, choices=choices)


def _above_zero(key: str, *, required: bool = False) -> Row:
    return Row(key, Kind.NUMBER, required=required, low=0.0, low_is_excluded=True)


def _numbers(key: str, *default: float, low: float | None = None, high: float | None = None) -> Row:
    count = len(default)
    return Row(
        key, Kind.NUMBER, Shape.ARRAY, default=default, low=low, high=high, min_items=count, max_items=count
    )


def _index(key: str, refers_to: str, *, required: bool = False, needs: str = "") -> Row:
    return Row(key, Kind.INDEX, required=required, low=0, refers_to=refers_to, needs=needs)


def _indices(key: str, refers_to: str, *, required: bool = False) -> Row:
    return Row(key, Kind.INDEX, Shape.ARRAY, required=required, low=0, refers_to=refers_to, is_unique=True)


def _object(key: str, table: str, *, required: bool = False) -> Row:
    return Row(key, Kind.OBJECT, required=required, table=table)


def _objects(key: str, table: str, *, required: bool = False) -> Row:
    return Row(key, Kind.OBJECT, Shape.ARRAY, required=required, table=table)


_NAME = _text("name")
_VERSION = r"[0-9]+\.[0-9]+"
_WRAP = (33071, 33648, 10497)  # clamp to edge, mirrored repeat, repeat
_BYTE_OFFSET = _integer("byteOffset", 0, default=0)
_EXTENSION_NAMES = Row("extensionsUsed", Kind.TEXT, Shape.ARRAY, is_unique=True)

OBJECTS: Final[Mapping[str, tuple[Row, ...]]] = {
    "glTF": (
        _object("asset", "asset", required=True),
        _EXTENSION_NAMES,
        replace(_EXTENSION_NAMES, key="extensionsRequired"),
        _objects("accessors", "accessor"),
        _objects("animations", "animation"),
        _objects("buffers", "buffer"),
        _objects("bufferViews", "bufferView"),
        _objects("cameras", "camera"),
        _objects("images", "image"),
        _objects("materials", ""),
        _objects("meshes", "mesh"),
        _objects("nodes", "node"),
        _objects("samplers", "sampler"),
        _index("scene", "scenes", needs="scenes"),
        _objects("scenes", "scene"),
        _objects("skins", "skin"),
        _objects("textures", "texture"),
    ),
    "asset": (
        _text("copyright"),
        _text("generator"),
        Row("version", Kind.TEXT, required=True, pattern=_VERSION),
        Row("minVersion", Kind.TEXT, pattern=_VERSION),
    ),
    "accessor": (
        _NAME,
        _index("bufferView", "bufferViews"),
        replace(_BYTE_OFFSET, needs="bufferView"),
        _enum("componentType", *COMPONENT_BYTES, required=True),
        Row("normalized", Kind.FLAG, default=False),
        _integer("count", 1, required=True),
        _text("type", *TYPE_SHAPE, required=True),
        Row("max", Kind.NUMBER, Shape.ARRAY, max_items=16, is_per_component=True),
        Row("min", Kind.NUMBER, Shape.ARRAY, max_items=16, is_per_component=True),
        _object("sparse", "accessor.sparse"),
    ),
    "accessor.sparse": (
        _integer("count", 1, required=True),
        _object("indices", "accessor.sparse.indices", required=True),
        _object("values", "accessor.sparse.values", required=True),
    ),
    "accessor.sparse.indices": (
        _index("bufferView", "bufferViews", required=True),
        _BYTE_OFFSET,
        _enum("componentType", 5121, 5123, 5125, required=True),
    ),
    "accessor.sparse.values": (_index("bufferView", "bufferViews", required=True), _BYTE_OFFSET),
    "animation": (
        _NAME,
        _objects("channels", "animation.channel", required=True),
        _objects("samplers", "animation.sampler", required=True),
    ),
    "animation.channel": (
        _index("sampler", "animation.samplers", required=True),
        _object("target", "animation.channel.target", required=True),
    ),
    "animation.channel.target": (
        _index("node", "nodes"),
        _text("path", "translation", "rotation", "scale", "weights", required=True, is_open=True),
    ),
    "animation.sampler": (
        _index("input", "accessors", required=True),
        _text("interpolation", "LINEAR", "STEP", "CUBICSPLINE", default="LINEAR"),
        _index("output", "accessors", required=True),
    ),
    "buffer": (_NAME, _text("uri"), _integer("byteLength", 1, required=True)),
    "bufferView": (
        _NAME,
        _index("buffer", "buffers", required=True),
        _BYTE_OFFSET,
        _integer("byteLength", 1, required=True),
        Row("byteStride", Kind.INTEGER, low=4, high=252, multiple_of=4),
        _enum("target", 34962, 34963),
    ),
    "camera": (
        _NAME,
        _text("type", "perspective", "orthographic", required=True),
        _object("perspective", "camera.perspective"),
        _object("orthographic", "camera.orthographic"),
    ),
    "camera.perspective": (
        _above_zero("aspectRatio"),
        _above_zero("yfov", required=True),
        _above_zero("zfar"),
        _above_zero("znear", required=True),
    ),
    "camera.orthographic": (
        Row("xmag", Kind.NUMBER, required=True),
        Row("ymag", Kind.NUMBER, required=True),
        _above_zero("zfar", required=True),
        Row("znear", Kind.NUMBER, required=True, low=0.0),
    ),
    "image": (
        _NAME,
        _text("uri"),
        _text("mimeType", "image/jpeg", "image/png", is_open=True),
        _index("bufferView", "bufferViews", needs="mimeType"),
    ),
    "mesh": (
        _NAME,
        _objects("primitives", "mesh.primitive", required=True),
        Row("weights", Kind.NUMBER, Shape.ARRAY),
    ),
    "mesh.primitive": (
        Row("attributes", Kind.INDEX, Shape.MAP, required=True, low=0, refers_to="accessors"),
        _index("indices", "accessors"),
        _index("material", "materials"),
        _enum("mode", 0, 1, 2, 3, 4, 5, 6, default=4),
        Row("targets", Kind.INDEX, Shape.ARRAY_OF_MAPS, low=0, refers_to="accessors"),
    ),
    "node": (
        _NAME,
        _index("camera", "cameras"),
        _indices("children", "nodes"),
        _index("skin", "skins", needs="mesh"),
        _numbers("matrix", 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
        _index("mesh", "meshes"),
        _numbers("rotation", 0, 0, 0, 1, low=-1.0, high=1.0),
        _numbers("scale", 1, 1, 1),
        _numbers("translation", 0, 0, 0),
        Row("weights", Kind.NUMBER, Shape.ARRAY, needs="mesh"),
    ),
    "sampler": (
        _NAME,
        _enum("magFilter", 9728, 9729),
        _enum("minFilter", 9728, 9729, 9984, 9985, 9986, 9987),
        _enum("wrapS", *_WRAP, default=10497),
        _enum("wrapT", *_WRAP, default=10497),
    ),
    "scene": (_NAME, _indices("nodes", "nodes")),
    "skin": (
        _NAME,
        _index("inverseBindMatrices", "accessors"),
        replace(_index("skeleton", "nodes"), counts_as_use=False),
        _indices("joints", "nodes", required=True),
    ),
    "texture": (_NAME, _index("sampler", "samplers"), _index("source", "images")),
}

# (property, others): the property and any of the others exclude each other.
EXCLUSIVE: Final[Mapping[str, tuple[tuple[str, tuple[str, ...]], ...]]] = {
    "camera": (("perspective", ("orthographic",)),),
    "image": (("uri", ("bufferView",)),),
    "node": (("matrix", ("translation", "rotation", "scale")),),
}

# At least one of these properties must be there.
ONE_OF: Final[Mapping[str, tuple[str, ...]]] = {"image": ("uri", "bufferView")}

# Objects whose property "type" names another property that must then be there.
NAMED_BY_TYPE: Final = frozenset({"camera"})
