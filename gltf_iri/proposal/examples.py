"""The README's examples: legal JSON, and every extension object in them valid against the schema.

A block marked ``json`` is a document, or members of one without the braces around. Comments and ellipses are
taken out before what is left is checked.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError
from gltf_iri.proposal.bounds import MAX_EXAMPLE_BYTES, parse_bounded
from gltf_iri.proposal.evaluation import Fault, Judge, TooCostlyError
from gltf_iri.proposal.exclusions import excluded_by
from gltf_iri.proposal.finding import POINTER_LENGTH, Finding
from gltf_iri.proposal.folder import Proposal, scope_of
from gltf_iri.proposal.markdown import Fence
from gltf_iri.proposal.objects import INHERITED, ObjectType, extension_objects
from gltf_iri.proposal.schema_set import SchemaFile

__all__ = ["examples"]

_OTHER_JSON: Final = frozenset({"javascript", "js", "jsonc", "json5"})
_TOKEN: Final = re.compile(r"\"(?:[^\"\\\n]|\\.)*\"?|//[^\n]*|/\*|\.\.\.|…|\s+|.", re.DOTALL)
# The array or property of glTF that an extension object stands in → the scope in its schema's file name.
_SCOPES: Final = {
    "materials": "material",
    "nodes": "node",
    "meshes": "mesh",
    "primitives": "mesh.primitive",
    "textures": "texture",
    "images": "image",
    "scenes": "scene",
    "buffers": "buffer",
    "bufferViews": "bufferView",
    "accessors": "accessor",
    "cameras": "camera",
    "samplers": "sampler",
    "skins": "skin",
    "animations": "animation",
    "target": "animation.channel.target",
}


@dataclass(frozen=True)
class _Found:
    """An extension object in an example: its place, the scope that this gives it, and what is beside it."""

    pointer: str
    scope: str
    value: Any
    beside: frozenset[str]


def examples(proposal: Proposal) -> Iterator[Finding]:
    """Every example is JSON, and what it says of the extension is valid and declared."""
    readme = proposal.readme
    if readme is None:
        return
    judge = Judge(proposal.schemas)
    excluded = excluded_by(readme, proposal.name)
    kinds = {(k.file.name, k.path): k for k in extension_objects(proposal)}
    for fence in readme.fences:
        where = readme.at(fence.line)
        if fence.language in _OTHER_JSON and f'"{proposal.name}"' in fence.text:
            told = f"an example is marked {fence.language}, not json, and was not checked"
            yield Finding("example-language", told, where)
        if fence.language != "json":
            continue
        tree, findings = _parsed(fence, where)
        yield from findings
        if tree is None:
            continue
        yield from _declared(proposal, tree, where)
        for found in _extension_objects(tree, proposal.name):
            for other in sorted(found.beside & excluded.keys()):
                told = f"an example has {other} beside {proposal.name}, which excludes it"
                yield Finding("exclusion-contradicted", told, where)
            yield from _judged(proposal, judge, kinds, found, where)


def _parsed(fence: Fence, where: str) -> tuple[Any, list[Finding]]:
    """Return an example's JSON, None where there is none, and what had to be forgiven."""
    if len(fence.text.encode("utf-8", "replace")) > MAX_EXAMPLE_BYTES:
        told = f"an example has more than {MAX_EXAMPLE_BYTES} bytes"
        return None, [Finding("example-too-large", told, where)]
    reduced = _without_abbreviations(fence.text)
    forgiven = []
    if reduced != fence.text:
        told = "an example is abbreviated with comments or ellipses; without them it was checked"
        forgiven.append(Finding("example-abbreviated", told, where))
    first_error = ""
    for text in (reduced, f"{{{reduced}}}"):
        try:
            tree = parse_bounded(text.encode("utf-8", "surrogatepass"))
        except AssetError as error:
            first_error = first_error or error.what
            continue
        if text is not reduced:
            told = "an example lacks the braces around its members"
            forgiven.append(Finding("example-fragment", told, where))
        return tree, forgiven
    return None, [Finding("example-broken", f"an example is no JSON: {first_error}", where)]


def _without_abbreviations(text: str) -> str:
    """Take comments and ellipses out, and the commas that they leave; other text comes back as it is."""
    tokens: list[str] = []
    is_shorter = False
    position = 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        token = match[0] if match else text[position]
        position += len(token)
        if token == "/*":
            end = text.find("*/", position)
            position = len(text) if end < 0 else end + 2
        if token.startswith(("//", "/*")) or token in ("...", "…"):
            is_shorter = True
        else:
            tokens.append(token)
    if not is_shorter:
        return text
    kept: list[str] = []
    for token in tokens:
        before = next((t for t in reversed(kept) if not t.isspace()), "")
        if token == "," and before in ("", "{", "[", ",", ":"):
            continue
        if token in ("}", "]") and before == ",":
            kept.reverse()
            kept.remove(",")
            kept.reverse()
        kept.append(token)
    return "".join(kept).strip().removesuffix(",")


def _extension_objects(tree: Any, name: str) -> Iterator[_Found]:
    """Yield every value under the extension's name in an ``extensions`` object, or wherever it stands."""
    waiting: list[tuple[str, str, Any]] = [("", "", tree)]
    while waiting:
        pointer, scope, value = waiting.pop()
        if isinstance(value, list):
            waiting += [(f"{pointer}/{i}", scope, child) for i, child in enumerate(value)]
        elif isinstance(value, dict):
            for key, child in value.items():
                below = f"{pointer}/{key}"
                if key == name:
                    root = "glTF" if pointer == "/extensions" and "asset" in tree else scope
                    yield _Found(below, root, child, frozenset(value))
                elif key == "extensions":
                    waiting.append((below, scope, child))
                else:
                    named = "textureInfo" if key.endswith("Texture") else _SCOPES.get(key, scope)
                    waiting.append((below, named, child))


def _judged(
    proposal: Proposal,
    judge: Judge,
    kinds: dict[tuple[str, tuple[str, ...]], ObjectType],
    found: _Found,
    where: str,
) -> Iterator[Finding]:
    """Judge by the schema of the object's place; where the place is not told, any may allow it."""
    named = [e for e in proposal.entries if _fits(scope_of(e, proposal.name), found.scope)]
    entries = named or list(proposal.entries)
    faults: list[tuple[SchemaFile, Fault | None]] = []
    try:
        for entry in entries:
            faults.append((entry, judge.first_fault(entry, "", entry.tree, found.value)))
    except TooCostlyError:
        yield Finding("check-too-costly", "validating an example takes too many steps", where)
        return
    fault = faults[0][1] if faults and all(fault for _, fault in faults) else None
    if fault is not None:
        told = (
            f"{shown(found.pointer + fault.place, POINTER_LENGTH)} in an example is invalid: {fault.reason}"
        )
        yield Finding("example-invalid", told, where)
    unknown = [list(_unknown(kinds, e.name, (), found.value, found.pointer)) for e, _ in faults]
    for pointer in min(unknown, key=len, default=[]):
        told = f"{shown(pointer, POINTER_LENGTH)} in an example is a property that the schema does not have"
        yield Finding("example-unknown-property", told, where)


def _fits(scope: str, place: str) -> bool:
    return scope == place or (scope == "primitive" and place == "mesh.primitive")


def _unknown(
    kinds: dict[tuple[str, tuple[str, ...]], ObjectType],
    entry: str,
    path: tuple[str, ...],
    value: Any,
    pointer: str,
) -> Iterator[str]:
    kind = next((k for (_, p), k in kinds.items() if p == path and _is_of(kinds, k, entry)), None)
    if kind is None or not isinstance(value, dict):
        return
    for key, child in value.items():
        below = f"{pointer}/{key}"
        if key not in kind.properties:
            if key not in INHERITED | {"name"}:
                yield below
            continue
        yield from _unknown(kinds, entry, (*path, key), child, below)
        for position, item in enumerate(child if isinstance(child, list) else []):
            yield from _unknown(kinds, entry, (*path, key, "{}"), item, f"{below}/{position}")


def _is_of(kinds: dict[tuple[str, tuple[str, ...]], ObjectType], kind: ObjectType, entry: str) -> bool:
    root = kinds.get((entry, ()))
    return root is not None and root.scope == kind.scope


def _declared(proposal: Proposal, tree: Any, where: str) -> Iterator[Finding]:
    """A whole file declares the extension that it uses, and a material's is not required of readers."""
    if not isinstance(tree, dict):
        return
    used, required = tree.get("extensionsUsed"), tree.get("extensionsRequired")
    holds = any(True for _ in _extension_objects(tree, proposal.name))
    is_declared = isinstance(used, list) and proposal.name in used
    if holds and ("asset" in tree or used is not None) and not is_declared:
        told = f"an example uses {proposal.name} and does not declare it in extensionsUsed"
        yield Finding("example-undeclared", told, where)
    if proposal.is_of_materials and isinstance(required, list) and proposal.name in required:
        told = f"an example requires {proposal.name}; a material can do without"
        yield Finding("example-required", told, where)
