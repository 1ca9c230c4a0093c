"""What the guide for implementers tells to type works as it says."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "spec" / "EXT_materials_bragg" / "implementing.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)


def test_the_first_step_of_the_guide_passes_the_checker(tmp_path: Path) -> None:
    (program,) = blocks("python")
    (tmp_path / "spec").symlink_to(ROOT / "spec")
    (tmp_path / "first.py").write_text(program, encoding="utf-8")
    subprocess.run([sys.executable, "first.py"], cwd=tmp_path, check=True)
    (command,) = [line for line in "".join(blocks("sh")).splitlines() if "--quantity reflectance" in line]
    words = [sys.executable, *shlex.split(command)[1:]]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert re.fullmatch(
        r"reflectance: \d+ rows, max abs error \S+, worst row \d+, no rows fail\n", done.stdout
    )


def test_the_shaders_that_the_guide_names_are_there() -> None:
    text = GUIDE.read_text(encoding="utf-8")
    shaders = re.findall(r"`((?:optics|lighting|material|generated|common)/[\w.]+\.glsl)`", text)
    shaders += re.findall(r"`shaders/([\w./]+\.glsl)`", text)
    assert len(shaders) > 15
    assert [name for name in shaders if not (ROOT / "shaders" / name).is_file()] == []
    python = re.findall(r"`((?:gltf_iri|spec|tests)/[\w./-]+\.\w+)`", text)
    assert [name for name in python if not (ROOT / name).is_file()] == []


@pytest.mark.parametrize("version", ["330 core", "300 es"])
def test_the_text_for_a_compiler_has_no_includes_left(version: str) -> None:
    (command,) = [line for line in "".join(blocks("sh")).splitlines() if "assemble" in line]
    program = shlex.split(command)[2].replace('.glsl")', f'.glsl", version="{version}")')
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith(f"#version {version}\n")
    assert "#include" not in done.stdout
    assert "float bragg_reflectance(" in done.stdout
