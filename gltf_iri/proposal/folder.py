"""A proposal's folder as the registry has it: README.md and schema/*.schema.json, or the schemas beside it.

Files are read through `gltf_iri.asset.guard`: inside the folder, never the network, up to a stated size.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from gltf_iri.asset.guard import read_inside
from gltf_iri.asset.words import kind_of, shown
from gltf_iri.errors import AssetError
from gltf_iri.proposal.bounds import MAX_README_BYTES, MAX_SCHEMA_BYTES, MAX_SCHEMAS, parse_bounded
from gltf_iri.proposal.drafts import draft_of
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.markdown import Markdown, parse_markdown
from gltf_iri.proposal.schema_set import SUFFIX, SchemaFile, SchemaSet

__all__ = ["README", "Proposal", "read_proposal", "read_readme"]

README = "README.md"


@dataclass(frozen=True)
class Proposal:
    """What lies in the folder; `findings` say what could not be read.

    `entries` are the schemas of the extension's own objects (``material.NAME.schema.json``); the others in
    `schemas.own` are parts of them.
    """

    folder: Path
    name: str
    schemas: SchemaSet
    entries: tuple[SchemaFile, ...]
    readme: Markdown | None
    findings: tuple[Finding, ...] = field(default=())

    @property
    def is_of_materials(self) -> bool:
        """Whether the extension's name or one of its files says that it extends materials."""
        return "_materials_" in self.name or any(scope_of(e, self.name) == "material" for e in self.entries)


def read_proposal(folder: Path) -> Proposal:
    """Read what `folder` holds; OSError where it cannot be listed, findings for whatever else is wrong."""
    root = folder.resolve()
    findings: list[Finding] = []
    files = _read_schemas(root, findings)
    readme, faults = read_readme(root, root)
    ending = f".{root.name}{SUFFIX}"
    entries = [file for file in files.values() if f".{file.name}".endswith(ending)]
    return Proposal(root, root.name, SchemaSet(files), tuple(entries), readme, (*findings, *faults))


def scope_of(entry: SchemaFile, name: str) -> str:
    """Return the object that an entry's file name says is extended: "material", or "" for none."""
    return entry.name.removesuffix(f"{name}{SUFFIX}").removesuffix(".")


def read_readme(root: Path, folder: Path) -> tuple[Markdown | None, list[Finding]]:
    """Return the README in `folder`, which lies in `root`; None without a finding where there is none."""
    name = next((p.name for p in _listed(folder) if p.name.lower() == README.lower()), None)
    if name is None:
        return None, []
    inside = (folder / name).relative_to(root).as_posix()
    try:
        text = read_inside(root, quote(inside), "", MAX_README_BYTES).decode("utf-8-sig")
    except AssetError as error:
        return None, [Finding("readme-unreadable", error.what, name)]
    except UnicodeDecodeError as error:
        told = f"it is not UTF-8 at byte {error.start}: save it as text"
        return None, [Finding("readme-unreadable", told, name)]
    if "\0" in text:
        return None, [Finding("readme-unreadable", "it holds zero bytes: save it as text", name)]
    return parse_markdown(text, name), []


def _read_schemas(root: Path, findings: list[Finding]) -> dict[str, SchemaFile]:
    folder = root / "schema"
    folder = folder if folder.is_dir() else root
    named = [path for path in _listed(folder) if path.name.endswith(".json")]
    if folder == root:
        named = [path for path in named if path.name.endswith(SUFFIX)]
    if not named:
        told = f"there is no schema, neither schema/*{SUFFIX} nor *{SUFFIX}"
        findings.append(Finding("schema-missing", told, "schema"))
    if len(named) > MAX_SCHEMAS:
        told = f"there are {len(named)} schemas, of which {MAX_SCHEMAS} were read"
        findings.append(Finding("folder-too-large", told, "schema"))
    files = {}
    for path in named[:MAX_SCHEMAS]:
        where = path.relative_to(root).as_posix()
        if not path.name.endswith(SUFFIX):
            told = f"the name of a schema ends with {SUFFIX}"
            findings.append(Finding("file-name", told, where))
            continue
        try:
            tree = parse_bounded(read_inside(root, quote(where), "", MAX_SCHEMA_BYTES))
        except AssetError as error:
            findings.append(Finding("json-broken", error.what, f"{where}#{error.pointer or '/'}"))
            continue
        if not isinstance(tree, dict):
            told = f"a schema is an object, and this is {kind_of(tree)}: {shown(tree)}"
            findings.append(Finding("json-broken", told, where))
            continue
        files[path.name] = SchemaFile(path.name, where, tree, draft_of(tree))
    return files


def _listed(folder: Path) -> list[Path]:
    return sorted(folder.iterdir())
