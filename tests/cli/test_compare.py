"""`gltf-iri compare` on the command line; its figures are held in tests/comparison."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from gltf_iri.cli.main import run

ROOT = Path(__file__).resolve().parents[2]
OIL = ROOT / "samples" / "oil-on-metal"
PEARL = ROOT / "samples" / "pearl" / "pearl.glb"


def test_an_empty_folder_name_does_not_scatter_files_here(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["compare", str(PEARL), "-o", ""]) == 2
    assert capsys.readouterr().err == "gltf-iri: The name of the folder is empty; write '.' for this one.\n"
    assert not list(tmp_path.iterdir())


def test_a_user_without_a_home_reads_no_warnings(gl_context, tmp_path):
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "gltf_iri",
            "compare",
            PEARL,
            "-o",
            tmp_path,
            "--size",
            "24x16",
            "--env",
            "none",
        ],
        cwd=ROOT,
        env={**os.environ, "MPLCONFIGDIR": os.devnull + "/none"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_an_empty_picture_is_told(gl_context, tmp_path, capsys):
    gltf = json.loads((OIL / "oil-on-metal.gltf").read_text())
    for node in gltf["nodes"]:
        if "mesh" in node:
            node["scale"] = [0, 0, 0]
    shutil.copytree(OIL, tmp_path / "oil")
    flat = tmp_path / "oil" / "flat.gltf"
    flat.write_text(json.dumps(gltf))
    arguments = ["compare", str(flat), "-o", str(tmp_path / "out"), "--size", "24x16", "--env", "none"]
    assert run(arguments) == 0
    assert "note: Nothing of the model is in the picture" in capsys.readouterr().err
    assert "Nothing of the model" in (tmp_path / "out" / "report.json").read_text()


def test_a_picture_without_rough_pixels_is_said_to_be_unjudged(gl_context, tmp_path, capsys):
    bubble = ROOT / "samples" / "soap-bubble" / "soap-bubble.glb"
    arguments = ["compare", str(bubble), "-o", str(tmp_path / "out"), "--size", "24x16", "--env", "none"]
    assert run(arguments) == 0
    assert "note: No pixel is rough enough to be judged" in capsys.readouterr().err


def test_rays_are_cast_where_they_are_asked_for(gl_context, tmp_path, capsys):
    arguments = ["compare", str(PEARL), "-o", str(tmp_path), "--size", "24x16", "--json", "--exposure", "0"]
    assert run([*arguments, "--reference", "--samples", "8", "--paths", "2"]) == 0
    printed = json.loads(capsys.readouterr().out)
    held = printed["reference"]
    assert held["agrees"] and held["same_problem"]["rough"]["pixels"] > 50
    assert held["lights"] == "the scene's own lights"
    assert held["samples"] == {"image_samples": 8, "paths": 2}
    assert Path(printed["files"]["difference_reference"]).is_file()


def test_a_scene_without_lights_is_lit_by_a_rig_and_told_so(gl_context, tmp_path, capsys):
    arguments = ["compare", str(OIL / "oil-on-metal.gltf"), "-o", str(tmp_path), "--size", "24x16"]
    assert run([*arguments, "--reference", "--samples", "8"]) == 0
    told = capsys.readouterr()
    assert "lit by a rig of three" in told.err
    assert "Against the CPU reference" in told.out


def test_numbers_of_the_reference_are_refused_without_it(tmp_path, capsys):
    assert run(["compare", str(PEARL), "-o", str(tmp_path), "--samples", "8"]) == 2
    assert (
        capsys.readouterr().err == "gltf-iri: --samples and --paths are the reference's: add --reference.\n"
    )


def test_without_embree_the_command_says_what_to_install(gl_context, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    assert run(["compare", str(PEARL), "-o", str(tmp_path / "out"), "--size", "24x16", "--reference"]) == 3
    assert "pip install 'gltf-iri[reference]'" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
