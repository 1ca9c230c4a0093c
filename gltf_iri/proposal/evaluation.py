"""Validates values against schemas of mixed drafts, each in its own, without network, bounded in time.

jsonschema knows each draft's keywords; references are followed here, because its own resolver reads the draft
of a document from ``$schema`` only where no ``$id`` says otherwise, and counts nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.proposal.bounds import MAX_STEPS
from gltf_iri.proposal.drafts import Draft
from gltf_iri.proposal.schema_set import DanglingError, SchemaFile, SchemaSet
from gltf_iri.proposal.schema_walk import Place, children
from gltf_iri.proposal.word_list import words

__all__ = ["Fault", "Judge", "TooCostlyError", "illegality"]

# Left out before a value is judged: what names or annotates, regular expressions, which may take for ever,
# and what would have to ask jsonschema's resolver.
_LEFT_OUT: Final = words(
    "id $id $schema $anchor $dynamicAnchor $recursiveAnchor $dynamicRef $recursiveRef $vocabulary pattern "
    "patternProperties format unevaluatedItems unevaluatedProperties"
)
_LONGEST: Final = 160


class TooCostlyError(Exception):
    """Validation took more steps than a proposal may ask for."""


@dataclass(frozen=True)
class Fault:
    """Why a value is invalid: its place in the value, as ``/a/0``, and the reason."""

    place: str
    reason: str


def illegality(schema: dict[str, Any], draft: Draft) -> Fault | None:
    """Return the first reason for which the draft's own schema refuses `schema`, None where it does not."""
    import jsonschema

    try:
        getattr(jsonschema, draft.validator).check_schema(schema)
    except jsonschema.SchemaError as error:
        return _fault(error)
    except RecursionError:
        return Fault("", "it is nested too deep to be checked")
    return None


class Judge:
    """Judges values by the schemas of a set; all calls together may take `MAX_STEPS`."""

    def __init__(self, schemas: SchemaSet) -> None:
        self._schemas = schemas
        self._steps = 0
        self._classes: dict[str, Any] = {}
        self._clean: dict[int, dict[str, Any]] = {}

    def first_fault(self, file: SchemaFile, pointer: str, schema: dict[str, Any], value: Any) -> Fault | None:
        """Return the first reason why `value` is invalid against the schema at `pointer`, None if valid.

        Raises TooCostlyError, also on later calls, once the steps are spent.
        """
        try:
            error = next(self._errors(file, Place(pointer, schema), value), None)
        except RecursionError as deep:
            raise TooCostlyError from deep
        return None if error is None else _fault(error)

    def _errors(self, file: SchemaFile, place: Place, value: Any) -> Iterator[Any]:
        clean = self._clean.get(id(place.schema))
        if clean is None:
            clean = self._clean[id(place.schema)] = _cleaned(file, place)
        yield from self._class_of(file.draft)(clean).iter_errors(value)

    def _class_of(self, draft: Draft | None) -> Any:
        import jsonschema

        name = "Draft4Validator" if draft is None else draft.validator
        if name not in self._classes:
            plain = getattr(jsonschema, name)
            counted = {keyword: self._counted(check) for keyword, check in plain.VALIDATORS.items()}
            counted["$ref"] = self._counted(self._follow)
            self._classes[name] = jsonschema.validators.extend(plain, counted)
        return self._classes[name]

    def _counted(self, check: Callable[..., Any]) -> Callable[..., Any]:
        def step(*arguments: Any) -> Any:
            self._steps += 1
            if self._steps > MAX_STEPS:
                raise TooCostlyError
            return check(*arguments)

        return step

    def _follow(self, _: Any, reference: Any, value: Any, __: Any) -> Iterator[Any]:
        file, pointer, text = reference
        try:
            target = self._schemas.find(file, pointer, text)
        except DanglingError:
            return  # another finding tells of it
        yield from self._errors(target.file, Place(target.pointer, target.schema), value)


def _cleaned(file: SchemaFile, place: Place) -> dict[str, Any]:
    """Copy a schema without what is left out; its references remember where they stood."""
    clean = {key: value for key, value in place.schema.items() if key not in _LEFT_OUT}
    for child in children(place):
        if child.keyword in _LEFT_OUT:
            continue
        inside = clean[child.keyword]
        if inside is child.schema:
            clean[child.keyword] = _cleaned(file, child)
            continue
        if inside is place.schema[child.keyword]:
            inside = clean[child.keyword] = inside.copy()
        keys = range(len(inside)) if isinstance(inside, list) else list(inside)
        for key in keys:
            if inside[key] is child.schema:
                inside[key] = _cleaned(file, child)
                break
    if "$ref" in clean:
        clean["$ref"] = (file, place.pointer, clean["$ref"])
    return clean


def _fault(error: Any) -> Fault:
    place = "".join(f"/{step}" for step in error.absolute_path)
    reason = error.message
    return Fault(place, reason if len(reason) <= _LONGEST else f"{reason[: _LONGEST - 1]}…")
