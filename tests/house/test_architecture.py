"""The shape of the house: which way imports run, and what may not stand at a module's top."""

from __future__ import annotations

import ast
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "gltf_iri"
MODULES = sorted(PACKAGE.rglob("*.py"))

# From the door down to the bytes: a folder may import those after it, never those before it.
ROAD = (
    *(
        "cli",
        "gallery",
        "bench",
        "conformance",
        "validation",
        "comparison",
        "rendering",
        "reference",
        "arrays",
        "budgets",
    ),
    *("baking", "evaluation", "planning", "scene", "material", "asset"),
)
# Open to every folder; these may import each other and nothing of the road.
GROUND = {"optics", "colour", "compiled", "backends", "errors", "interrupts", "tolerances", "resources"}
GROUND |= {"whole_files"}
# Beside the road: a writer of assets that reads none.
SAMPLES = "samples"
# Beside it too: checks schemas and text, and knows of materials nothing but the bytes.
PROPOSAL = "proposal"
# They see everything, because they start or gather it.
ENTRANCES = {"__init__", "__main__", "generate"}

SLOW_TO_LOAD = {
    *("scipy", "colour", "matplotlib", "moderngl", "glcontext", "pygltflib", "trimesh"),
    *("OpenEXR", "jinja2", "PIL", "rich", "embreex", "numba", "jsonschema", "yaml"),
}
# Its modules import numba at the top, so they themselves are imported where they are used.
COMPILED = "compiled"
LONGEST_FILE = 300

OPENS_FILES = {
    *("open", "fdopen", "read_text", "read_bytes", "write_text", "write_bytes", "mkstemp"),
    *("NamedTemporaryFile", "save", "savefig", "File"),
}
OPENERS = {
    "asset/guard.py",  # every file of an asset
    "asset/image.py",  # decodes bytes
    "scene/exr.py",  # OpenEXR's library opens by name; the door has looked at the file before
    "whole_files.py",  # every file that a user asks for
    "rendering/picture.py",  # encodes into the file that whole_files.py hands it
    "comparison/figures.py",  # encodes into memory
    "bench/plot.py",  # encodes into memory
    "bench/vector_digits.py",  # the checkout's own vectors
    "bench/machine.py",  # what Linux says of its processor
    "rendering/source.py",  # the program's own shaders
    "colour/observer.py",  # the program's own tables
    "compiled/loops.py",  # the sources of compiled loops, to know their machine code by
    "arrays/memory.py",  # what Linux says of the process
    "arrays/stream.py",  # keeps room on the disk for the array that whole_files.py hands it
    "samples/collection.py",  # the program's own pictures, and the index of an earlier collection
    "baking/cache.py",  # tables that it wrote itself, and the sources that filled them
    "planning/costs.py",  # the program's own map of costs
    "validation/plugins.py",  # which installed packages bring rules
    "validation/tables.py",  # the program's own tables
    "validation/many/results_file.py",  # the results of a run that may be broken off and go on
    "cli/ending.py",  # the null device
    "generate.py",  # the checkout that it runs in
}

TOP_LEVEL = {
    *("pyproject.toml", "README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "Makefile"),
    *(".ci", ".gitignore", ".pre-commit-hooks.yaml", "gltf_iri", "shaders", "samples", "spec", "tests"),
}


def part_of(module: Path) -> str:
    """Return the folder of the package that `module` stands in, or its own name at the top."""
    relative = module.relative_to(PACKAGE)
    return relative.parts[0] if len(relative.parts) > 1 else relative.stem


def imported(tree: ast.AST) -> Iterator[tuple[ast.stmt, str]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            if node.module == "gltf_iri":
                yield from ((node, f"gltf_iri.{alias.name}") for alias in node.names)
            else:
                yield node, node.module


def allowed_from(part: str) -> set[str]:
    everything = {*ROAD, *GROUND, SAMPLES, PROPOSAL}
    if part in ENTRANCES:
        return everything
    if part in GROUND:
        return GROUND
    if part == SAMPLES:
        return {SAMPLES, *GROUND}
    if part == PROPOSAL:
        return {PROPOSAL, "asset", *GROUND}
    below = {*ROAD[ROAD.index(part) :], *GROUND}
    if part == "rendering":
        below.remove("reference")  # neither owes the other anything, or their agreement would prove nothing
    if part == "cli":
        below.add(PROPOSAL)
    return below | {SAMPLES} if part in ("cli", "bench") else below


def test_every_folder_of_the_package_has_its_place() -> None:
    assert {part_of(module) for module in MODULES} <= {*ROAD, *GROUND, SAMPLES, PROPOSAL, *ENTRANCES}


def test_imports_run_one_way() -> None:
    against = []
    for module in MODULES:
        part = part_of(module)
        for node, name in imported(ast.parse(module.read_text(encoding="utf-8"))):
            if name.startswith("gltf_iri."):
                target = name.split(".")[1]
                is_metadata = target.startswith("__")
                if not is_metadata and target not in allowed_from(part):
                    against.append(f"{module.relative_to(ROOT)}:{node.lineno} imports {name}")
    assert against == []


def test_slow_packages_are_imported_where_they_are_used() -> None:
    at_the_top = []
    for module in MODULES:
        if part_of(module) == COMPILED:
            continue
        tree = ast.parse(module.read_text(encoding="utf-8"))
        inside = {
            id(node)
            for holder in ast.walk(tree)
            if isinstance(holder, (ast.FunctionDef, ast.AsyncFunctionDef)) or is_type_checking(holder)
            for node in ast.walk(holder)
        }
        for node, name in imported(tree):
            is_slow = name.split(".")[0] in SLOW_TO_LOAD or name.startswith(f"gltf_iri.{COMPILED}.")
            if id(node) not in inside and is_slow:
                at_the_top.append(f"{module.relative_to(ROOT)}:{node.lineno} imports {name}")
    assert at_the_top == []


def test_opengl_is_spoken_in_one_folder_only() -> None:
    speakers = {
        part_of(module)
        for module in MODULES
        for _, name in imported(without_type_checking(ast.parse(module.read_text(encoding="utf-8"))))
        if name.split(".")[0] == "moderngl"
    }
    assert speakers == {"rendering"}


def test_files_are_opened_at_the_few_places_that_are_known() -> None:
    openers = {
        module.relative_to(PACKAGE).as_posix()
        for module in MODULES
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and called(node.func) in OPENS_FILES
    }
    assert openers == OPENERS


def called(function: ast.expr) -> str:
    """Return the last name of what is called: "open" for both open() and Path.open()."""
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def without_type_checking(tree: ast.Module) -> ast.Module:
    return ast.Module([node for node in tree.body if not is_type_checking(node)], tree.type_ignores)


def is_type_checking(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


@pytest.mark.parametrize("module", MODULES, ids=lambda module: str(module.relative_to(ROOT)))
def test_every_module_says_what_it_offers(module: Path) -> None:
    tree = ast.parse(module.read_text(encoding="utf-8"))
    assert ast.get_docstring(tree)
    names = {
        target.id
        for node in tree.body
        if isinstance(node, (ast.Assign, ast.AugAssign, ast.AnnAssign))
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        if isinstance(target, ast.Name)
    }
    has_code = any(not isinstance(node, ast.Expr) for node in tree.body)
    assert "__all__" in names or not has_code


def test_no_file_is_too_long_to_be_read_at_once() -> None:
    shaders = [p for p in (ROOT / "shaders").rglob("*.*") if "generated" not in p.parts]
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for path in (*MODULES, *shaders)
    }
    assert {path: length for path, length in lengths.items() if length > LONGEST_FILE} == {}


def test_the_top_level_holds_what_the_plan_of_the_house_says() -> None:
    if shutil.which("git") is None:
        pytest.skip("git is not installed, and nothing else tells committed files from others")
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listing.returncode != 0:
        pytest.skip("this is no git checkout, so nothing tells committed files from others")
    committed = {path.split("/")[0] for path in listing.stdout.split("\0") if path}
    assert committed == TOP_LEVEL
