"""What the checker can find: a code, a sentence, a place, and the reason for the code's severity.

An error is what a reader of the proposal would do wrong because of it, or what no validator can work with. A
warning is what an editor asks to be changed. Information is what an editor may want to know.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType
from typing import Final

__all__ = ["CODES", "POINTER_LENGTH", "Code", "Finding", "Severity"]

# What a finding shows of a pointer: pointers into extensions are long, and differ at their ends.
POINTER_LENGTH: Final = 200


class Severity(Enum):
    """How much a finding weighs; only errors change the exit code."""

    ERROR = "error"
    WARNING = "warning"
    INFORMATION = "information"


@dataclass(frozen=True)
class Code:
    """A kind of finding: its severity and why it is no more and no less."""

    severity: Severity
    why: str


def _error(why: str) -> Code:
    return Code(Severity.ERROR, why)


def _warning(why: str) -> Code:
    return Code(Severity.WARNING, why)


def _information(why: str) -> Code:
    return Code(Severity.INFORMATION, why)


_READING: Final = {
    "schema-missing": _error("without a schema nothing can be validated"),
    "folder-too-large": _error("more files than any extension has are not read, so nothing is said of them"),
    "json-broken": _error("readers of JSON refuse the file, or disagree about what it says"),
    "readme-unreadable": _error("nobody can read it"),
}
_LEGALITY: Final = {
    "draft-missing": _error("the same keywords mean other things in other drafts"),
    "draft-unknown": _error("validators do not know how to read it"),
    "draft-unusual": _warning("glTF's schemas are draft-04 or 2020-12, and its tools are made for these"),
    "draft-of-materials": _information("draft-04 is the habit of material extensions, not a rule"),
    "schema-illegal": _error("the draft's own schema refuses it, and so may validators"),
    "keyword-of-another-draft": _error("validators pass over it, so what it demands is never checked"),
    "keyword-without-effect": _warning("validators pass over it, but what stands beside it allows as much"),
    "keyword-unknown": _warning("validators pass over it; most often it is a misspelt keyword"),
    "ref-unresolved": _error("validators stop at a reference that leads nowhere"),
    "ref-outside": _error("readers have the folder and glTF's own schemas, and validators fetch nothing"),
    "ref-cycle": _error("validators that follow it never come back"),
    "ref-expansion": _error("validators that follow it are busy for hours"),
    "ref-not-known": _information("a schema of glTF that this checker does not know by content"),
    "ref-siblings": _information("before 2019-09 what stands beside $ref is ignored; it often repeats it"),
    "id-differs": _information("references use file names, so they miss a schema that is known by its $id"),
    "check-too-costly": _error("validators take as long as this checker, which gave up"),
}
_NAMING: Final = {
    "name-form": _error("glTF's registry demands an uppercase prefix, '_' and a name"),
    "name-case": _warning("the registry demands lowercase snake case after the prefix; old names differ"),
    "name-parts": _information("PREFIX_scope_feature is what the registry recommends, not what it demands"),
    "file-name": _error("tools find a schema by the extension's name in the file's"),
    "file-scope": _information("names of files tell which object of glTF is extended; old ones differ"),
    "file-scope-missing": _information("the file's name does not tell which object is extended"),
    "scope-differs": _warning("the file's name says that the document's root is extended"),
    "schema-unused": _warning("nothing leads to the file, so no validator reads it"),
    "title-missing": _warning("generated references have no heading for it"),
    "title-differs": _warning("generated references call it by another extension's name"),
    "property-case": _error("names of glTF's properties are camelCase, and all programs spell them so"),
}
_STYLE: Final = {
    "type-object": _error("anything but an object passes too"),
    "type-missing": _warning("a value of any type passes"),
    "base-missing": _error("the registry demands that objects inherit glTFProperty"),
    "base-missing-inside": _warning("an object inside another inherits it too, in glTF's own schemas"),
    "members-missing": _warning("generated references do not list extensions and extras"),
    "closed-object": _error("the registry wants additional properties allowed, for later versions"),
    "description-missing": _warning("generated references have nothing to say of the property"),
    "description-missing-object": _information("the title may be enough for an object"),
    "range-missing": _information("some numbers, such as angles, may be any on purpose"),
    "range-empty": _error("no value can be valid"),
}
_DEFAULTS: Final = {
    "default-invalid": _error("a file that states what is assumed anyway would be invalid"),
    "default-of-required": _warning("a required property is never left out, so its default says nothing"),
    "default-of-texture": _warning("a reference to a texture has nothing that it could be by default"),
    "default-missing": _warning("what a factor is when left out must be stated somewhere"),
    "default-acts": _error("an empty extension object must leave the material as it is without it"),
    "default-may-act": _warning("an editor asks what an empty extension object does; it may be on purpose"),
    "empty-invalid": _error("material extensions take every property as optional"),
}
_TEXTURES: Final = {
    "texture-channel": _warning("which channels are read must be stated; old schemas leave it to the README"),
    "texture-colour-space": _warning("a texture that is taken for sRGB or not changes colour"),
    "texture-absent-value": _information("what an absent texture stands for is stated elsewhere by some"),
}
_TEXT: Final = {
    "heading-differs": _error("the README is another extension's, or the folder is"),
    "section-missing": _error("the registry's template demands it"),
    "section-missing-minor": _warning("the template has it, and editors ask for it"),
    "section-order": _warning("readers look for sections where every other extension has them"),
    "link-broken": _error("the file would lie beside the README and does not"),
    "link-anchor": _warning("the link leads to the page but not to its place"),
    "link-unverified": _information("it leads out of the folder, to what this checkout does not have"),
    "table-missing": _warning("some extensions describe their properties in prose"),
    "table-unknown-property": _error("readers would write a property that does not exist"),
    "table-missing-property": _error("readers of the table never learn of the property"),
    "table-type": _error("table and schema say two things, and one of them is wrong"),
    "table-required": _error("table and schema say two things, and one of them is wrong"),
    "table-default": _error("table and schema say two things, and one of them is wrong"),
    "table-default-missing": _warning("the schema knows a default that the table's readers do not learn"),
    "table-default-unread": _information("a default in words cannot be compared with the schema"),
}
_EXAMPLES: Final = {
    "example-broken": _error("readers copy examples, and this one is no JSON"),
    "example-abbreviated": _warning("comments and ellipses are no JSON; the rest of the example was checked"),
    "example-fragment": _information(
        "members without their braces; they were checked as if these stood there"
    ),
    "example-language": _information("only examples marked as json are checked"),
    "example-too-large": _warning("it was not checked"),
    "example-invalid": _error("readers copy examples, and this one is invalid"),
    "example-unknown-property": _error("readers copy examples, and this property does not exist"),
    "example-undeclared": _error("an extension in a file must be declared in extensionsUsed"),
    "example-required": _warning("a material extension has the core material to fall back on"),
}
_OTHERS: Final = {
    "exclusion-one-sided": _error("one README forbids what the other allows"),
    "exclusion-unanswered": _error("one README forbids what the other allows"),
    "exclusion-to-propose": _information("a published extension of Khronos is not the proposal's to edit"),
    "exclusion-unverified": _information("the other extension is not in this checkout"),
    "exclusion-contradicted": _error("the same README forbids and allows it"),
    "pointer-table-missing": _warning("the Object Model lists what may be animated; older READMEs do not"),
    "pointer-missing": _error("a property that may be animated has no pointer"),
    "pointer-unknown": _error("an animation to it has nothing to move"),
    "pointer-type": _error("an animation's values would be read as another type"),
}

# Code → severity and its reason, in the order in which they are looked for.
CODES: Final[Mapping[str, Code]] = MappingProxyType(
    {
        **_READING,
        **_LEGALITY,
        **_NAMING,
        **_STYLE,
        **_DEFAULTS,
        **_TEXTURES,
        **_TEXT,
        **_EXAMPLES,
        **_OTHERS,
    }
)


@dataclass(frozen=True)
class Finding:
    """One fault: `where` is a file, with ``#`` and a JSON Pointer or ``:`` and a line behind it."""

    code: str
    message: str
    where: str

    @property
    def severity(self) -> Severity:
        """The severity of the code."""
        return CODES[self.code].severity

    @property
    def file(self) -> str:
        """The file that `where` names."""
        return self.where.partition("#")[0].rpartition(":")[0] or self.where.partition("#")[0]

    def to_json(self) -> dict[str, str]:
        """The finding as the command line prints it."""
        return {
            "code": self.code,
            "severity": self.severity.value,
            "message": self.message,
            "where": self.where,
        }
