"""What is built from a checkout works far from it: the wheel by itself, the source archive as a checkout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import moderngl
import pytest

import gltf_iri

ROOT = Path(__file__).resolve().parents[2]

Program = Callable[..., str]


@dataclass(frozen=True)
class Built:
    wheel: Path
    archive: Path


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """The source archive, and the wheel that was built from that archive alone."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return Built(next(folder.glob("*.whl")), next(folder.glob("*.tar.gz")))


@pytest.fixture(scope="module")
def installed(built: Built, tmp_path_factory: pytest.TempPathFactory) -> Program:
    """Runs the program from the wheel in an empty folder, with this environment's other packages."""
    site, elsewhere = tmp_path_factory.mktemp("site"), tmp_path_factory.mktemp("elsewhere")
    install = [sys.executable, "-m", "pip", "install", "--no-deps", "--quiet", "--no-index"]
    install += ["--disable-pip-version-check", "--target", str(site), str(built.wheel)]
    subprocess.run(install, check=True, capture_output=True, text=True)
    environment = {**os.environ, "PYTHONPATH": str(site)}

    def run(*arguments: str) -> str:
        # -P: the folder that the program runs in is not searched for modules.
        command = [sys.executable, "-P", *arguments]
        done = subprocess.run(
            command, cwd=elsewhere, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    where = run("-c", "import gltf_iri; print(gltf_iri.__file__)")
    assert Path(where.strip()).is_relative_to(site)
    return run


def test_wheel_holds_the_package_and_what_it_needs_beside_it_but_no_figures(built: Built) -> None:
    names = set(zipfile.ZipFile(built.wheel).namelist())
    needed = [path for path in (ROOT / "shaders").rglob("*") if path.is_file()]
    needed += [path for path in (ROOT / "spec").iterdir() if path.is_file()]
    proposal = ROOT / "spec" / "EXT_materials_bragg"
    needed += [proposal / "README.md", *(proposal / "schema").iterdir()]
    shipped = {f"gltf_iri/_shipped/{path.relative_to(ROOT).as_posix()}" for path in needed}
    assert {name for name in names if name.startswith("gltf_iri/_shipped/")} == shipped
    assert "gltf_iri/py.typed" in names
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"gltf_iri"}


def test_the_version_is_stated_once(built: Built) -> None:
    assert built.wheel.name.split("-")[1] == gltf_iri.__version__
    assert "version" not in tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_archive_holds_what_a_developer_needs_and_nothing_made(built: Built) -> None:
    with tarfile.open(built.archive) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    for needed in ("Makefile", "LICENSE", "README.md", "tests/conftest.py", "samples/index.json"):
        assert needed in names
    made = {".venv", "out", "build", "dist"}
    assert {name for name in names if name.split("/")[0] in made} == set()


def test_installed_program_evaluates_in_any_folder(installed: Program) -> None:
    arguments = ["--film-ior", "1.5", "--thickness", "400", "--base-f0", "0.04", "--cos", "1,0.5", "--json"]
    result = json.loads(installed("-m", "gltf_iri", "evaluate", *arguments))
    assert result["cos"] == [1.0, 0.5]
    assert [len(colour) for colour in result["rgb"]] == [3, 3]


def test_installed_program_draws_in_any_folder(installed: Program, gl_context: moderngl.Context) -> None:
    written = json.loads(installed("-m", "gltf_iri", "samples", "here", "--json"))["written"]
    asset = next(path for path in written if path.endswith("pearl.glb"))
    drawn = json.loads(
        installed("-m", "gltf_iri", "render", asset, "-o", "pearl.png", "--size", "64x48", "--json")
    )
    assert drawn["size"] == [64, 48]
