"""The drafts of JSON Schema: which keywords each knows, and which of these make demands.

Keywords after the drafts' own texts: draft-fge-json-schema-validation-00, draft-wright-json-schema-01,
draft-handrews-json-schema-01 and -02, draft-bhutton-json-schema-01 (json-schema.org/specification-links).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from gltf_iri.proposal.word_list import words

__all__ = ["ALL_KEYWORDS", "ANNOTATIONS", "DRAFTS", "Draft", "draft_of"]

_FOUR: Final = words(
    "id $schema $ref title description default multipleOf maximum exclusiveMaximum minimum exclusiveMinimum "
    "maxLength minLength pattern additionalItems items maxItems minItems uniqueItems maxProperties "
    "minProperties required additionalProperties definitions properties patternProperties dependencies enum "
    "type format allOf anyOf oneOf not"
)
_SIX: Final = (_FOUR - {"id"}) | {"$id", "const", "contains", "propertyNames", "examples"}
_SEVEN: Final = _SIX | words("$comment if then else readOnly writeOnly contentMediaType contentEncoding")
_NINETEEN: Final = (_SEVEN - {"dependencies"}) | words(
    "$anchor $vocabulary $recursiveRef $recursiveAnchor $defs maxContains minContains unevaluatedItems "
    "unevaluatedProperties dependentSchemas dependentRequired contentSchema deprecated"
)
_TWENTY: Final = (_NINETEEN - {"additionalItems", "$recursiveRef", "$recursiveAnchor"}) | {
    *("prefixItems", "$dynamicRef", "$dynamicAnchor")
}

ALL_KEYWORDS: Final = _FOUR | _SEVEN | _NINETEEN | _TWENTY

# They say something to people and demand nothing of a value, whatever the draft.
ANNOTATIONS: Final = words(
    "$comment title description default examples readOnly writeOnly deprecated contentMediaType "
    "contentEncoding contentSchema"
)


@dataclass(frozen=True)
class Draft:
    """One draft: its name, jsonschema's class for it, its keywords, and what it does beside ``$ref``."""

    name: str
    validator: str
    keywords: frozenset[str]
    ignores_ref_siblings: bool
    is_usual: bool


# $schema, without a trailing '#' → the draft.
DRAFTS: Final[Mapping[str, Draft]] = MappingProxyType(
    {
        "http://json-schema.org/draft-04/schema": Draft("draft-04", "Draft4Validator", _FOUR, True, True),
        "http://json-schema.org/draft-06/schema": Draft("draft-06", "Draft6Validator", _SIX, True, False),
        "http://json-schema.org/draft-07/schema": Draft("draft-07", "Draft7Validator", _SEVEN, True, False),
        "https://json-schema.org/draft/2019-09/schema": Draft(
            "2019-09", "Draft201909Validator", _NINETEEN, False, False
        ),
        "https://json-schema.org/draft/2020-12/schema": Draft(
            "2020-12", "Draft202012Validator", _TWENTY, False, True
        ),
    }
)


def draft_of(schema: Mapping[str, object]) -> Draft | None:
    """Return the draft that ``$schema`` names; None where there is none, or an unknown one."""
    named = schema.get("$schema")
    return DRAFTS.get(named.removesuffix("#")) if isinstance(named, str) else None
