"""What is imported is declared: a fresh environment has everything, whoever wrote the import."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def distribution_names(requirements: list[str]) -> set[str]:
    return {normalised(re.split(r"[\s<>=!~;\[]", requirement)[0]) for requirement in requirements}


def normalised(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def undeclared(folder: str, requirements: list[str]) -> list[str]:
    """Return "file imports package" for each import below `folder` that `requirements` do not cover."""
    declared = distribution_names(requirements)
    providers = packages_distributions()
    found = set()
    for module in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                names = [node.module]
            for top in {name.split(".")[0] for name in names} - set(sys.stdlib_module_names) - {"gltf_iri"}:
                # Some distributions do not list their modules; those are called like them.
                if not {normalised(name) for name in providers.get(top, [top])} & declared:
                    found.add(f"{module.relative_to(ROOT)} imports {top}")
    return sorted(found)


def test_the_package_imports_only_what_it_declares() -> None:
    extras = PROJECT["optional-dependencies"]
    extra = extras["reference"] + extras["fast"] + extras["peers"] + extras["cluster"]
    assert undeclared("gltf_iri", PROJECT["dependencies"] + extra) == []


def test_the_tests_import_only_what_is_declared() -> None:
    extras = PROJECT["optional-dependencies"]
    extra = extras["test"] + extras["mitsuba"] + extras["fuzz"]
    modules = (ROOT / "tests").rglob("*.py")
    helpers = {path.parent.name if path.name == "__init__.py" else path.stem for path in modules}
    missing = undeclared("tests", PROJECT["dependencies"] + extra)
    assert [line for line in missing if line.split()[-1] not in helpers] == []
