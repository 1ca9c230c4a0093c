"""The rules, in the order in which they are asked; to add one, write a function and add its line here."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Final

from gltf_iri.proposal import (
    defaults,
    examples,
    exclusions,
    legality,
    links,
    naming,
    pointers,
    references,
    sections,
    style,
    tables,
    textures,
)
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.word_list import words

__all__ = ["BLOCKING", "RULES", "UNREAD", "Needs", "Rule"]


class Needs(Enum):
    """What a rule cannot do without."""

    NOTHING = "nothing"
    FILES = "every schema read"
    SCHEMAS = "sound schemas"
    README = "a README"
    BOTH = "sound schemas and a README"


@dataclass(frozen=True)
class Rule:
    """A rule: what it is called in reports, what it needs, and the function that yields its findings."""

    name: str
    needs: Needs
    check: Callable[[Proposal], Iterable[Finding]]


# After one of these while reading, a file that is referred to may be there, but its content is not known.
UNREAD: Final = words("schema-missing folder-too-large json-broken file-name")

# After one of these, what the schemas say is not known, and every other finding would be about that.
BLOCKING: Final = UNREAD | words(
    "draft-missing draft-unknown schema-illegal ref-unresolved ref-outside ref-cycle ref-expansion"
)

RULES: Final[tuple[Rule, ...]] = (
    Rule("draft", Needs.NOTHING, legality.draft),
    Rule("legal schemas", Needs.NOTHING, legality.legal),
    Rule("keywords", Needs.NOTHING, legality.keywords),
    Rule("identifiers", Needs.NOTHING, legality.identifiers),
    Rule("references", Needs.FILES, references.resolved),
    Rule("cycles", Needs.FILES, references.expansion),
    Rule("extension name", Needs.NOTHING, naming.extension_name),
    Rule("file names", Needs.FILES, naming.file_names),
    Rule("keywords beside $ref", Needs.SCHEMAS, references.siblings),
    Rule("unused schemas", Needs.SCHEMAS, references.unused),
    Rule("titles", Needs.SCHEMAS, naming.titles),
    Rule("property names", Needs.SCHEMAS, naming.property_names),
    Rule("objects", Needs.SCHEMAS, style.objects),
    Rule("descriptions", Needs.SCHEMAS, style.descriptions),
    Rule("additional properties", Needs.SCHEMAS, style.openness),
    Rule("ranges", Needs.SCHEMAS, style.ranges),
    Rule("defaults", Needs.SCHEMAS, defaults.legal_defaults),
    Rule("needless defaults", Needs.SCHEMAS, defaults.needless_defaults),
    Rule("empty object", Needs.SCHEMAS, defaults.empty_object),
    Rule("no effect by default", Needs.SCHEMAS, defaults.no_effect),
    Rule("textures", Needs.SCHEMAS, textures.textures),
    Rule("heading", Needs.README, sections.heading),
    Rule("sections", Needs.README, sections.sections),
    Rule("links", Needs.README, links.links),
    Rule("property tables", Needs.BOTH, tables.tables),
    Rule("examples", Needs.BOTH, examples.examples),
    Rule("exclusions", Needs.README, exclusions.reciprocity),
    Rule("contradictions", Needs.README, exclusions.contradictions),
    Rule("pointers", Needs.BOTH, pointers.pointers),
)
