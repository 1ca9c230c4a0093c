"""How one glTF property is stated: once, as a dataclass field that carries its row of the property table.

The parser, the generated shader interface, the plan, the validator and the property tables in the docs all
read these rows (`properties`); none of them repeats a key, a default or a range.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto
from typing import Any, Literal

__all__ = ["ColourSpace", "Kind", "Property", "choice", "extension", "flag", "index", "nested", "number"]
__all__ += ["nested_list", "properties", "reference", "text", "texture_info", "vector", "whole_number"]

ColourSpace = Literal["", "linear", "srgb"]

_METADATA_KEY = "gltf_property"


class Kind(Enum):
    """What the JSON value is."""

    NUMBER = auto()
    VECTOR = auto()
    FLAG = auto()
    TEXT = auto()
    CHOICE = auto()
    INDEX = auto()  # a reference into another top-level array
    WHOLE_NUMBER = auto()
    NESTED = auto()  # an object with its own dataclass
    NESTED_LIST = auto()  # an array of such objects
    TEXTURE = auto()  # a textureInfo object
    EXTENSION = auto()  # an object under "extensions"


@dataclass(frozen=True, slots=True)
class Property:
    """One row of the property table."""

    kind: Kind
    key: str  # glTF's own name
    about: str  # one sentence for readers of the docs
    default: Any = None
    unit: str = "1"
    low: float | None = None
    high: float | None = None
    low_is_excluded: bool = False
    also_allowed: float | None = None  # one legal value outside [low, high]: KHR_materials_ior's 0
    length: int = 1  # components of a VECTOR
    choices: tuple[str, ...] = ()
    refers_to: str = ""  # top-level array of an INDEX
    required: bool = False
    channels: str = ""  # which channels of a TEXTURE are read
    colour_space: ColourSpace = ""
    cls: type | None = None  # dataclass of a NESTED, NESTED_LIST, TEXTURE or EXTENSION

    @property
    def range_text(self) -> str:
        """The legal numbers in interval notation, such as "[1, ∞) or 0"."""
        low = "(−∞" if self.low is None else f"{'(' if self.low_is_excluded else '['}{self.low:g}"
        high = "∞)" if self.high is None else f"{self.high:g}]"
        other = "" if self.also_allowed is None else f" or {self.also_allowed:g}"
        return f"{low}, {high}{other}"


def properties(cls: type) -> Iterator[tuple[str, Property]]:
    """Yield ``(attribute name, property)`` for each row that the dataclass `cls` states, in order."""
    for field in dataclasses.fields(cls):
        if _METADATA_KEY in field.metadata:
            yield field.name, field.metadata[_METADATA_KEY]


def _field(row: Property) -> Any:
    if row.required:
        return dataclasses.field(metadata={_METADATA_KEY: row})
    if row.kind is Kind.NESTED and row.cls is not None:
        return dataclasses.field(default_factory=row.cls, metadata={_METADATA_KEY: row})
    return dataclasses.field(default=row.default, metadata={_METADATA_KEY: row})


def number(
    key: str,
    default: float | None,
    about: str,
    *,
    low: float | None = None,
    high: float | None = None,
    low_is_excluded: bool = False,
    also_allowed: float | None = None,
    unit: str = "1",
) -> Any:
    """State a scalar property; `default` None means "absent has a meaning of its own"."""
    return _field(
        Property(
            Kind.NUMBER,
            key,
            about,
            default,
            unit,
            low,
            high,
            low_is_excluded=low_is_excluded,
            also_allowed=also_allowed,
        )
    )


def vector(
    key: str,
    default: tuple[float, ...],
    about: str,
    *,
    low: float | None = None,
    high: float | None = None,
    unit: str = "1",
    colour_space: ColourSpace = "",
) -> Any:
    """State a property of fixed length."""
    row = Property(Kind.VECTOR, key, about, default, unit, low, high, colour_space=colour_space)
    return _field(dataclasses.replace(row, length=len(default)))


def flag(key: str, default: bool, about: str) -> Any:
    """State a boolean property."""
    return _field(Property(Kind.FLAG, key, about, default))


def text(key: str, default: str, about: str) -> Any:
    """State a string property."""
    return _field(Property(Kind.TEXT, key, about, default))


def choice(key: str, default: str | None, choices: tuple[str, ...], about: str) -> Any:
    """State a property whose value is one of a few strings; with None for the default it is required."""
    return _field(Property(Kind.CHOICE, key, about, default, choices=choices, required=default is None))


def index(key: str, default: int | None, about: str) -> Any:
    """State an optional non-negative integer, such as the number of a UV set."""
    return _field(Property(Kind.INDEX, key, about, default, low=0))


def reference(key: str, refers_to: str, about: str) -> Any:
    """State a required index into the top-level array `refers_to`."""
    return _field(Property(Kind.INDEX, key, about, low=0, refers_to=refers_to, required=True))


def nested(key: str, cls: type, about: str) -> Any:
    """State an object property; when absent, `cls()` with its own defaults stands for it."""
    return _field(Property(Kind.NESTED, key, about, cls=cls))


def nested_list(key: str, cls: type, about: str) -> Any:
    """State an array of objects; when absent it is empty."""
    return _field(Property(Kind.NESTED_LIST, key, about, (), cls=cls))


def whole_number(key: str, default: int, about: str, *, low: int) -> Any:
    """State an integer property."""
    return _field(Property(Kind.WHOLE_NUMBER, key, about, default, low=low))


def texture_info(key: str, cls: type, about: str, *, channels: str, colour_space: ColourSpace) -> Any:
    """State a texture: which channels are read, and in which colour space they are stored."""
    return _field(Property(Kind.TEXTURE, key, about, channels=channels, colour_space=colour_space, cls=cls))


def extension(cls: Any, about: str) -> Any:
    """State an extension object; its name is ``cls.EXTENSION``, absent is None."""
    return _field(Property(Kind.EXTENSION, cls.EXTENSION, about, cls=cls))
